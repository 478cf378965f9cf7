// SPDX-License-Identifier: MIT
// The reader as Parameters: numbers, vectors, strings.
#include "lang/interpreter.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace abbe::lang {
namespace {

constexpr std::string_view size_names[] = {"",         "a float",    "a 2-vector",
                                           "a vector", "a 4-vector", "a colour"};

} // namespace

std::string ReaderImpl::describe_next() {
  switch (next()) {
  case Next::End:
    return "the end";
  case Next::Word:
    return fmt::format("'{}'", peek_.word);
  case Next::Numeric:
    return "a number";
  case Next::String:
    return "a string";
  case Next::Identifier:
    return std::string(type_name(*peek_.value));
  case Next::Block:
    return peek_.word.empty() ? "'{'" : fmt::format("'{} {{'", peek_.word);
  case Next::Bracket:
    return "'['";
  case Next::Punctuation:
    return fmt::format("'{}'", peek_.symbol);
  }
  return {};
}

/// What the block says about its values now would only follow from the mistake already reported.
void ReaderImpl::taint() {
  if (bool* const mark = block_taint()) *mark = true;
}

bool ReaderImpl::tainted() {
  bool const* const mark = block_taint();
  return mark != nullptr && *mark;
}

/// Reports that a value is not there: once at a place, whatever else is missed there.
void ReaderImpl::missing(std::string_view name, std::string_view kind) {
  bool const follows = tainted();
  taint();
  Span const span = next_span();
  if (peek_.next == Next::Word && peek_.undeclared) {
    // A keyword that could stand here is nearer than any name.
    std::string const hint = in_.suggestion(peek_.word, asked_);
    in_.error("E0201", fmt::format("undeclared identifier '{}'{}", peek_.word, hint), span);
    while (peek_.split && frames_.back().part < peek_.split->arguments.size())
      ++frames_.back().part;
    consume();
    return;
  }
  if (missing_at_.source == span.source && missing_at_.begin == span.begin
      && missing_at_.end == span.end) {
    // Whoever reads values as long as there is something does not wait for the end in vain.
    constexpr int patience = 1000;
    if (++missing_again_ > patience && !at_end()) skip();
    return;
  }
  missing_at_ = span;
  missing_again_ = 0;
  if (follows) return;
  in_.error("E0301", fmt::format("expected {} ({}), found {}", name, kind, describe_next()), span);
  bool const wrong_type =
      peek_.next == Next::String || peek_.next == Next::Identifier || peek_.next == Next::Numeric;
  if (wrong_type) consume();
}

Numeric ReaderImpl::evaluate_peeked() {
  if (peek_.value) return in_.expressions.to_numeric(*peek_.value, peek_.span);
  if (peek_.split) {
    // Never seen by the first part: that is a name or carries a value.
    ast::Call const* const split = peek_.split;
    auto const part = frames_.back().part;
    if (part > 0) {
      ast::Paren paren;
      paren.span = split->span;
      paren.items = split->arguments[part - 1u];
      return in_.expressions(paren);
    }
  }
  return in_.expressions.numeric(*peek_.expr);
}

Span ReaderImpl::value_span() {
  Span const span = next_span();
  comma_ = false;
  return span;
}

bool ReaderImpl::comma_follows(Span value) {
  if (comma_behind(value)) return true;
  next(); // leaves the macros that end here
  return comma_;
}

Numeric ReaderImpl::numeric(std::string_view name, int minimum) {
  if (next() != Next::Numeric) {
    missing(name, minimum == 1 ? "a number" : size_names[minimum]);
    return Numeric{}.promoted(minimum);
  }
  Span const span = peek_.span;
  Numeric n = evaluate_peeked();
  consume();
  if (n.poisoned()) {
    taint();
    return Numeric{}.promoted(minimum);
  }
  for (int i = 0; i < n.size; ++i) {
    if (std::isfinite(n.c[static_cast<std::size_t>(i)])) continue;
    taint();
    in_.error("E0303",
              fmt::format("{} is not a finite number but {}", name,
                          std::isnan(n.c[static_cast<std::size_t>(i)]) ? "undefined" : "infinite"),
              span);
    return Numeric{}.promoted(minimum);
  }
  return n.promoted(minimum);
}

bool ReaderImpl::take_literal(Numeric& n, int size) {
  // What is next, peeked at or not, where no directive stands before it and no list ends here.
  Frame& frame = frames_.back();
  if (frame.position >= frame.items->size()) return false;
  ast::Item const& item = (*frame.items)[frame.position];
  if (auto const* many = ast::get_if<ast::LiteralVectors>(item)) {
    if (many->size != size) return false;
    auto const first = many->values.begin() + static_cast<std::ptrdiff_t>(frame.element) * size;
    std::copy(first, first + size, n.c.begin());
  } else if (auto const* literal = ast::get_if<ast::LiteralVector>(item)) {
    if (literal->size != size) return false;
    std::copy(literal->values, literal->values + 5, n.c.begin());
  } else {
    return false;
  }
  n.size = static_cast<std::uint8_t>(size);
  advance(frame);
  peek_.ready = false;
  asked_.clear();
  return true;
}

std::span<double const> ReaderImpl::literal_vectors(int size, std::size_t most) {
  Frame& frame = frames_.back();
  if (frame.position >= frame.items->size() || most == 0) return {};
  ast::Item const& item = (*frame.items)[frame.position];
  auto const* many = ast::get_if<ast::LiteralVectors>(item);
  if (many == nullptr || many->size != size) return {};
  std::size_t const first = frame.element;
  std::size_t const count = std::min(most, many->count() - first);
  frame.element += static_cast<std::uint32_t>(count - 1);
  advance(frame);
  peek_.ready = false;
  asked_.clear();
  auto const width = static_cast<std::size_t>(size);
  return {many->values.data() + first * width, count * width};
}

Numeric ReaderImpl::vector(std::string_view name, int size) {
  if (Numeric n; take_literal(n, size)) return n;
  if (next() != Next::Numeric) {
    missing(name, size_names[size]);
    return Numeric{}.promoted(size);
  }
  Span const span = peek_.span;
  Numeric n = numeric(name, size);
  if (n.size <= size) return n;
  report(Severity::Error, "E0302",
         fmt::format("{} must be {}, not {}", name, size_names[size], size_names[n.size]), span);
  taint();
  n.size = static_cast<std::uint8_t>(size);
  return n;
}

double ReaderImpl::number(std::string_view name) {
  Frame& frame = frames_.back();
  if (!peek_.ready && frame.position < frame.items->size()) {
    if (auto const* literal = ast::get_if<ast::Number>((*frame.items)[frame.position])) {
      ++frame.position;
      asked_.clear();
      return literal->value;
    }
  }
  return vector(name, 1).scalar();
}

int ReaderImpl::integer(std::string_view name, int low, int high) {
  Span const span = next_span();
  double const value = std::trunc(number(name));
  if (value >= low && value <= high) return static_cast<int>(value);
  report(Severity::Error, "E0304",
         fmt::format("{} must lie in {} .. {}, not {}", name, low, high, value), span);
  taint();
  return value < low ? low : high;
}

Vec2 ReaderImpl::vec2(std::string_view name) {
  Numeric const n = vector(name, 2);
  return {n.c[0], n.c[1]};
}

Vec3 ReaderImpl::vec3(std::string_view name) {
  return vector(name, 3).vec3();
}

Vec4 ReaderImpl::vec4(std::string_view name) {
  Numeric const n = vector(name, 4);
  return {n.c[0], n.c[1], n.c[2], n.c[3]};
}

std::vector<double> ReaderImpl::components(std::string_view name, int count) {
  std::vector<double> values;
  auto const wanted = static_cast<std::size_t>(count);
  if (next() != Next::Numeric) {
    missing(name, fmt::format("a vector of {} components", count));
    return std::vector<double>(wanted);
  }
  Span const span = peek_.span;
  auto const* vector_node = peek_.expr ? ast::get_if<ast::Vector>(*peek_.expr) : nullptr;
  if (!vector_node) {
    Numeric const n = numeric(name, 1);
    values.assign(n.c.begin(), n.c.begin() + n.size);
  } else {
    consume();
    enter_region(vector_node->components, span);
    bool wrong = false;
    while (!at_end()) {
      wrong = wrong || next() != Next::Numeric;
      if (wrong)
        missing("a component", "a float");
      else
        values.push_back(number("a component"));
      if (wrong && !at_end()) skip();
    }
    leave_region();
    if (wrong) return std::vector<double>(wanted);
  }
  if (values.size() != wanted)
    in_.error("E0302",
              fmt::format("{} must have {} components, not {}", name, count, values.size()), span);
  values.resize(wanted);
  return values;
}

std::string ReaderImpl::string(std::string_view name) {
  if (next() != Next::String) {
    missing(name, "a string");
    return {};
  }
  std::string text;
  if (peek_.value)
    text = std::get<std::string>(peek_.value->any);
  else
    text = in_.expressions.string(*peek_.expr, name);
  consume();
  return text;
}

std::string ReaderImpl::path(std::string_view name) {
  if (next() == Next::String && !peek_.value) {
    if (auto const* literal = ast::get_if<ast::String>(*peek_.expr)) {
      consume();
      return literal->raw;
    }
  }
  return string(name);
}

bool ReaderImpl::boolean_or(bool absent) {
  if (next() != Next::Numeric) return absent;
  return std::abs(number("a boolean")) > 1e-10;
}

Value const* ReaderImpl::identifier() {
  return next() == Next::Identifier ? peek_.value : nullptr;
}

void ReaderImpl::take() {
  if (Value const* const value = identifier()) in_.use(value->deferred, peek_.span);
  consume();
}

} // namespace abbe::lang

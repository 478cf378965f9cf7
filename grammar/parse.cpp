// SPDX-License-Identifier: MIT
#include "grammar/parse.hpp"

#include "grammar/components.hpp"
#include "grammar/item.hpp"
#include "grammar/recover.hpp"

#include <fmt/format.h>
#include <iterator>
#include <limits>
#include <optional>
#include <utility>

namespace abbe {
namespace grammar {
namespace {

constexpr std::size_t max_errors = 20;

Diagnostic to_diagnostic(SyntaxError const& error, State const& state) {
  Diagnostic diagnostic{
      error.code, Severity::Error, state.span(error.begin, error.end), error.message, {}};
  if (error.note_begin != nullptr)
    diagnostic.notes.push_back({state.span(error.note_begin, error.note_end), error.note});
  return diagnostic;
}

/// X3 says what it expected and where it began to look, blanks and all.
SyntaxError to_syntax_error(x3::expectation_failure<Iterator> const& failure, Iterator last) {
  try {
    throw_expected(failure.which(), failure.where(), last);
  } catch (SyntaxError const& error) {
    return error;
  }
}

SyntaxError stray(Iterator at, Iterator last) {
  Token const found = next_token(at, last);
  if (found.kind == TokenKind::Unknown)
    return {"E0101", found.begin, found.end,
            fmt::format("{} has no meaning here", describe(found))};
  if (found.kind == TokenKind::Directive)
    return {"E0112", found.begin, found.end,
            fmt::format("{} without a directive that it could belong to", describe(found))};
  return {"E0112", found.begin, found.end,
          fmt::format("{} stands where a statement should begin", describe(found))};
}

/// Tells what is wrong with the text, if reading it by `read` does not end well.
template <class Read>
std::optional<SyntaxError> error_of(Iterator last, Read const& read) {
  try {
    return read();
  } catch (SyntaxError const& thrown) {
    return thrown;
  } catch (x3::expectation_failure<Iterator> const& thrown) {
    return to_syntax_error(thrown, last);
  }
}

/// The head of a block, past its '{'; what it holds comes next.
bool scan_open_block(Iterator& first, Iterator last, State& state, ast::Item& item) {
  Iterator at = first;
  ast::Block block{{}, {}, {}, true};
  if (*at != '{') {
    if (scan_plain(at, last, state, item) != Plain::Block) return false;
    block.head = ast::get_if<ast::Block>(item)->head;
    at = skip_blanks(at, last);
  }
  block.span = state.span(first, at + 1);
  item = ast::Expr(std::move(block));
  first = at + 1;
  return true;
}

class Run {
public:
  explicit Run(SourceFile const& source)
      : last_(source.text().data() + source.text().size()), at_(source.text().data()) {
    state_.source = &source;
    state_.begin = at_;
    state_.kept_from = at_;
    state_.end = last_;
  }

  bool at_end() const { return at_ == last_; }

  /// Reads the statements that begin within so many bytes.
  void operator()(std::size_t bytes, ast::Items& statements, std::vector<Diagnostic>& errors) {
    char const here = 0;
    state_.stack_start = &here;
    state_.statements = &statements;
    state_.pause = bytes < static_cast<std::size_t>(last_ - at_) ? at_ + bytes : last_;
    while (error_count_ < max_errors) {
      SyntaxError error;
      if (parse_items(at_, statements, error)) return;
      errors.push_back(to_diagnostic(error, state_));
      ++error_count_;
      at_ = resume(error.begin, last_, state_, pending_);
      start_afresh();
    }
    at_ = last_;
  }

  bool take_lasting() { return std::exchange(state_.lasting, false); }

private:
  void start_afresh() {
    State fresh;
    fresh.source = state_.source;
    fresh.begin = state_.begin;
    fresh.end = state_.end;
    fresh.stack_start = state_.stack_start;
    fresh.statements = state_.statements;
    fresh.pause = state_.pause;
    fresh.lasting = state_.lasting;
    fresh.loose = state_.loose;
    fresh.kept_from = state_.kept_from;
    fresh.structure = std::move(state_.structure);
    state_ = std::move(fresh);
  }
  /// Reads statements up to the end or the pause (true), or an error.
  bool parse_items(Iterator& at, ast::Items& all, SyntaxError& error) {
    auto const context = x3::make_context<StateTag>(state_);
    std::size_t const before = all.size();
    bool thrown = true;
    auto const wrong = error_of(last_, [&]() -> std::optional<SyntaxError> {
      for (;;) {
        rules::items.parse(at, last_, context, x3::unused, all);
        at = skip_blanks(at, last_);
        state_.pass(at);
        if (at >= state_.pause) return std::nullopt;
        if (pending_.take(at, last_)) continue;
        if (*at != '}' || !state_.loose) {
          thrown = false;
          return stray(at, last_);
        }
        all.emplace_back(ast::Punctuation{state_.span(at, at + 1), '}'});
        ++at;
      }
    });
    if (!wrong) return true;
    error = *wrong;
    if (thrown && all.size() > before) all.pop_back(); // the item that was being read
    return false;
  }

  Iterator const last_;
  Iterator at_;
  std::size_t error_count_ = 0;
  State state_;
  Pending pending_;
};

LooseItem read_loose_item(Span text, std::uint32_t from, bool full) {
  char const here = 0;
  State state;
  state.source = text.source;
  state.begin = text.source->text().data();
  state.kept_from = state.begin;
  state.end = state.begin + text.end;
  state.pause = state.end;
  state.stack_start = &here;
  state.flat = true;
  Iterator const last = state.end;
  Iterator at = state.begin + from;
  LooseItem out;
  auto const wrong = error_of(last, [&]() -> std::optional<SyntaxError> {
    at = skip_blanks(at, last);
    while (at != last && (*at == ',' || at_lone_hash(at, last))) at = skip_blanks(at + 1, last);
    if (at == last) return std::nullopt;
    ast::Item item;
    if (*at == '}') {
      item = ast::Punctuation{state.span(at, at + 1), '}'};
      ++at;
    } else if (!scan_open_block(at, last, state, item)) {
      if (full) state.flavour = Flavour::Full;
      auto const context = x3::make_context<StateTag>(state);
      if (!rules::item.parse(at, last, context, x3::unused, item)) return stray(at, last);
    }
    out.items.push_back(std::move(item));
    return std::nullopt;
  });
  if (wrong) out.error = to_diagnostic(*wrong, state);
  out.end = static_cast<std::uint32_t>(at - state.begin);
  return out;
}

} // namespace
} // namespace grammar

namespace {

/// Places are 32 bits wide; letters are bytes.
bool is_unreadable(SourceFile const& source, std::vector<Diagnostic>& errors) {
  std::string_view const text = source.text();
  bool const large = text.size() > std::numeric_limits<std::uint32_t>::max();
  bool const wide = text.starts_with("\xff\xfe") || text.starts_with("\xfe\xff");
  if (large)
    errors.push_back(
        {"E0703", Severity::Error, {&source, 0, 0}, "this source is larger than 4 GiB", {}});
  if (wide)
    errors.push_back({"E0101",
                      Severity::Error,
                      {&source, 0, 0},
                      "this text is UTF-16: save it as UTF-8 or Latin-1",
                      {}});
  return large || wide;
}

} // namespace

Parsed parse(SourceFile const& source) {
  Parsed parsed;
  parsed.document.source = &source;
  if (is_unreadable(source, parsed.errors)) return parsed;
  grammar::Run run(source);
  run(source.text().size(), parsed.document.items, parsed.errors);
  return parsed;
}

LooseItem parse_loose(Span text, std::uint32_t from, bool full) {
  return grammar::read_loose_item(text, from, full);
}

struct StatementParser::Impl {
  SourceFile const& source;
  grammar::Run run;
  bool refused = false;
};

StatementParser::StatementParser(SourceFile const& source)
    : impl_(std::make_unique<Impl>(Impl{source, grammar::Run(source)})) {}
StatementParser::~StatementParser() = default;

bool StatementParser::at_end() const {
  return impl_->refused || impl_->run.at_end();
}

StatementParser::Piece StatementParser::next(std::size_t bytes, ast::Items& statements) {
  Piece piece;
  statements.clear();
  impl_->refused = is_unreadable(impl_->source, piece.errors);
  if (!impl_->refused) impl_->run(bytes, statements, piece.errors);
  piece.lasting = impl_->run.take_lasting();
  return piece;
}

bool comma_behind(Span const& span) {
  if (!span.valid()) return false;
  std::string_view const text = span.source->text();
  grammar::Token const next =
      grammar::next_token(text.data() + span.end, text.data() + text.size());
  return next.text() == ",";
}

std::string dump_tokens(SourceFile const& source) {
  static constexpr char const* kinds[] = {"end",         "number",   "string", "name",
                                          "operand",     "function", "word",   "directive",
                                          "punctuation", "unknown"};
  std::string out;
  grammar::Iterator at = source.text().data();
  grammar::Iterator const last = at + source.text().size();
  for (;;) {
    grammar::Token const token = grammar::next_token(at, last);
    if (token.kind == grammar::TokenKind::End) return out;
    auto const place = source.place(static_cast<std::uint32_t>(token.begin - source.text().data()));
    fmt::format_to(std::back_inserter(out), "{}:{} {} {}\n", place.line, place.column,
                   kinds[static_cast<std::size_t>(token.kind)], token.text());
    at = token.end;
  }
}

} // namespace abbe

// SPDX-License-Identifier: MIT
// Directives that steer: conditions, loops, declarations, macros.
#include "lang/interpreter.hpp"

#include <cmath>
#include <fmt/format.h>

namespace abbe::lang {
namespace {

constexpr double eps = 1e-10; ///< POV-Ray's, in comparisons
/// An error may leave a variable unset that a #while waits for.
constexpr int max_rounds_with_errors = 100000;

bool for_is_over(double counter, double last, double step) {
  return step > 0 ? counter > last + eps : counter < last - eps;
}

} // namespace

bool ReaderImpl::is_defined(ast::Expr const& expr) {
  if (auto const* name = ast::get_if<ast::Name>(expr)) {
    if (name->reserved) return true;
    Value const* const value = in_.scope.find(in_.scope.symbol(*name));
    return value && !value->empty();
  }
  if (auto const* index = ast::get_if<ast::Index>(expr)) {
    Value const* const array = in_.scope.find(in_.scope.symbol(index->array));
    if (!array || array->empty()) return false;
    Value const* const element = in_.expressions.element(*index);
    return element && !element->empty();
  }
  if (auto const* paren = ast::get_if<ast::Paren>(expr))
    if (ast::Expr const* const only = Expressions::sole(paren->items)) return is_defined(*only);
  in_.error("E0206", "expected a name or an element of an array", ast::span_of(expr));
  return false;
}

void ReaderImpl::execute(ast::If const& node) {
  using Test = ast::If::Branch::Test;
  for (auto const& branch : node.branches) {
    std::optional<bool> taken = true;
    switch (branch.test) {
    case Test::If:
      taken = is_broken(branch.condition, "#elseif takes a condition in parentheses")
                  ? std::nullopt
                  : in_.expressions.condition(branch.condition);
      break;
    case Test::Ifdef:
      taken = is_defined(branch.condition);
      break;
    case Test::Ifndef:
      taken = !is_defined(branch.condition);
      break;
    case Test::Else:
      break;
    }
    if (!taken) return leave_loop();
    if (!*taken) continue;
    Frame frame;
    frame.items = &branch.items;
    if (node.open_blocks > 0) frame.tail = &node.tail;
    push(std::move(frame));
    return;
  }
}

void ReaderImpl::execute(ast::While const& node) {
  in_.check_limits(node.span);
  if (!in_.expressions.condition(node.condition).value_or(false)) return;
  Frame frame;
  frame.items = &node.items;
  frame.kind = Frame::Kind::While;
  frame.loop = &node;
  frame.span = node.span;
  push(std::move(frame));
}

void ReaderImpl::execute(ast::For const& node) {
  in_.check_limits(node.span);
  if (node.arguments.size() < 2 || node.arguments.size() > 3) {
    in_.error("E0320",
              fmt::format("#for takes a first and a last value and perhaps a step, not {} value{}",
                          node.arguments.size(), node.arguments.size() == 1 ? "" : "s"),
              node.span);
    return;
  }
  auto const from = in_.expressions.number(node.arguments[0], "the first value of #for");
  auto const to = in_.expressions.number(node.arguments[1], "the last value of #for");
  std::optional<double> by = 1;
  if (node.arguments.size() > 2) by = in_.expressions.number(node.arguments[2], "the step of #for");
  if (!from || !to || !by) return leave_loop();
  double const first = *from, last = *to, step = *by;
  if (step == 0) {
    in_.error("E0320", "the step of #for is zero", ast::span_of(node.arguments.back()));
    return;
  }
  if (std::isnan(first + last + step)) {
    in_.error("E0320", "a bound or the step of #for is not a number", node.span);
    return;
  }
  Symbol const symbol = in_.scope.symbol(node.counter);
  Value& counter = in_.scope.declare_local(symbol);
  counter.any = scalar_of(first);
  counter.declared_at = node.counter.span;
  if (for_is_over(first, last, step)) return;
  Frame frame;
  frame.items = &node.items;
  frame.kind = Frame::Kind::For;
  frame.counter = symbol;
  frame.last = last;
  frame.step = step;
  frame.span = node.span;
  push(std::move(frame));
}

/// Is what a directive asks no whole expression? Then what is wrong with it is reported.
bool ReaderImpl::is_broken(ast::Expr const& question, std::string_view wants) {
  auto const* const paren = ast::get_if<ast::Paren>(question);
  auto const* const text = paren != nullptr && paren->items.size() == 1
                               ? ast::get_if<ast::Text>(paren->items.front())
                               : nullptr;
  if (text == nullptr) return false;
  int const errors = in_.error_count();
  in_.expressions.value(question);
  if (in_.error_count() == errors) in_.error("E0110", std::string(wants), text->span);
  return true;
}

/// Is the clause one for this value? nullopt when what it asks for is wrong (reported).
std::optional<bool> ReaderImpl::is_for(ast::Switch::Clause const& clause, double value) {
  using Kind = ast::Switch::Clause::Kind;
  if (clause.kind == Kind::Else) return true;
  std::string_view const wants = clause.kind == Kind::Case
                                     ? "#case takes a value in parentheses"
                                     : "#range takes two values in parentheses";
  if (is_broken(clause.bounds.at(0), wants)) return std::nullopt;
  if (clause.kind == Kind::Case) {
    auto const wanted = in_.expressions.number(clause.bounds.at(0), "the value of #case");
    if (!wanted) return std::nullopt;
    return std::abs(*wanted - value) < eps;
  }
  auto const low = in_.expressions.number(clause.bounds.at(0), "the lower bound of #range");
  auto const high = in_.expressions.number(clause.bounds.at(1), "the upper bound of #range");
  if (!low || !high) return std::nullopt;
  return value >= *low - eps && value <= *high + eps;
}

void ReaderImpl::execute(ast::Switch const& node) {
  auto const value = in_.expressions.number(node.value, "the value of #switch");
  if (!value) return leave_loop();
  Frame before;
  before.items = &node.before;
  for (std::size_t i = 0; i < node.clauses.size(); ++i) {
    auto const& clause = node.clauses[i];
    auto const taken = is_for(clause, *value);
    if (!taken) return leave_loop();
    if (!*taken) continue;
    Frame frame;
    frame.items = &clause.items;
    frame.kind = Frame::Kind::Switch;
    frame.loop = &node;
    frame.clause = i;
    frame.span = node.span;
    push(std::move(frame));
    break;
  }
  if (!node.before.empty()) push(std::move(before));
}

/// At the end of a loop's body: is there another round? Then the frame stands at its start again.
bool ReaderImpl::next_round(Frame ended) {
  std::size_t const index = frames_.size() - 1;
  if (ended.kind == Frame::Kind::Switch) {
    // Falls through into the next clause, whatever comes out of what that asks for.
    auto const& node = *static_cast<ast::Switch const*>(ended.loop);
    std::size_t const next_clause = ended.clause + 1;
    if (next_clause >= node.clauses.size() || !is_for(node.clauses[next_clause], 0)) return false;
    frames_[index].clause = next_clause;
    frames_[index].items = &node.clauses[next_clause].items;
    frames_[index].position = 0;
    return true;
  }
  in_.check_limits(ended.span);
  bool more = false;
  if (ended.kind == Frame::Kind::While) {
    auto const& node = *static_cast<ast::While const*>(ended.loop);
    more = in_.expressions.condition(node.condition).value_or(false);
    if (in_.wrong_since_asked() && more && ++rounds_with_errors_ > max_rounds_with_errors) {
      in_.error("E0701", "this #while goes round and round with errors: the rest is not looked at",
                ended.span);
      in_.abort();
    }
  } else {
    Value* const counter = in_.scope.find(ended.counter);
    auto* const number = counter ? std::get_if<Numeric>(&counter->any) : nullptr;
    if (!number || number->size != 1) {
      in_.error("E0321",
                fmt::format("the counter '{}' is no longer a float", in_.scope.text(ended.counter)),
                ended.span);
      return false;
    }
    number->c[0] += ended.step;
    more = !for_is_over(number->c[0], ended.last, ended.step);
  }
  frames_[index].position = 0;
  return more;
}

/// After an error in a condition: the loop around it, which may wait for what the condition
/// decides, ends.
void ReaderImpl::leave_loop() {
  for (std::size_t i = frames_.size(); i-- > 0 && !frames_[i].wall();) {
    if (frames_[i].kind != Frame::Kind::While && frames_[i].kind != Frame::Kind::For) continue;
    while (frames_.size() > i) pop();
    return;
  }
}

void ReaderImpl::break_out(Span span) {
  for (std::size_t i = frames_.size(); i-- > 0;) {
    Frame const& frame = frames_[i];
    if (frame.wall() || frame.kind == Frame::Kind::Include) break;
    if (frame.kind == Frame::Kind::Splice || frame.kind == Frame::Kind::Brace) continue;
    while (frames_.size() > i) pop();
    return;
  }
  in_.error("E0207", "#break stands in no loop, no #switch and no macro", span);
}

void ReaderImpl::execute(ast::Macro const& node) {
  if (node.name.reserved) {
    in_.error("E0204", fmt::format("'{}' is a reserved word", node.name.text), node.name.span);
    return;
  }
  Value& slot = in_.scope.declare(in_.scope.symbol(node.name));
  slot.any = MacroValue{&node};
  slot.declared_at = node.name.span;
}

void ReaderImpl::execute(ast::Directive const& node) {
  std::string_view const word = node.word;
  if (word == "break") return break_out(node.span);
  if (word == "include") return include(node);
  if (word == "debug" || word == "warning" || word == "error" || word == "render"
      || word == "statistics")
    return message(node);
  if (word == "version") return set_version(node);
  if (word == "default") return set_default(node);
  if (word == "undef") return undefine(node);
  if (word == "fopen") return open_file(node);
  if (word == "fclose") return close_file(node);
  if (word == "read") return read_file(node);
  if (word == "write") return write_file(node);
  in_.error("E0209", fmt::format("'#{}' does not belong here", word), node.span);
}

} // namespace abbe::lang

// SPDX-License-Identifier: MIT
// Directives that steer: conditions, loops, declarations, macros.
#include "lang/interpreter.hpp"

#include <cmath>
#include <fmt/format.h>

namespace abbe::lang {
namespace {

constexpr double eps = 1e-10; ///< POV-Ray's, in comparisons

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
    bool taken = true;
    switch (branch.test) {
    case Test::If:
      taken = in_.expressions.condition(branch.condition);
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
    if (!taken) continue;
    Frame frame;
    frame.items = &branch.items;
    if (node.open_blocks > 0) frame.tail = &node.tail;
    push(std::move(frame));
    return;
  }
}

void ReaderImpl::execute(ast::While const& node) {
  in_.check_limits(node.span);
  if (!in_.expressions.condition(node.condition)) return;
  Frame frame;
  frame.items = &node.items;
  frame.kind = Frame::Kind::While;
  frame.loop = &node;
  frame.span = node.span;
  push(std::move(frame));
}

void ReaderImpl::execute(ast::For const& node) {
  in_.check_limits(node.span);
  if (node.arguments.size() < 2) return;
  double const first = in_.expressions.scalar(node.arguments[0], "the first value of #for");
  double const last = in_.expressions.scalar(node.arguments[1], "the last value of #for");
  double const step =
      node.arguments.size() > 2 ? in_.expressions.scalar(node.arguments[2], "the step of #for") : 1;
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

bool ReaderImpl::enter_clause(ast::Switch const& node, std::size_t from, bool falling) {
  double const value = falling ? 0 : in_.expressions.scalar(node.value, "the value of #switch");
  for (std::size_t i = from; i < node.clauses.size(); ++i) {
    auto const& clause = node.clauses[i];
    using Kind = ast::Switch::Clause::Kind;
    bool taken = falling || clause.kind == Kind::Else;
    if (!taken && clause.kind == Kind::Case)
      taken =
          std::abs(in_.expressions.scalar(clause.bounds.at(0), "the value of #case") - value) < eps;
    if (!taken && clause.kind == Kind::Range) {
      double const low = in_.expressions.scalar(clause.bounds.at(0), "the lower bound of #range");
      double const high = in_.expressions.scalar(clause.bounds.at(1), "the upper bound of #range");
      taken = value >= low - eps && value <= high + eps;
    }
    if (!taken) continue;
    Frame frame;
    frame.items = &clause.items;
    frame.kind = Frame::Kind::Switch;
    frame.loop = &node;
    frame.clause = i;
    frame.span = node.span;
    push(std::move(frame));
    return true;
  }
  return false;
}

void ReaderImpl::execute(ast::Switch const& node) {
  enter_clause(node, 0, false);
}

/// At the end of a loop's body: is there another round? Then the frame stands at its start again.
bool ReaderImpl::next_round(Frame const& ended) {
  std::size_t const index = frames_.size() - 1;
  if (ended.kind == Frame::Kind::Switch) {
    // Falls through into the next clause, whatever its condition.
    auto const& node = *static_cast<ast::Switch const*>(ended.loop);
    std::size_t const next_clause = ended.clause + 1;
    if (next_clause >= node.clauses.size()) return false;
    frames_[index].clause = next_clause;
    frames_[index].items = &node.clauses[next_clause].items;
    frames_[index].position = 0;
    return true;
  }
  in_.check_limits(ended.span);
  bool more = false;
  if (ended.kind == Frame::Kind::While) {
    auto const& node = *static_cast<ast::While const*>(ended.loop);
    more = in_.expressions.condition(node.condition);
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

void ReaderImpl::break_out(Span span) {
  for (std::size_t i = frames_.size(); i-- > 0;) {
    Frame const& frame = frames_[i];
    if (frame.wall() || frame.kind == Frame::Kind::Include) break;
    if (frame.kind == Frame::Kind::Splice) continue;
    while (frames_.size() > i) pop();
    return;
  }
  in_.error("E0207", "#break stands in no loop, no #switch and no macro", span);
}

void ReaderImpl::execute(ast::Declare const& node) {
  Deferral deferral(in_);
  Value value = value_of(node.value, node.span);
  value.deferred = deferral.take();
  bool const needs_semicolon = std::holds_alternative<Numeric>(value.any);
  if (needs_semicolon && !node.has_semicolon && !std::get<Numeric>(value.any).poisoned())
    in_.error("E0105", "a ';' is missing after this declaration of a number",
              {node.span.source, node.span.end, node.span.end});
  assign(node, std::move(value));
}

void ReaderImpl::execute(ast::Macro const& node) {
  for (std::size_t i = frames_.size(); i-- > 0 && frames_[i].kind != Frame::Kind::Include;)
    if (frames_[i].kind == Frame::Kind::Macro) {
      in_.error("E0208", "a macro cannot be defined inside a macro", node.name.span);
      return;
    }
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

// SPDX-License-Identifier: MIT
#pragma once

#include "grammar/components.hpp"
#include "grammar/directive.hpp"

/// Operators of expressions as X3 directives around the parser of their operands.
namespace abbe::grammar {

/// A set of binary operators of the same precedence.
enum class Level : std::uint8_t { Multiply, Add, Relation, Logic, And, Or };

/// The operator at `at`, of that level; moves past it.
inline bool scan_operator(Level level, Iterator& at, Iterator last, ast::BinaryOp& op) {
  using enum ast::BinaryOp;
  char const c = *at;
  bool const equals = last - at > 1 && at[1] == '=';
  auto const take = [&](ast::BinaryOp which, int length) {
    op = which;
    at += length;
    return true;
  };
  switch (level) {
  case Level::Multiply:
    return c == '*' ? take(Mul, 1) : c == '/' && take(Div, 1);
  case Level::Add:
    return c == '+' ? take(Add, 1) : c == '-' && take(Sub, 1);
  case Level::Logic:
    return c == '&' ? take(And, 1) : c == '|' && take(Or, 1);
  case Level::And:
    return c == '&' && take(And, 1);
  case Level::Or:
    return c == '|' && take(Or, 1);
  case Level::Relation:
    if (c == '<') return equals ? take(LessEqual, 2) : take(Less, 1);
    if (c == '>') return equals ? take(GreaterEqual, 2) : take(Greater, 1);
    if (c == '!') return equals && take(NotEqual, 2);
    return c == '=' && take(Equal, 1);
  }
  return false;
}

/// Counts the height that operators add to the tree. A bound from above: they are added to the
/// highest operand.
class Height {
public:
  explicit Height(State& state) : state_(state), outer_(state.height) {
    state.height = state.depth;
  }
  void leave(int operators, Iterator begin, Iterator end) {
    if ((state_.height += operators) > max_height) throw_too_high(begin, end);
    if (state_.height < outer_) state_.height = outer_;
  }

private:
  State& state_;
  int outer_;
};

ast::Expr make_binary(State const& state, ast::BinaryOp op, ast::Expr left, ast::Expr right);
ast::Expr make_unary(Span span, ast::UnaryOp op, ast::Expr operand);
/// Is it a directive that may yield a value?
inline bool is_conditional(ast::Item const& item) {
  return ast::get_if<ast::If>(item) || ast::get_if<ast::Switch>(item)
         || ast::get_if<ast::While>(item) || ast::get_if<ast::For>(item);
}

/// operand { op operand }, grouped from the left, or from the right (relations in functions).
enum class Grouping : std::uint8_t { Left, Right };
template <class Subject>
struct ChainDirective : x3::unary_parser<Subject, ChainDirective<Subject>> {
  constexpr ChainDirective(Subject const& inner, Level level, Grouping grouping)
      : x3::unary_parser<Subject, ChainDirective<Subject>>(inner),
        level_(level),
        grouping_(grouping) {}
  using attribute_type = ast::Expr;
  static bool const has_attribute = true;
  static bool const handles_container = false;

  template <class AnyContext, class RContext>
  bool parse(Iterator& first, Iterator const& last, AnyContext const& context, RContext& rcontext,
             ast::Expr& out) const {
    State& state = state_of(context);
    Height height(state);
    Iterator at = first;
    if (!this->subject.parse(at, last, context, rcontext, out)) {
      height.leave(0, first, at);
      return false;
    }
    int operators = 0;
    ast::BinaryOp op{};
    Iterator next = skip_blanks(at, last);
    if (next != last && scan_operator(level_, next, last, op))
      operators = rest(at, last, context, rcontext, out);
    height.leave(operators, first, at);
    first = at;
    return true;
  }

private:
  /// Apart from parse(), so that plain operands nest in small stack frames.
  template <class AnyContext, class RContext>
  [[gnu::noinline]] int rest(Iterator& at, Iterator const& last, AnyContext const& context,
                             RContext& rcontext, ast::Expr& out) const {
    State& state = state_of(context);
    std::vector<std::pair<ast::BinaryOp, ast::Expr>> pending; // when grouping from the right
    int operators = 0;
    for (;; ++operators) {
      Iterator next = skip_blanks(at, last);
      ast::BinaryOp op{};
      if (next == last || !scan_operator(level_, next, last, op)) break;
      ast::Expr right;
      ast::Items led = directives(next, last, context, rcontext);
      bool const yields = !led.empty() && is_conditional(led.back());
      if (!yields && !this->subject.parse(next, last, context, rcontext, right))
        throw_expected("a value after the operator", next, last);
      at = next;
      if (!led.empty()) {
        Span const span = state.span(state.begin + ast::span_of(led.front()).begin, at);
        if (!yields) led.emplace_back(std::move(right));
        right = ast::Expr(ast::Paren{span, std::move(led)});
      }
      if (operators > max_height) throw_too_high(at, last);
      if (grouping_ == Grouping::Left)
        out = make_binary(state, op, std::move(out), std::move(right));
      else
        pending.emplace_back(op, std::exchange(out, std::move(right)));
    }
    for (auto p = pending.rbegin(); p != pending.rend(); ++p)
      out = make_binary(state, p->first, std::move(p->second), std::move(out));
    return operators;
  }
  /// The directives that stand before an operand: `2 + #declare A = 3; A`.
  template <class AnyContext, class RContext>
  static ast::Items directives(Iterator& at, Iterator const& last, AnyContext const& context,
                               RContext& rcontext) {
    ast::Items found;
    for (;;) {
      Iterator const next = skip_blanks(at, last);
      ast::Item item;
      if (next == last || *next != '#'
          || !rules::directive.parse(at, last, context, rcontext, item))
        return found;
      found.push_back(std::move(item));
    }
  }
  Level level_;
  Grouping grouping_;
};
template <class Subject>
constexpr auto chain(Level level, Subject const& inner, Grouping grouping = Grouping::Left) {
  using Parser = typename x3::extension::as_parser<Subject>::value_type;
  return ChainDirective<Parser>(x3::as_parser(inner), level, grouping);
}

/// { + - ! } operand. A sign before a number literal becomes part of the Number.
template <class Subject>
struct PrefixDirective : x3::unary_parser<Subject, PrefixDirective<Subject>> {
  using x3::unary_parser<Subject, PrefixDirective<Subject>>::unary_parser;
  using attribute_type = ast::Expr;
  static bool const has_attribute = true;
  static bool const handles_container = false;

  template <class AnyContext, class RContext>
  bool parse(Iterator& first, Iterator const& last, AnyContext const& context, RContext& rcontext,
             ast::Expr& out) const {
    Iterator const at = skip_blanks(first, last);
    if (at != last && *at != '+' && *at != '-' && *at != '!')
      return this->subject.parse(first, last, context, rcontext, out);
    return signed_operand(first, at, last, context, rcontext, out);
  }

private:
  template <class AnyContext, class RContext>
  [[gnu::noinline]] bool signed_operand(Iterator& first, Iterator at, Iterator const& last,
                                        AnyContext const& context, RContext& rcontext,
                                        ast::Expr& out) const {
    State& state = state_of(context);
    Iterator const begin = at;
    Height height(state);
    std::vector<Iterator> signs;
    for (; at != last && (*at == '+' || *at == '-' || *at == '!'); at = skip_blanks(at, last)) {
      if (*at == '!' && (state.flavour == Flavour::Function || (last - at > 1 && at[1] == '=')))
        break;
      signs.push_back(at++);
    }
    if (!this->subject.parse(at, last, context, rcontext, out)) {
      if (signs.empty()) return false;
      throw_expected("a value after the sign", at, last);
    }
    height.leave(static_cast<int>(std::min<std::size_t>(signs.size(), max_height + 1)), begin, at);
    for (; !signs.empty(); signs.pop_back()) {
      char const sign = *signs.back();
      auto const op = sign == '+'   ? ast::UnaryOp::Plus
                      : sign == '-' ? ast::UnaryOp::Minus
                                    : ast::UnaryOp::Not;
      out = make_unary(state.span(signs.back(), at), op, std::move(out));
    }
    first = at;
    return true;
  }
};
template <class Subject>
constexpr auto prefixed(Subject const& inner) {
  using Parser = typename x3::extension::as_parser<Subject>::value_type;
  return PrefixDirective<Parser>(x3::as_parser(inner));
}

/// condition [ '?' branch ':' branch ]
template <class Condition, class Branch>
struct TernaryDirective
    : x3::binary_parser<Condition, Branch, TernaryDirective<Condition, Branch>> {
  using x3::binary_parser<Condition, Branch, TernaryDirective<Condition, Branch>>::binary_parser;
  using attribute_type = ast::Expr;
  static bool const has_attribute = true;
  static bool const handles_container = false;

  template <class AnyContext, class RContext>
  bool parse(Iterator& first, Iterator const& last, AnyContext const& context, RContext& rcontext,
             ast::Expr& out) const {
    if (!this->left.parse(first, last, context, rcontext, out)) return false;
    Iterator const at = skip_blanks(first, last);
    return at == last || *at != '?' || rest(first, at, last, context, rcontext, out);
  }

private:
  template <class AnyContext, class RContext>
  [[gnu::noinline]] bool rest(Iterator& first, Iterator at, Iterator const& last,
                              AnyContext const& context, RContext& rcontext, ast::Expr& out) const {
    State& state = state_of(context);
    Nest nest(state, at);
    Iterator const question = at++;
    ast::Conditional node;
    if (!this->right.parse(at, last, context, rcontext, node.yes))
      throw_expected("a value after '?'", at, last);
    at = skip_blanks(at, last);
    if (at == last || *at != ':') throw_unclosed(":", "choice", question, question + 1, at, last);
    if (!this->right.parse(++at, last, context, rcontext, node.no))
      throw_expected("a value after ':'", at, last);
    nest.leave();
    node.condition = std::move(out);
    node.span = state.span(state.begin + ast::span_of(node.condition).begin, at);
    out = std::move(node);
    first = at;
    return true;
  }
};
template <class Condition, class Branch>
constexpr auto ternary(Condition const& condition, Branch const& branch) {
  using C = typename x3::extension::as_parser<Condition>::value_type;
  using B = typename x3::extension::as_parser<Branch>::value_type;
  return TernaryDirective<C, B>(x3::as_parser(condition), x3::as_parser(branch));
}

} // namespace abbe::grammar

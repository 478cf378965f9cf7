// SPDX-License-Identifier: MIT
// Calls: macros, user functions, splines, built-in functions.
#include "lang/expression.hpp"
#include "lang/function.hpp"
#include "lang/interpreter.hpp"
#include "lang/spline.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <optional>

namespace abbe::lang {
namespace {

/// How many arguments a signature asks for at least and at most (-1: any number).
std::pair<int, int> arity(std::string_view signature) {
  int least = 0;
  int most = 0;
  bool optional = false;
  for (char const c : signature) {
    if (c == '?')
      optional = true;
    else if (c == '*')
      return {least, -1};
    else {
      ++most;
      if (!optional) ++least;
    }
  }
  return {least, most};
}

std::string count_text(int least, int most) {
  if (most < 0) return fmt::format("at least {}", least);
  return least == most ? fmt::format("{}", least) : fmt::format("{} to {}", least, most);
}

class ArgumentReader {
public:
  ArgumentReader(Interpreter& in, std::string_view function) : in_(in), function_(function) {}

  /// @return false when the argument is wrong (reported)
  bool read(ast::Items const& items, char kind, Span call, Argument& out) {
    ast::Expr const* const only = Expressions::sole(items);
    out.span = only ? ast::span_of(*only) : call;
    if (kind == 's') return read_text(items, only, out);
    if (only) {
      out.number = in_.expressions.numeric(*only);
    } else {
      out.number = in_.expressions.to_numeric(in_.reader.value_of(items, call), call);
    }
    if (out.number.poisoned()) return false;
    if (kind == 'f' && out.number.size > 1) return wrong(out, "a float");
    if (kind == 'v') {
      if (out.number.size > 3) return wrong(out, "a vector of three components");
      out.number = out.number.promoted(3);
    }
    return true;
  }

private:
  bool read_text(ast::Items const& items, ast::Expr const* only, Argument& out) {
    Value value = only ? in_.expressions.value(*only) : in_.reader.value_of(items, out.span);
    if (auto* text = std::get_if<std::string>(&value.any)) {
      out.text = std::move(*text);
      return true;
    }
    auto const* number = std::get_if<Numeric>(&value.any);
    if (value.empty() || (number && number->poisoned())) return false;
    in_.error("E0302", fmt::format("'{}' wants a string here, not {}", function_, type_name(value)),
              out.span);
    return false;
  }
  bool wrong(Argument const& argument, std::string_view wanted) {
    Value value;
    value.any = argument.number;
    in_.error("E0302",
              fmt::format("'{}' wants {} here, not {}", function_, wanted, type_name(value)),
              argument.span);
    return false;
  }

  Interpreter& in_;
  std::string_view function_;
};

/// Commas between arguments are optional, but not where there may be any number of them (`min`):
/// the call with an argument for each expression, if some stand in a row.
std::optional<ast::Call> apart(ast::Call const& node) {
  auto const whole = [](ast::Items const& items) {
    return std::ranges::all_of(items,
                               [](ast::Item const& item) { return ast::get_if<ast::Expr>(item); });
  };
  bool const in_a_row = std::ranges::any_of(
      node.arguments, [&](ast::Items const& items) { return items.size() > 1 && whole(items); });
  if (!in_a_row) return std::nullopt;
  ast::Call call = node;
  call.arguments.clear();
  for (ast::Items const& items : node.arguments) {
    if (!whole(items)) {
      call.arguments.push_back(items);
      continue;
    }
    for (ast::Item const& item : items) call.arguments.push_back({item});
  }
  return call;
}

/// Number or text of a built-in function; an empty Value after an error.
Value call_builtin(Interpreter& in, Builtin const& function, ast::Call const& node) {
  CallContext context{in, node.span, function.name};
  Value result;
  if (function.special) {
    Numeric const n = function.special(context, node);
    if (!context.failed) result.any = n;
    return result;
  }
  bool const none = node.arguments.size() == 1 && node.arguments.front().empty();
  auto const given = none ? 0 : node.arguments.size();
  auto const [least, most] = arity(function.signature);
  if (static_cast<int>(given) < least || (most >= 0 && static_cast<int>(given) > most)) {
    in.error("E0316",
             fmt::format("'{}' takes {} arguments, not {}", function.name, count_text(least, most),
                         given),
             node.span);
    return result;
  }
  Argument few[5];
  std::vector<Argument> many;
  std::span<Argument> arguments(few, std::min<std::size_t>(given, 5));
  if (given > 5) {
    many.resize(given);
    arguments = many;
  }
  ArgumentReader reader(in, function.name);
  std::size_t kind = 0;
  bool good = true;
  for (std::size_t i = 0; i < given; ++i) {
    if (kind < function.signature.size() && function.signature[kind] == '?') ++kind;
    if (kind < function.signature.size() && function.signature[kind] == '*') --kind;
    good =
        reader.read(node.arguments[i], function.signature[kind], node.span, arguments[i]) && good;
    ++kind;
  }
  if (!good) return result;
  if (function.yields_string) {
    std::string text = function.text(context, arguments);
    if (!context.failed) result.any = std::move(text);
  } else {
    Numeric const n = function.compute(context, arguments);
    if (!context.failed) result.any = n;
  }
  return result;
}

} // namespace

Numeric CallContext::fail(std::string_view message) {
  failed = true;
  in.error("E0306", fmt::format("{}: {}", name, message), span);
  return poison();
}

Value Expressions::call(ast::Call const& node) {
  Symbol const symbol = in_.scope.symbol(node.callee);
  if (Builtin const* const builtin = find_builtin(symbol)) {
    bool const any_number = builtin->signature.ends_with('*') && !builtin->yields_string;
    auto const split = any_number ? std::nullopt : apart(node);
    return call_builtin(in_, *builtin, split ? *split : node);
  }
  Value value;
  Value const* const called = callee(node);
  if (!called) return value;
  if (auto const* macro = std::get_if<MacroValue>(&called->any)) {
    MacroValue const copy = *macro; // the macro may redefine itself
    return in_.reader.macro_value(node, copy);
  }
  auto const split = apart(node);
  Numeric const n = call_numeric(split ? *split : node, *called);
  if (!n.poisoned()) value.any = n;
  return value;
}

Value const* Expressions::callee(ast::Call const& node) {
  if (!node.element.empty()) return set_element(node.element.front());
  Value const* const found = in_.scope.find(in_.scope.symbol(node.callee));
  if (!found || found->empty()) {
    undeclared(node.callee);
    return nullptr;
  }
  use_deprecated(node.callee);
  return found;
}

Numeric Expressions::call_numeric(ast::Call const& node, Value const& callee) {
  auto const* function = std::get_if<std::shared_ptr<FunctionValue>>(&callee.any);
  auto const* spline = std::get_if<std::shared_ptr<SplineValue>>(&callee.any);
  if (!function && !spline) {
    auto const* number = std::get_if<Numeric>(&callee.any);
    if (!number || !number->poisoned())
      in_.error(
          "E0317",
          fmt::format("'{}' is {}, which cannot be called", node.callee.text, type_name(callee)),
          node.span);
    return poison();
  }
  if (spline) {
    auto const held = *spline;
    return call_spline(*held, node, in_);
  }
  auto const held = *function;
  if (!held->unsupported.empty()) {
    in_.error("E0902", held->unsupported, node.span);
    return poison();
  }
  std::vector<double> arguments;
  ArgumentReader reader(in_, node.callee.text);
  bool good = true;
  for (auto const& items : node.arguments) {
    if (items.empty()) continue;
    Argument argument;
    good = reader.read(items, 'n', node.span, argument) && good;
    if (!good) continue;
    // `F(p)` with a vector gives its components, as `F(p.x, p.y, p.z)` does.
    bool const spread =
        argument.number.size > 1 && node.arguments.size() == 1 && held->parameters > 1;
    if (argument.number.size > 1 && !spread) {
      in_.error("E0302", fmt::format("'{}' wants a float here, not a vector", node.callee.text),
                argument.span);
      good = false;
    }
    for (std::size_t i = 0; i < (spread ? argument.number.size : 1u); ++i)
      arguments.push_back(argument.number.c[i]);
  }
  if (!good) return poison();
  if (arguments.size() != held->parameters) {
    in_.error("E0316",
              fmt::format("'{}' takes {} arguments, not {}", node.callee.text, held->parameters,
                          arguments.size()),
              node.span);
    return poison();
  }
  return evaluate_function(*held, arguments);
}

Numeric Expressions::operator()(ast::Call const& node) {
  return to_numeric(call(node), node.span);
}

} // namespace abbe::lang

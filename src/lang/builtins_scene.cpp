// SPDX-License-Identifier: MIT
// Functions that ask about names, arrays, files and objects.
#include "lang/builtins.hpp"
#include "lang/interpreter.hpp"

#include <cmath>
#include <fmt/format.h>

namespace abbe::lang {
namespace {

using Arguments = std::span<Argument const>;

Numeric defined(CallContext& context, ast::Call const& node) {
  ast::Expr const* const target =
      node.arguments.size() == 1 ? Expressions::sole(node.arguments[0]) : nullptr;
  if (!target) return context.fail("expected a name or an element of an array");
  return scalar_of(context.in.reader.is_defined(*target) ? 1 : 0);
}

std::shared_ptr<ArrayValue> array_argument(CallContext& context, ast::Items const& items) {
  ast::Expr const* const only = Expressions::sole(items);
  Value const* value = nullptr;
  if (only) {
    if (auto const* name = ast::get_if<ast::Name>(*only); name && !name->reserved)
      value = context.in.scope.find(context.in.scope.symbol(*name));
    else if (auto const* index = ast::get_if<ast::Index>(*only))
      value = context.in.expressions.element(*index);
  }
  auto const* array = value ? std::get_if<std::shared_ptr<ArrayValue>>(&value->any) : nullptr;
  if (array) return *array;
  context.fail("expected an array");
  return nullptr;
}

Numeric dimensions(CallContext& context, ast::Call const& node) {
  if (node.arguments.size() != 1) return context.fail("takes one array");
  auto const array = array_argument(context, node.arguments[0]);
  return array ? scalar_of(static_cast<double>(array->sizes.size())) : poison();
}

Numeric dimension_size(CallContext& context, ast::Call const& node) {
  ast::Expr const* const which =
      node.arguments.size() == 2 ? Expressions::sole(node.arguments[1]) : nullptr;
  if (!which) return context.fail("takes an array and the number of a dimension");
  auto const array = array_argument(context, node.arguments[0]);
  if (!array) return poison();
  double const d = std::trunc(context.in.expressions.scalar(*which, "the number of a dimension"));
  bool const there = d >= 1 && d <= static_cast<double>(array->sizes.size());
  return scalar_of(there ? array->sizes[static_cast<std::size_t>(d) - 1] : 0);
}

Numeric file_exists(CallContext& context, Arguments a) {
  return scalar_of(context.in.files.exists(a[0].text, context.span.source) ? 1 : 0);
}

Numeric not_yet(CallContext& context, ast::Call const&) {
  context.failed = true;
  context.in.error("E0901", fmt::format("'{}' is not supported yet", context.name), context.span);
  return poison();
}

Builtin special(std::string_view name, Numeric (*compute)(CallContext&, ast::Call const&)) {
  return {name, "!", false, nullptr, nullptr, compute};
}

} // namespace

std::span<Builtin const> scene_builtins() {
  static Builtin const table[] = {
      special("defined", defined),
      special("dimensions", dimensions),
      special("dimension_size", dimension_size),
      {"file_exists", "s", false, file_exists},
      special("inside", not_yet),
      special("trace", not_yet),
      special("min_extent", not_yet),
      special("max_extent", not_yet),
  };
  return table;
}

} // namespace abbe::lang

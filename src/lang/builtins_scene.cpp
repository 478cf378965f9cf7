// SPDX-License-Identifier: MIT
// Functions that ask about names, arrays, files and objects.
#include "lang/builtins.hpp"
#include "lang/interpreter.hpp"
#include "lang/object_query.hpp"

#include <cmath>
#include <optional>

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

/// The object that the first argument names, ready for questions; null after a complaint. A scene
/// asks many questions about one object, so the last one is kept.
ObjectQuery const* object_argument(CallContext& context, ast::Call const& node) {
  using Object = std::shared_ptr<scene::Object const>;
  thread_local std::weak_ptr<scene::Object const> known;
  thread_local std::optional<ObjectQuery> query;
  if (node.arguments.empty()) {
    context.fail("expected an object");
    return nullptr;
  }
  Value value;
  Few<Diagnostic> deferred;
  {
    Deferral deferral(context.in);
    value = context.in.reader.value_of(node.arguments[0], context.span);
    deferred = deferral.take();
  }
  // The answer is a number, which keeps nothing: told here.
  for (Diagnostic const& told : deferred) context.in.add(told);
  auto const* object = std::get_if<Object>(&value.any);
  if (!object || !*object) {
    if (value.empty())
      context.failed = true; // reported where it was read
    else
      context.fail("expected an object as the first argument");
    return nullptr;
  }
  if (known.lock() != *object || !query) {
    query.emplace(ObjectQuery::of(**object));
    known = *object;
  }
  if (!query->nothing() || deferred.empty()) return &*query;
  context.failed = true;
  return nullptr;
}

/// A vector argument; nullopt after a complaint.
std::optional<Vec3> vector_argument(CallContext& context, ast::Call const& node,
                                    std::size_t index) {
  ast::Expr const* const only =
      index < node.arguments.size() ? Expressions::sole(node.arguments[index]) : nullptr;
  if (!only) {
    context.fail("takes an object and vectors");
    return std::nullopt;
  }
  Numeric const n = context.in.expressions.numeric(*only);
  if (n.size == 0) {
    context.failed = true;
    return std::nullopt;
  }
  return n.promoted(3).vec3();
}

Numeric inside(CallContext& context, ast::Call const& node) {
  ObjectQuery const* const object = object_argument(context, node);
  auto const point = object ? vector_argument(context, node, 1) : std::nullopt;
  return point ? scalar_of(object->inside(*point) ? 1 : 0) : poison();
}

Numeric trace(CallContext& context, ast::Call const& node) {
  ObjectQuery const* const object = object_argument(context, node);
  if (!object) return poison();
  auto const start = vector_argument(context, node, 1);
  auto const direction = start ? vector_argument(context, node, 2) : std::nullopt;
  if (!direction) return poison();
  if (!(glm::length(*direction) > 0)) return context.fail("the direction must not be zero");
  auto const hit = object->trace(*start, *direction);
  if (node.arguments.size() > 3) {
    // By reference: an existing vector receives the normal, zero on a miss.
    ast::Expr const* const target = Expressions::sole(node.arguments[3]);
    auto const* name = target ? ast::get_if<ast::Name>(*target) : nullptr;
    Value* const value =
        name && !name->reserved ? context.in.scope.find(context.in.scope.symbol(*name)) : nullptr;
    if (!value) return context.fail("the fourth argument must be the name of a declared vector");
    value->any = vector_of(hit ? hit->normal : Vec3(0));
  }
  return vector_of(hit ? hit->point : Vec3(0));
}

Numeric extent(CallContext& context, ast::Call const& node, Vec3 geometry::Bounds::*corner) {
  ObjectQuery const* const object = object_argument(context, node);
  if (!object) return poison();
  if (object->nothing()) return context.fail("this object is nothing: it has no extent");
  return vector_of(object->bounds().*corner);
}
Numeric min_extent(CallContext& context, ast::Call const& node) {
  return extent(context, node, &geometry::Bounds::low);
}
Numeric max_extent(CallContext& context, ast::Call const& node) {
  return extent(context, node, &geometry::Bounds::high);
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
      special("inside", inside),
      special("trace", trace),
      special("min_extent", min_extent),
      special("max_extent", max_extent),
  };
  return table;
}

} // namespace abbe::lang

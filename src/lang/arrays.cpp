// SPDX-License-Identifier: MIT
#include "lang/arrays.hpp"

#include "lang/interpreter.hpp"

#include <cmath>
#include <fmt/format.h>

namespace abbe::lang {

Value copy_of(Value const& value) {
  Value copy = value;
  if (auto* array = std::get_if<std::shared_ptr<ArrayValue>>(&copy.any)) {
    auto elements = std::make_shared<ArrayValue>(**array);
    for (auto& element : elements->elements)
      if (std::holds_alternative<std::shared_ptr<ArrayValue>>(element.any))
        element = copy_of(element);
    *array = std::move(elements);
  }
  return copy;
}

bool ArrayValue::admit(Value const& value) {
  auto const* number = std::get_if<Numeric>(&value.any);
  if (number && number->poisoned()) return true;
  // A float, vectors by their size, and every other kind of value by itself.
  int const kind = number ? -1 - number->size : static_cast<int>(value.any.index());
  if (type == -1) {
    type = kind;
    type_text = type_name(value);
  }
  return type == kind;
}

std::string_view type_name(Value const& value) {
  constexpr std::string_view sizes[] = {"nothing",  "a float",    "a 2-vector",
                                        "a vector", "a 4-vector", "a colour"};
  constexpr std::string_view kinds[] = {"nothing",         "",
                                        "a string",        "a spectral colour",
                                        "an array",        "a macro",
                                        "a function",      "a spline",
                                        "a file",          "an object",
                                        "a pigment",       "a finish",
                                        "a texture",       "an interior",
                                        "a material",      "a map",
                                        "a transform",     "a camera",
                                        "a light",         "a sky sphere",
                                        "a glass",         "a spectrum",
                                        "a normal",        "a map of normals",
                                        "a map of slopes", "a map of textures",
                                        "a medium",        "a fog",
                                        "a rainbow",       "a thing that is not supported yet"};
  static_assert(std::size(kinds) == std::variant_size_v<Value::Any>);
  if (auto const* number = std::get_if<Numeric>(&value.any)) return sizes[number->size];
  return kinds[value.any.index()];
}

std::shared_ptr<ArrayValue> Expressions::array_of(ast::Index const& node) {
  Symbol const symbol = in_.scope.symbol(node.array);
  Value const* const value = in_.scope.find(symbol);
  if (!value || value->empty()) {
    undeclared(node.array);
    return nullptr;
  }
  use_deprecated(node.array);
  if (auto const* array = std::get_if<std::shared_ptr<ArrayValue>>(&value->any)) return *array;
  auto const* number = std::get_if<Numeric>(&value->any);
  if (!number || !number->poisoned())
    in_.error("E0309", fmt::format("'{}' is {}, not an array", node.array.text, type_name(*value)),
              node.array.span);
  return nullptr;
}

std::shared_ptr<Value> Expressions::element_cell(ast::Index const& node) {
  std::shared_ptr<ArrayValue> array = array_of(node);
  if (!array) return nullptr;
  // More subscripts than dimensions reach into an array of arrays.
  std::size_t used = 0;
  for (;;) {
    std::size_t const dimensions = array->sizes.size();
    if (node.subscripts.size() - used < dimensions) {
      in_.error("E0313",
                fmt::format("array '{}' has {} dimension{}, {} given", node.array.text, dimensions,
                            dimensions == 1 ? "" : "s", node.subscripts.size() - used),
                node.span);
      return nullptr;
    }
    std::size_t place = 0;
    for (std::size_t d = 0; d < dimensions; ++d) {
      ast::Expr const& subscript = node.subscripts[used + d];
      double const at = scalar(subscript, "a subscript");
      // As POV-Ray: toward zero, with its tolerance.
      auto const whole = std::trunc(at + std::copysign(1e-10, at));
      if (!(whole >= 0 && whole < array->sizes[d])) {
        in_.error("E0311",
                  fmt::format("subscript {} is outside array '{}': 0 .. {}", at, node.array.text,
                              array->sizes[d] - 1),
                  ast::span_of(subscript));
        return nullptr;
      }
      place = place * static_cast<std::size_t>(array->sizes[d]) + static_cast<std::size_t>(whole);
    }
    used += dimensions;
    Value& element = array->elements[place];
    if (used == node.subscripts.size()) return {array, &element};
    auto const* inner = std::get_if<std::shared_ptr<ArrayValue>>(&element.any);
    if (!inner) {
      in_.error("E0313", fmt::format("array '{}' has fewer dimensions", node.array.text),
                node.span);
      return nullptr;
    }
    array = *inner;
  }
}

Value* Expressions::element(ast::Index const& node) {
  return element_cell(node).get();
}

Value* Expressions::set_element(ast::Index const& node) {
  Value* const found = element(node);
  if (!found || !found->empty()) return found;
  in_.error("E0310", fmt::format("element of array '{}' has no value yet", node.array.text),
            node.span);
  return nullptr;
}

/// Fills one dimension from `{ ... }`. @return false after an error
bool Expressions::fill(ArrayValue& array, ast::Items const& items, std::size_t dimension,
                       std::size_t& next, Span span) {
  auto& reader = in_.reader;
  bool const last = dimension + 1 == array.sizes.size();
  int const wanted = array.sizes[dimension];
  int count = 0;
  reader.enter_region(items, span);
  bool good = true;
  while (good && !reader.at_end()) {
    Span const place = reader.next_span();
    if (count == wanted) {
      in_.error("E0314", fmt::format("more than {} values for this dimension of the array", wanted),
                place);
      good = false;
      break;
    }
    if (last) {
      Deferral deferral(in_);
      Value value = reader.read_value();
      value.declared_at = place;
      value.deferred = deferral.take();
      if (value.empty()) value.any = poison();
      if (!array.admit(value)) {
        in_.error("E0312",
                  fmt::format("the array holds {} per element, not {}", array.type_text,
                              type_name(value)),
                  place);
        good = false;
      }
      array.elements[next++] = std::move(value);
    } else if (ast::Items const* const row = reader.take_row()) {
      good = fill(array, *row, dimension + 1, next, place);
    } else {
      reader.unexpected("a row of the array in braces");
      good = false;
    }
    ++count;
  }
  while (!good && !reader.at_end()) reader.skip();
  reader.leave_region();
  if (good && count < wanted)
    in_.error("E0314",
              fmt::format("{} values for this dimension of the array, {} given", wanted, count),
              span);
  return good && count == wanted;
}

Value Expressions::array(ast::Array const& node) {
  auto made = std::make_shared<ArrayValue>();
  double total = 1;
  Value value;
  if (node.sizes.empty() || node.sizes.size() > 5) {
    in_.error("E0313", "an array has one to five dimensions", node.span);
    return value;
  }
  for (auto const& size : node.sizes) {
    double const n = std::floor(scalar(size, "the size of an array") + 1e-10);
    if (!(n >= 1)) {
      in_.error("E0315", fmt::format("the size of an array must be at least 1, not {}", n),
                ast::span_of(size));
      return value;
    }
    total *= n;
    if (total > max_array_elements) {
      in_.error("E0705",
                fmt::format("an array of {:.0f} elements is more than the limit of {:.0f}", total,
                            max_array_elements),
                ast::span_of(size));
      return value;
    }
    made->sizes.push_back(static_cast<int>(n));
  }
  made->elements.resize(static_cast<std::size_t>(total));
  std::size_t next = 0;
  if (node.has_elements) fill(*made, node.elements, 0, next, node.span);
  value.any = std::move(made);
  return value;
}

} // namespace abbe::lang

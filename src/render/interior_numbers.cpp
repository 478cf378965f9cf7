// SPDX-License-Identifier: MIT
#include "render/interior_numbers.hpp"

#include <algorithm>

namespace abbe::render {
namespace {

bool is_plain(scene::Interior const& interior) {
  return interior.glass == nullptr && interior.priority == 0;
}

} // namespace

void InteriorNumbers::read(scene::Object const& object) {
  if (object.interior) {
    plain_ = plain_ || is_plain(*object.interior);
    priorities_ = priorities_ || object.interior->priority != 0;
  }
  for (auto const& child : object.children) read(child);
}

std::int32_t InteriorNumbers::fresh(std::shared_ptr<scene::Interior const> const& interior) {
  stage_.interiors.push_back({interior ? media_.add(interior) : 0, false});
  return static_cast<std::int32_t>(stage_.interiors.size()) - 1;
}

InteriorNumbers::Owner InteriorNumbers::begin(scene::Object const& object) {
  Owner const around = owner_;
  if (depth_++ == 0) without_ = -1;
  bool const shape = object.kind == scene::Object::Kind::Shape;
  if (acts() && !shape && object.interior.get() != owner_.interior)
    owner_ = {object.interior.get(),
              object.interior && is_plain(*object.interior) ? fresh(object.interior) : -1};
  return around;
}

InteriorNumbers::Number InteriorNumbers::of_shape(scene::Object const& object, bool opaque) {
  Number out;
  if (!acts() || (opaque && !object.interior)) {
    out.kind = object.interior ? Number::Kind::Body : Number::Kind::None;
  } else if (object.interior && !is_plain(*object.interior)) {
    out.kind = Number::Kind::Body;
  } else if (object.interior && object.interior.get() == owner_.interior) {
    out.kind = Number::Kind::Shared;
    out.number = owner_.number;
  } else if (!object.interior && depth_ > 1) {
    if (without_ < 0) without_ = fresh(nullptr);
    out.kind = Number::Kind::Shared;
    out.number = without_;
  } else {
    out.kind = Number::Kind::Alone;
    out.interior = object.interior;
  }
  return out;
}

void InteriorNumbers::share(Number& number) {
  if (number.kind != Number::Kind::Alone) return;
  number.kind = Number::Kind::Shared;
  number.number = fresh(number.interior);
}

void InteriorNumbers::assign(Number& number, geometry::CsgTree const& tree) {
  share(number);
  if (number.kind == Number::Kind::Mixed) return;
  auto& numbers = stage_.primitive_interiors;
  each_primitive(tree, [&](geometry::PrimitiveId primitive) {
    if (numbers.size() <= primitive) numbers.resize(std::size_t{primitive} + 1, -1);
    numbers[primitive] = number.number;
  });
}

void InteriorNumbers::settle(Number number, geometry::CsgTree const& tree,
                             transport::CompiledSolid& solid) {
  if (number.kind == Number::Kind::None || number.kind == Number::Kind::Body) return;
  solid.plain = solid.has_medium = true;
  solid.open = solid.open || solid.leaks;
  if (solid.open) share(number);
  solid.interior = number.number;
  solid.by_primitive = number.kind == Number::Kind::Mixed;
  if (!solid.shuts_out_air) return;
  auto const shut = [&](std::int32_t n) {
    if (n >= 0) stage_.interiors[static_cast<std::size_t>(n)].shuts_out_air = true;
  };
  shut(number.number);
  if (solid.by_primitive)
    each_primitive(tree, [&](auto p) { shut(stage_.primitive_interiors[p]); });
}

bool InteriorNumbers::refracts(geometry::CsgTree const& tree,
                               transport::CompiledSolid const& solid) const {
  auto const bends = [&](int medium) {
    return stage_.media[static_cast<std::size_t>(medium)].refracts();
  };
  if (!solid.by_primitive) return bends(solid.medium);
  bool any = false;
  each_primitive(tree, [&](auto primitive) {
    std::int32_t const n = stage_.primitive_interiors[primitive];
    any = any || (n >= 0 && bends(stage_.interiors[static_cast<std::size_t>(n)].medium));
  });
  return any;
}

} // namespace abbe::render

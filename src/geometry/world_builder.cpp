// SPDX-License-Identifier: MIT
#include "geometry/world_builder.hpp"

#include "geometry/world_impl.hpp"

#include <algorithm>

namespace abbe::geometry {

WorldBuilder::WorldBuilder() : impl_(std::make_unique<World::Impl>()) {}
WorldBuilder::~WorldBuilder() = default;

void WorldBuilder::reserve(std::size_t primitives, std::size_t solids) {
  impl_->primitives.reserve(primitives);
  impl_->solids.reserve(solids);
  impl_->state_of.reserve(solids);
}

PrimitiveId WorldBuilder::add(ShapePtr shape, Transform const& placement) {
  impl_->primitives.emplace_back(std::move(shape), placement);
  return static_cast<PrimitiveId>(impl_->primitives.size() - 1);
}

SolidId WorldBuilder::add(World::Solid const& solid) {
  auto const id = static_cast<SolidId>(impl_->solids.size());
  impl_->solids.emplace_back(solid, impl_->primitives, id);
  impl_->state_of.push_back(impl_->solids.back().has_program() ? impl_->states++ : 0);
  joins_.push_back(solid.joins);
  return id;
}

Shape const& WorldBuilder::shape(PrimitiveId id) const {
  return impl_->primitives[id].shape();
}

World WorldBuilder::finish(double contact) && {
  World::Impl& impl = *impl_;
  impl.all = impl.make_group(0xff);
  // What asks for a bit that few have should not pass by all the others.
  for (unsigned bit = 1; bit <= 0x80; bit *= 2) {
    auto const mask = static_cast<std::uint8_t>(bit);
    auto const having =
        std::count_if(impl.solids.begin(), impl.solids.end(),
                      [&](TracedSolid const& solid) { return (solid.mask() & mask) != 0; });
    if (static_cast<std::size_t>(having) * 2 <= impl.solids.size()) {
      impl.some.push_back(impl.make_group(mask));
    }
  }
  if (contact > 0 && std::find(joins_.begin(), joins_.end(), true) != joins_.end()) {
    std::vector<Bounds> joining;
    for (SolidId id = 0; id < impl.solids.size(); ++id) {
      joining.push_back(joins_[id] ? impl.bounds(id) : Bounds{});
    }
    impl.contacts = Contacts(joining, contact);
  }
  return World(std::move(impl_));
}

World::World(std::vector<PlacedShape> const& primitives, std::vector<Solid> const& solids,
             double contact) {
  WorldBuilder builder;
  builder.reserve(primitives.size(), solids.size());
  for (PlacedShape const& placed : primitives) builder.add(placed.shape, placed.placement);
  for (Solid const& solid : solids) builder.add(solid);
  *this = std::move(builder).finish(contact);
}

} // namespace abbe::geometry

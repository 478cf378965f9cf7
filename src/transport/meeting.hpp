// SPDX-License-Identifier: MIT
#pragma once

#include "transport/buckets.hpp"
#include "transport/way.hpp"

namespace abbe::transport {

/// The bucket of a ray that met something, and what it is inside of then. Surfaces that are
/// displaced by a medium of higher priority are taken out of the hit and its group.
/// @param k place of the ray among the hits @pre hits.hit[k] is not Nothing
inline BucketKey meeting_of(Stage const& stage, MediaStacks& stacks, geometry::Hits& hits,
                            std::size_t k, MediaStacks::Id before, MediaStacks::Id& after) {
  geometry::RayHit& hit = hits.hit[k];
  geometry::HitGroup* const group =
      hit.kind == geometry::RayHit::Kind::Group ? &hits.groups[hits.group[k]] : nullptr;
  after = group != nullptr ? stacks.after(before, group->crossings) : stacks.after(before, hit);
  bool const shown =
      !stage.has_priorities || drop_displaced(stage, stacks, before, after, hit, group);
  BucketKey key;
  key.before = stacks.medium(before);
  key.after = stacks.medium(after);
  key.left = stacks.left(before, after);
  if (group != nullptr) {
    key.kind = BucketKey::Kind::Several;
    key.number = hits.group[k];
  } else {
    key.kind = shown ? BucketKey::Kind::Surface : BucketKey::Kind::Displaced;
    key.surface = shown ? surface_class(stage.textures, hit.primitive) : 0;
    key.entering = hit.entering;
  }
  return key;
}

} // namespace abbe::transport

// SPDX-License-Identifier: MIT
#pragma once

#include "transport/stage.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace abbe::transport {

/// What a ray met, as far as rays are worked on together that met the like. Nothing in it depends
/// on which other rays there are: the order of the keys is that of sums.
struct BucketKey {
  enum class Kind : std::uint8_t {
    Nothing,
    Surface,   ///< one
    Displaced, ///< one, where a medium of higher priority displaces its own
    Several    ///< surfaces that coincide: `number` is that of a group
  };
  Kind kind = Kind::Nothing;
  bool entering = false;
  std::int32_t left = 0;              ///< medium whose light fades here, having been left; 0: none
  std::int32_t surface = 0;           ///< class (surface_class)
  std::int32_t before = 0, after = 0; ///< media
  std::uint32_t number = 0;
  bool operator==(BucketKey const&) const = default;
};

/// Surfaces that one look at: of one layer each and one finish, or of the same layers.
std::int32_t surface_class(surface::Textures const& textures, geometry::PrimitiveId primitive);

/// Rays sorted by what they met, each bucket in the order of the rays.
class Buckets {
public:
  /// @param groups that keys of Several speak of: those of the same surfaces are one bucket
  void sort(std::span<BucketKey const> keys, geometry::Groups const& groups);
  /// visit(key, places) in the order of the keys.
  template <class Visit>
  void each(Visit&& visit) const {
    for (std::uint32_t const bucket : order_) {
      std::uint32_t const first = bucket > 0 ? ends_[bucket - 1] : 0;
      visit(keys_[bucket], std::span(places_).subspan(first, ends_[bucket] - first));
    }
  }

private:
  void grow();
  std::uint32_t bucket_of(BucketKey const& key, geometry::Groups const& groups);
  std::vector<BucketKey> keys_; ///< by bucket
  /// Neighbouring rays of one bucket.
  struct Run {
    std::uint32_t first, end, bucket;
  };
  std::vector<Run> runs_;
  std::vector<std::uint32_t> ends_, order_, places_, table_;
};

} // namespace abbe::transport

// SPDX-License-Identifier: MIT
#include "transport/buckets.hpp"

#include <algorithm>
#include <compare>
#include <numeric>
#include <tuple>

namespace abbe::transport {
namespace {

using geometry::HitGroup;

auto tied(geometry::SurfaceCrossing const& c) {
  return std::tie(c.solid, c.primitive, c.face, c.entering, c.toggles);
}
auto tied(geometry::Departure::On const& m) {
  return std::tie(m.primitive, m.face, m.was_entering);
}

/// By the surfaces, not by where they are met.
std::weak_ordering compare(HitGroup const& a, HitGroup const& b) {
  auto const by_parts = [](auto const& x, auto const& y) {
    return std::lexicographical_compare_three_way(
        x.begin(), x.end(), y.begin(), y.end(),
        [](auto const& p, auto const& q) { return std::weak_order(tied(p), tied(q)); });
  };
  auto const order = by_parts(a.crossings, b.crossings);
  return order != 0 ? order : by_parts(a.members, b.members);
}

auto tied(BucketKey const& k) {
  return std::tie(k.kind, k.surface, k.before, k.after, k.entering, k.left);
}

bool same(BucketKey const& a, BucketKey const& b, geometry::Groups const& groups) {
  if (tied(a) != tied(b)) return false;
  return a.kind != BucketKey::Kind::Several || compare(groups[a.number], groups[b.number]) == 0;
}

/// Room of the table at first: a power of two.
constexpr std::size_t least_table = 64;

std::uint64_t hash(BucketKey const& k) {
  std::uint64_t word =
      static_cast<std::uint64_t>(static_cast<std::uint32_t>(k.surface)) << 32
      | static_cast<std::uint64_t>(k.before) << 18 | static_cast<std::uint64_t>(k.after) << 4
      | static_cast<std::uint64_t>(k.kind) << 2 | (k.entering ? 2U : 0U) | (k.left != 0 ? 1U : 0U);
  word *= 0x9e3779b97f4a7c15U;
  return word >> 32;
}

} // namespace

std::int32_t surface_class(surface::Textures const& textures, geometry::PrimitiveId primitive) {
  int const number = textures.surfaces.number(primitive);
  return number < 0 ? number : textures.layers[static_cast<std::size_t>(number)].finish;
}

std::uint32_t Buckets::bucket_of(BucketKey const& key, geometry::Groups const& groups) {
  std::size_t const mask = table_.size() - 1;
  for (std::size_t at = hash(key) & mask;; at = (at + 1) & mask) {
    if (table_[at] == 0) {
      keys_.push_back(key);
      ends_.push_back(0);
      table_[at] = static_cast<std::uint32_t>(keys_.size());
      if (2 * keys_.size() > table_.size()) grow();
      return static_cast<std::uint32_t>(keys_.size() - 1);
    }
    if (same(keys_[table_[at] - 1], key, groups)) return table_[at] - 1;
  }
}

void Buckets::grow() {
  table_.assign(2 * table_.size(), 0);
  std::size_t const mask = table_.size() - 1;
  for (std::size_t bucket = 0; bucket < keys_.size(); ++bucket) {
    std::size_t at = hash(keys_[bucket]) & mask;
    while (table_[at] != 0) at = (at + 1) & mask;
    table_[at] = static_cast<std::uint32_t>(bucket + 1);
  }
}

void Buckets::sort(std::span<BucketKey const> keys, geometry::Groups const& groups) {
  keys_.clear();
  ends_.clear();
  table_.assign(least_table, 0);
  places_.resize(keys.size());
  runs_.clear();
  for (std::uint32_t first = 0, end; first < keys.size(); first = end) {
    for (end = first + 1; end < keys.size() && keys[end] == keys[first];) ++end;
    std::uint32_t const bucket = bucket_of(keys[first], groups);
    ends_[bucket] += end - first;
    runs_.push_back({first, end, bucket});
  }
  std::uint32_t at = 0;
  for (std::uint32_t& end : ends_) at += std::exchange(end, at);
  for (auto const& [first, end, bucket] : runs_) {
    std::iota(places_.begin() + ends_[bucket], places_.begin() + ends_[bucket] + (end - first),
              first);
    ends_[bucket] += end - first;
  }
  order_.resize(keys_.size());
  std::iota(order_.begin(), order_.end(), 0U);
  std::sort(order_.begin(), order_.end(), [&](std::uint32_t a, std::uint32_t b) {
    BucketKey const &x = keys_[a], &y = keys_[b];
    auto const order = std::weak_order(tied(x), tied(y));
    if (order != 0 || x.kind != BucketKey::Kind::Several) return order < 0;
    return compare(groups[x.number], groups[y.number]) < 0;
  });
}

} // namespace abbe::transport

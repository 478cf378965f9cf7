// SPDX-License-Identifier: MIT
#include "base/random.hpp"
#include "transport/buckets.hpp"

#include <algorithm>
#include <gtest/gtest.h>
#include <numeric>

namespace abbe::transport::testing {
namespace {

using Kind = BucketKey::Kind;

/// Three groups of the same two surfaces met at different places, then one of another face, and one
/// that is without a member.
geometry::Groups groups_of_two() {
  geometry::Groups groups;
  for (int number = 0; number < 5; ++number) {
    geometry::HitGroup& group = groups.add();
    group.t = 10 - number;
    group.point = Vec3(number);
    group.crossings = {{0, 2, 0, group.t, true, true}, {1, 3, 0, group.t, false, true}};
    group.members = {{2, 0, true}, {3, 0, false}};
  }
  groups[3].crossings[1].face = 1;
  groups[4].members.pop_back();
  return groups;
}

BucketKey key_of(Kind kind, std::int32_t surface = 0, std::int32_t before = 0,
                 std::int32_t after = 0, bool entering = false, bool moves = false) {
  return {kind, entering, moves, surface, before, after, 0};
}
BucketKey several(std::uint32_t number) {
  BucketKey key = key_of(Kind::Several);
  key.number = number;
  return key;
}

struct Bucket {
  BucketKey key;
  std::vector<std::uint32_t> places;
};
std::vector<Bucket> sorted(std::vector<BucketKey> const& keys, geometry::Groups const& groups) {
  Buckets buckets;
  buckets.sort(keys, groups);
  std::vector<Bucket> out;
  buckets.each([&](BucketKey const& key, std::span<std::uint32_t const> places) {
    out.push_back({key, {places.begin(), places.end()}});
  });
  return out;
}

/// Keys of all kinds; the first in order first.
std::vector<BucketKey> in_order() {
  return {key_of(Kind::Nothing),
          key_of(Kind::Nothing, 0, 1),
          key_of(Kind::Surface, -7),
          key_of(Kind::Surface, 2),
          key_of(Kind::Surface, 2, 0, 0, true),
          key_of(Kind::Surface, 2, 0, 1, false),
          key_of(Kind::Surface, 2, 0, 1, true, false),
          key_of(Kind::Surface, 2, 0, 1, true, true),
          key_of(Kind::Surface, 2, 1),
          key_of(Kind::Surface, 3),
          key_of(Kind::Displaced),
          key_of(Kind::Displaced, 0, 2, 3),
          several(4),
          several(0),
          several(3)};
}

/// Some rays of each, in any order.
std::vector<BucketKey> mixed(std::size_t count) {
  auto const keys = in_order();
  std::vector<BucketKey> out;
  for (std::size_t k = 0; k < count; ++k)
    out.push_back(keys[static_cast<std::size_t>(RandomKey(5).uniform(k) * double(keys.size()))]);
  return out;
}

TEST(Buckets, ComeInTheOrderOfTheirKeys) {
  auto keys = in_order();
  auto const groups = groups_of_two();
  auto const expected = keys;
  for (std::uint64_t turn = 0; turn < 50; ++turn) {
    for (std::size_t k = keys.size(); k > 1; --k)
      std::swap(keys[k - 1],
                keys[static_cast<std::size_t>(RandomKey(turn).uniform(k) * double(k))]);
    auto const buckets = sorted(keys, groups);
    ASSERT_EQ(buckets.size(), expected.size());
    for (std::size_t k = 0; k < expected.size(); ++k) EXPECT_EQ(buckets[k].key, expected[k]) << k;
  }
}

TEST(Buckets, HoldAllRaysOnceInTheirOrder) {
  auto const keys = mixed(1000);
  std::vector<std::uint32_t> all;
  for (auto const& bucket : sorted(keys, groups_of_two())) {
    EXPECT_TRUE(std::is_sorted(bucket.places.begin(), bucket.places.end()));
    for (auto const place : bucket.places) EXPECT_EQ(keys[place], bucket.key);
    all.insert(all.end(), bucket.places.begin(), bucket.places.end());
  }
  std::sort(all.begin(), all.end());
  std::vector<std::uint32_t> expected(1000);
  std::iota(expected.begin(), expected.end(), 0U);
  EXPECT_EQ(all, expected);
}

TEST(Buckets, OfSurfacesThatCoincideAreByTheSurfacesNotByWhereTheyAreMet) {
  std::vector<BucketKey> const keys{several(3), several(1), several(0), several(4), several(2)};
  auto const buckets = sorted(keys, groups_of_two());
  ASSERT_EQ(buckets.size(), 3);
  EXPECT_EQ(buckets[0].places, (std::vector<std::uint32_t>{3}));
  EXPECT_EQ(buckets[1].places, (std::vector<std::uint32_t>{1, 2, 4}));
  EXPECT_EQ(buckets[2].places, (std::vector<std::uint32_t>{0}));
}

TEST(Buckets, TheOrderOfSomeRaysDoesNotDependOnTheOthers) {
  auto const keys = mixed(600);
  auto const groups = groups_of_two();
  auto const order_of = [&](std::size_t every) {
    std::vector<BucketKey> some;
    for (std::size_t k = 0; k < keys.size(); k += every) some.push_back(keys[k]);
    std::vector<std::size_t> order;
    for (auto const& bucket : sorted(some, groups))
      for (auto const place : bucket.places) order.push_back(place * every);
    return order;
  };
  auto all = order_of(1);
  std::erase_if(all, [](std::size_t k) { return k % 7 != 0; });
  EXPECT_EQ(order_of(7), all);
}

TEST(Buckets, NoRaysAreNoBuckets) {
  EXPECT_TRUE(sorted({}, {}).empty());
}

TEST(SurfaceClass, IsTheFinishOfALoneLayerAndElseTheSurfaceItself) {
  surface::Textures textures;
  textures.layers = {{0, 4, 0}, {1, 4, 0}, {2, 6, 0}};
  scene::Object const object;
  std::vector<std::vector<int>> const layers{{0}, {1}, {2}, {0, 1}, {}, {}};
  for (auto const& own : layers) textures.surfaces.add({own, {}, {}, false}, object);
  auto const of = [&](geometry::PrimitiveId primitive) {
    return surface_class(textures, primitive);
  };
  EXPECT_EQ(of(0), 4);
  EXPECT_EQ(of(1), 4); // pigments are read ray by ray
  EXPECT_EQ(of(2), 6);
  EXPECT_LT(of(3), 0);
  EXPECT_LT(of(4), 0);
  EXPECT_NE(of(3), of(4));
  EXPECT_EQ(of(4), of(5));
}

} // namespace
} // namespace abbe::transport::testing

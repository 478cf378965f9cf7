// SPDX-License-Identifier: MIT
#include "transport/way.hpp"

#include <gtest/gtest.h>

namespace abbe::transport::testing {
namespace {

LightKind const two_bands{2};
/// Whose lanes list their channels.
LightKind const listed{3, 1, 0, false, false};

/// Writes everything about a ray, of numbers that are its own.
void write(Rays& rays, std::size_t k, unsigned number) {
  auto const n = static_cast<double>(number);
  rays.origin.set(k, {n, n + 0.1, n + 0.2});
  rays.direction.set(k, {n + 0.3, n + 0.4, n + 0.5});
  rays.origin_error.set(k, {n + 0.6, n + 0.7, n + 0.8});
  rays.start[k] = {number, number + 1, geometry::RayStart::Kind::Surface, number % 2 == 0,
                   number % 3 == 0};
  rays.stack[k] = number + 2;
  rays.slot[k] = number + 3;
  rays.channel[k] = static_cast<std::uint16_t>(number + 4);
  rays.tooth[k] = static_cast<std::uint16_t>(number + 5);
  rays.level[k] = static_cast<std::uint16_t>(number + 6);
  for (std::size_t c = 0; c < rays.kind().size(); ++c) {
    rays.light_of(k)[c] = n + static_cast<double>(c) / 8;
    if (rays.kind().listed())
      rays.channels[k * rays.kind().size() + c] = static_cast<std::uint16_t>(7 * number + c * c);
  }
  if (rays.fields().travelled) rays.travelled[k] = n + 0.9;
  if (rays.fields().path) rays.path[k] = number + 7;
  if (rays.fields().rest) rays.rest[k] = n + 0.95;
}

/// Is it the one that write() wrote?
void expect_is(Rays const& rays, std::size_t k, unsigned number) {
  SCOPED_TRACE(number);
  Rays one(rays.kind(), rays.fields());
  one.add(1);
  write(one, 0, number);
  EXPECT_EQ(rays.origin.get(k), one.origin.get(0));
  EXPECT_EQ(rays.direction.get(k), one.direction.get(0));
  EXPECT_EQ(rays.origin_error.get(k), one.origin_error.get(0));
  EXPECT_EQ(rays.start[k], one.start[0]);
  EXPECT_EQ(rays.stack[k], one.stack[0]);
  EXPECT_EQ(rays.slot[k], one.slot[0]);
  EXPECT_EQ(rays.channel[k], one.channel[0]);
  EXPECT_EQ(rays.tooth[k], one.tooth[0]);
  EXPECT_EQ(rays.level[k], one.level[0]);
  std::size_t const n = rays.kind().size();
  for (std::size_t c = 0; c < n; ++c) {
    EXPECT_EQ(rays.light_of(k)[c], one.light_of(0)[c]);
    if (rays.kind().listed()) {
      EXPECT_EQ(rays.channels[k * n + c], one.channels[c]);
    }
  }
  if (rays.fields().travelled) {
    EXPECT_EQ(rays.travelled[k], one.travelled[0]);
  }
  if (rays.fields().path) {
    EXPECT_EQ(rays.path[k], one.path[0]);
  }
  if (rays.fields().rest) {
    EXPECT_EQ(rays.rest[k], one.rest[0]);
  }
}

Rays written(LightKind const& kind, Rays::Fields const& fields, unsigned count) {
  Rays rays(kind, fields);
  for (unsigned number = 0; number < count; ++number) {
    EXPECT_EQ(rays.add(1), number);
    write(rays, number, number);
  }
  return rays;
}

/// work(kind, fields) for kinds and fields of all sorts.
template <class Work>
void each_sort(Work&& work) {
  for (LightKind const& kind : {two_bands, listed})
    for (int set = 0; set < 8; ++set)
      work(kind, Rays::Fields{(set & 1) != 0, (set & 2) != 0, (set & 4) != 0});
}

TEST(Rays, KeepWhatTheyAreWhileMoreAreAdded) {
  each_sort([](LightKind const& kind, Rays::Fields const& fields) {
    Rays rays = written(kind, fields, 500); // room grows several times
    EXPECT_EQ(rays.add(7), 500);
    EXPECT_EQ(rays.count(), 507);
    for (unsigned k : {0, 63, 64, 128, 499}) expect_is(rays, k, k);
    rays.clear();
    EXPECT_EQ(rays.count(), 0);
    EXPECT_EQ(rays.add(3), 0);
  });
}

TEST(Rays, TakeEachOthersPlacesWhole) {
  each_sort([](LightKind const& kind, Rays::Fields const& fields) {
    Rays rays = written(kind, fields, 100);
    std::size_t kept = 0;
    for (std::size_t k = 0; k < 100; ++k)
      if (k % 3 == 1) rays.move(k, kept++);
    rays.keep_first(kept);
    ASSERT_EQ(rays.count(), 33);
    for (unsigned k = 0; k < 33; ++k) expect_is(rays, k, 3 * k + 1);
  });
}

TEST(Rays, AreCopiedWhole) {
  each_sort([](LightKind const& kind, Rays::Fields const& fields) {
    Rays const rays = written(kind, fields, 20);
    Rays other = written(kind, fields, 2);
    for (unsigned k : {19, 0, 7}) other.copy(rays, k);
    ASSERT_EQ(other.count(), 5);
    unsigned const numbers[] = {0, 1, 19, 0, 7};
    for (std::size_t k = 0; k < 5; ++k) expect_is(other, k, numbers[k]);
  });
}

TEST(Rays, AreStillThereWhenTheirOwnerMoves) {
  Rays rays = written(two_bands, {}, 10);
  Rays const moved = std::move(rays);
  for (unsigned k = 0; k < 10; ++k) expect_is(moved, k, k);
}

TEST(Rays, LinesAreTheirs) {
  Rays const rays = written(two_bands, {}, 10);
  geometry::Groups const groups;
  geometry::RayLines const lines = rays.lines(groups);
  EXPECT_EQ(lines.count, 10);
  EXPECT_EQ(lines.groups, &groups);
  EXPECT_EQ(lines.get(4).origin, rays.origin.get(4));
  EXPECT_EQ(lines.get(4).direction, rays.direction.get(4));
  EXPECT_EQ(lines.get(4).origin_error, rays.origin_error.get(4));
  EXPECT_EQ(lines.start[4], rays.start[4]);
}

TEST(Rays, ChannelsOfLanesAreListedOrFollowTheFirst) {
  std::uint16_t channels[3];
  channels_of(written(two_bands, {}, 3), 2, channels);
  EXPECT_EQ(channels[0], 6);
  EXPECT_EQ(channels[1], 7);
  channels_of(written(listed, {}, 3), 2, channels);
  for (std::uint16_t c = 0; c < 3; ++c) EXPECT_EQ(channels[c], 14 + c * c);
}

TEST(LightKind, OnlyLanesOfCombsListTheirChannels) {
  EXPECT_FALSE(LightKind{8}.listed());
  EXPECT_TRUE((LightKind{8, polychromatic, 0, false, false}.listed()));
  EXPECT_FALSE((LightKind{8, polychromatic, 0, false, true}.listed())); // control light
  EXPECT_FALSE((LightKind{1, 0, 0, true, false}.listed()));
  EXPECT_FALSE(LightKind{8}.monochromatic());
  EXPECT_TRUE((LightKind{1, band_means}.monochromatic()));
}

TEST(Queues, AreVisitedInTheOrderOfTheirKeysWhateverCameFirst) {
  Queues<int> queues;
  for (int const key : {5, -2, 9, 0})
    queues.of(key, two_bands, {}).add(static_cast<std::size_t>(key + 3));
  queues.of(7, two_bands, {}); // has no rays
  Rays const* const of_nine = &queues.of(9, two_bands, {});
  EXPECT_EQ(queues.count(), 8 + 1 + 12 + 3);
  std::vector<int> keys;
  queues.each([&](int key, Rays& rays) {
    keys.push_back(key);
    EXPECT_EQ(rays.count(), static_cast<std::size_t>(key + 3));
  });
  EXPECT_EQ(keys, (std::vector<int>{-2, 0, 5, 9}));
  queues.clear();
  EXPECT_EQ(queues.count(), 0);
  queues.each([](int, Rays&) { FAIL(); });
  EXPECT_EQ(&queues.of(9, two_bands, {}), of_nine); // its room is used again
}

} // namespace
} // namespace abbe::transport::testing

// SPDX-License-Identifier: MIT
#include "render/number_table.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace abbe::render {
namespace {

TEST(NumberTable, GivesEqualThingsTheNumberOfTheFirst) {
  std::vector<int> things;
  NumberTable table;
  auto const number = [&](int thing) {
    auto const fresh = static_cast<std::uint32_t>(things.size());
    // Few hashes: most things meet others at their place.
    auto const found = table.find_or_add(static_cast<std::uint64_t>(thing) % 7, fresh,
                                         [&](std::uint32_t i) { return things[i] == thing; });
    if (found == fresh) things.push_back(thing);
    return found;
  };
  for (int thing = 0; thing < 1000; ++thing)
    EXPECT_EQ(number(thing), static_cast<std::uint32_t>(thing));
  for (int thing = 999; thing >= 0; --thing)
    EXPECT_EQ(number(thing), static_cast<std::uint32_t>(thing));
  EXPECT_EQ(things.size(), 1000u);
}

} // namespace
} // namespace abbe::render

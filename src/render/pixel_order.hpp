// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <span>
#include <vector>

namespace abbe::render {

struct Pixel {
  int x, y;
};

/// Pixels [x0, x1) x [y0, y1).
struct Box {
  int x0, y0, x1, y1;
};

/// Calls visit(pixels) for the pixels of a box that are `wanted(x, y)`, `most` of them at a time,
/// until it returns false. They come block by block, so that those of one call are neighbours
/// across and down: their rays meet the same surfaces.
template <class Wanted, class Visit>
void for_each_group(Box const& box, std::size_t most, Wanted const& wanted, Visit const& visit) {
  constexpr int across = 8, down = 4;
  std::vector<Pixel> group;
  group.reserve(most);
  auto const hand_on = [&] {
    bool const goes_on = visit(std::span<Pixel const>(group));
    group.clear();
    return goes_on;
  };
  for (int top = box.y0; top < box.y1; top += down)
    for (int left = box.x0; left < box.x1; left += across)
      for (int y = top; y < std::min(top + down, box.y1); ++y)
        for (int x = left; x < std::min(left + across, box.x1); ++x) {
          if (!wanted(x, y)) continue;
          group.push_back({x, y});
          if (group.size() == most && !hand_on()) return;
        }
  if (!group.empty()) hand_on();
}

} // namespace abbe::render

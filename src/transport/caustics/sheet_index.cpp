// SPDX-License-Identifier: MIT
#include "transport/caustics/sheet_index.hpp"

#include <algorithm>
#include <cmath>

namespace abbe::transport::caustics {
namespace {

struct Box {
  Vec3 low, high;
};

/// Around all nodes' places at two distances, wider than the nodes by four times what a parabola
/// through them is.
Box around(Sheet const& sheet, double from, double to) {
  Box box{Vec3(INFINITY), Vec3(-INFINITY)};
  Vec3 bent{0};
  for (double const ahead : {from, to})
    for (std::size_t end = 0; end < 2; ++end) {
      std::array<Vec3, 9> at;
      for (std::size_t k = 0; k < 9; ++k) {
        at[k] = sheet.at(9 * end + k, ahead);
        box.low = glm::min(box.low, at[k]);
        box.high = glm::max(box.high, at[k]);
      }
      for (auto const& [i, j, k] : {std::array<std::size_t, 3>{0, 1, 2},
                                    {3, 4, 5},
                                    {6, 7, 8},
                                    {0, 3, 6},
                                    {1, 4, 7},
                                    {2, 5, 8},
                                    {0, 4, 8},
                                    {2, 4, 6}})
        bent = glm::max(bent, glm::abs(at[i] - 2.0 * at[j] + at[k]));
    }
  // And by what floats of that size are off.
  Vec3 const wider = 0.5 * bent + Vec3(std::ldexp(glm::length(box.high - box.low), -20));
  box.low -= wider;
  box.high += wider;
  return box;
}

/// Pieces of a beam, so that boxes are not much longer than wide.
constexpr int most_pieces = 16;

} // namespace

SheetIndex::SheetIndex(std::vector<Sheet> sheets) : sheets_(std::move(sheets)) {
  std::vector<std::pair<Box, std::uint32_t>> boxes;
  for (std::size_t k = 0; k < sheets_.size(); ++k) {
    Sheet const& sheet = sheets_[k];
    Box const whole = around(sheet, sheet.near, sheet.near),
              end = around(sheet, sheet.far, sheet.far);
    double const wide =
        std::max(glm::length(whole.high - whole.low), glm::length(end.high - end.low));
    double const wanted = wide > 0 ? (sheet.far - sheet.near) / (4 * wide) : most_pieces;
    double const begin = sheet.near;
    int const pieces = static_cast<int>(std::clamp(std::ceil(wanted), 1.0, 1.0 * most_pieces));
    for (int i = 0; i < pieces; ++i)
      boxes.emplace_back(around(sheet, begin + (sheet.far - begin) * i / pieces,
                                begin + (sheet.far - begin) * (i + 1) / pieces),
                         static_cast<std::uint32_t>(k));
  }
  geometry::BvhSpaceFinder finder;
  for (auto const& [box, sheet] : boxes) finder.add(box.low, box.high);
  geometry::BvhSpace const space = finder.space();
  std::vector<geometry::BvhBox> in_floats;
  in_floats.reserve(boxes.size());
  for (auto const& [box, sheet] : boxes) in_floats.push_back(space.box(box.low, box.high, sheet));
  bvh_ = geometry::Bvh(space, std::move(in_floats));
}

void SheetIndex::find(Vec3 const& point, std::vector<Over>& out) const {
  out.clear();
  if (bvh_.nodes().empty()) return;
  geometry::BvhBox const at = bvh_.space().box(point, point, 0);
  std::uint32_t waiting[8 * geometry::deepest_bvh];
  std::size_t count = 0;
  waiting[count++] = 0;
  while (count > 0) {
    geometry::BvhNode const& node = bvh_.nodes()[waiting[--count]];
    for (std::size_t k = 0; k < geometry::BvhNode::width; ++k) {
      if (node.count[k] == 0) continue;
      bool inside = true;
      for (int axis = 0; axis < 3; ++axis)
        inside = inside && node.planes[0][axis][k] <= -at.side[axis + 3]
                 && at.side[axis] <= node.planes[1][axis][k];
      if (!inside) continue;
      if (node.count[k] == geometry::BvhNode::inner) {
        waiting[count++] = node.first[k];
        continue;
      }
      for (std::uint32_t i = 0; i < node.count[k]; ++i) {
        Over over{bvh_.items()[node.first[k] + i], 0, 0};
        if (sheets_[over.sheet].may_hold(point, over.from, over.to)) out.push_back(over);
      }
    }
  }
  auto const number = [](Over const& over) { return over.sheet; };
  std::ranges::sort(out, {}, number);
  auto const again = std::ranges::unique(out, {}, number);
  out.erase(again.begin(), again.end());
}

std::size_t SheetIndex::bytes() const {
  return sheets_.size() * sizeof(Sheet) + bvh_.nodes().size() * sizeof(geometry::BvhNode);
}

} // namespace abbe::transport::caustics

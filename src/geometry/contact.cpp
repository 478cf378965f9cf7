// SPDX-License-Identifier: MIT
#include "geometry/contact.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

namespace abbe::geometry {

namespace {

double extent(Bounds const& box) {
  if (box.infinite) return std::numeric_limits<double>::infinity();
  Vec3 const sides = box.high - box.low;
  return std::max(sides.x, std::max(sides.y, sides.z));
}

/// Where a box begins along x.
double start(Bounds const& box) {
  return box.infinite ? -std::numeric_limits<double>::infinity() : box.low.x;
}

bool meet(Bounds const& a, Bounds const& b, double reach) {
  if (a.infinite || b.infinite) return true;
  for (int i = 0; i < 3; ++i) {
    if (a.low[i] - b.high[i] > reach || b.low[i] - a.high[i] > reach) return false;
  }
  return true;
}

} // namespace

Contacts::Contacts(std::span<Bounds const> boxes, double share) : first_(boxes.size() + 1, 0) {
  if (!(share > 0)) return;
  std::vector<std::uint32_t> order;
  for (std::uint32_t i = 0; i < boxes.size(); ++i) {
    if (!boxes[i].empty()) order.push_back(i);
  }
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    double const x = start(boxes[a]), y = start(boxes[b]);
    return x != y ? x < y : a < b;
  });
  struct Pair {
    std::uint32_t item;
    Partner partner;
  };
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < order.size(); ++i) {
    Bounds const& a = boxes[order[i]];
    double const size = extent(a);
    for (std::size_t j = i + 1; j < order.size(); ++j) {
      Bounds const& b = boxes[order[j]];
      // What begins beyond the reach of the larger begins there for all that follow.
      if (!a.infinite && !b.infinite && b.low.x - a.high.x > share * size) break;
      double const reach = share * std::min(size, extent(b));
      if (!(reach < std::numeric_limits<double>::infinity()) || !meet(a, b, reach)) continue;
      pairs.push_back({order[i], {order[j], reach}});
      pairs.push_back({order[j], {order[i], reach}});
    }
  }
  std::sort(pairs.begin(), pairs.end(), [](Pair const& a, Pair const& b) {
    return a.item != b.item ? a.item < b.item : a.partner.item < b.partner.item;
  });
  for (Pair const& pair : pairs) {
    ++first_[pair.item + 1];
    partners_.push_back(pair.partner);
  }
  std::partial_sum(first_.begin(), first_.end(), first_.begin());
}

double Contacts::reach(std::uint32_t item) const {
  double widest = 0;
  for (Partner const& partner : partners(item)) widest = std::max(widest, partner.reach);
  return widest;
}

double Contacts::reach(std::uint32_t item, std::uint32_t other) const {
  auto const all = partners(item);
  auto const found =
      std::lower_bound(all.begin(), all.end(), other,
                       [](Partner const& p, std::uint32_t wanted) { return p.item < wanted; });
  return found != all.end() && found->item == other ? found->reach : 0;
}

} // namespace abbe::geometry

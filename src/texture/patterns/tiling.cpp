// SPDX-License-Identifier: MIT
#include "texture/patterns/tiling.hpp"

#include "base/parameters.hpp"
#include "texture/patterns/plane_tiles.hpp"

#include <algorithm>

namespace abbe::texture {
namespace {

/// Numbers of tilings that POV-Ray has.
constexpr int last_number = 27;

class Tiling final : public Pattern {
public:
  explicit Tiling(PlaneTiles const& tiles) : types_(tiles.types) {
    auto const at = [&](PlaneTiles::Point const& p) {
      return Vec2(p.x.value(tiles.root), p.z.value(tiles.root));
    };
    across_ = at(tiles.across);
    along_ = at(tiles.along);
    double const area = across_.x * along_.y - across_.y * along_.x;
    to_across_ = Vec2(along_.y, -along_.x) / area;
    to_along_ = Vec2(-across_.y, across_.x) / area;
    for (auto const& tile : tiles.tiles) {
      std::vector<Vec2> corners;
      for (auto const& corner : tile.corners) corners.push_back(at(corner));
      add(tile, corners);
    }
  }

  double raw(Vec3 const& p, PatternModifiers const&) const override {
    Vec2 const place(p.x, p.z);
    Vec2 const here = place - std::floor(glm::dot(to_across_, place)) * across_
                      - std::floor(glm::dot(to_along_, place)) * along_;
    // The tile that the place is deepest in; on edges, where rounding may leave it out of all, in
    // none.
    double deepest = -1;
    int type = 0;
    for (Tile const& tile : tiles_) {
      double depth = deep_;
      for (Edge const& edge : tile.edges) {
        depth = std::min(depth, edge.most - glm::dot(edge.outward, here));
        if (depth <= deepest) break;
      }
      if (depth <= deepest) continue;
      deepest = depth;
      type = tile.type;
      if (deepest >= deep_) break;
    }
    double const rest = 1 - std::clamp(deepest / deep_, 0.0, 1.0);
    return (type + rest) / types_;
  }

private:
  struct Edge {
    Vec2 outward; ///< unit, or a little shorter where the bevel is wider
    double most;  ///< outward . p on the edge
  };
  struct Tile {
    int type;
    std::vector<Edge> edges;
  };

  /// Adds those copies of a tile that reach into the cell at the origin.
  void add(PlaneTiles::Tile const& shape, std::vector<Vec2> const& corners) {
    constexpr int far = 4;
    double inner = 0;
    for (int i = -far; i <= far; ++i)
      for (int j = -far; j <= far; ++j) {
        Vec2 const by = static_cast<double>(i) * across_ + static_cast<double>(j) * along_;
        Vec2 low(1e9), high(-1e9);
        for (Vec2 const& corner : corners) {
          Vec2 const cell(glm::dot(to_across_, corner + by), glm::dot(to_along_, corner + by));
          low = glm::min(low, cell);
          high = glm::max(high, cell);
        }
        constexpr double slack = 1e-9;
        if (low.x > 1 + slack || low.y > 1 + slack || high.x < -slack || high.y < -slack) continue;
        Tile tile{shape.type, {}};
        Vec2 middle(0);
        for (Vec2 const& corner : corners) middle += corner + by;
        middle /= static_cast<double>(corners.size());
        inner = INFINITY;
        for (std::size_t k = 0; k < corners.size(); ++k) {
          Vec2 const a = corners[k] + by, b = corners[(k + 1) % corners.size()] + by;
          Vec2 const outward = Vec2(b.y - a.y, a.x - b.x) / glm::length(b - a);
          inner = std::min(inner, glm::dot(outward, a - middle));
          bool const wide = std::ranges::find(shape.wide, k) != shape.wide.end();
          Vec2 const steep = (wide ? std::sqrt(0.75) : 1.0) * outward;
          tile.edges.push_back({steep, glm::dot(steep, a)});
        }
        tiles_.push_back(std::move(tile));
      }
    deep_ = std::min(deep_, inner);
  }

  int types_;
  Vec2 across_, along_;       ///< of the cell
  Vec2 to_across_, to_along_; ///< how many of these lead to a place
  double deep_ = INFINITY;    ///< the least inner radius of a tile
  std::vector<Tile> tiles_;
};

} // namespace

std::shared_ptr<Pattern const> read_tiling(Parameters& in) {
  Span const at = in.next_span();
  auto const number = static_cast<std::size_t>(in.integer("number of the tiling", 1, last_number));
  auto const all = plane_tiles();
  if (number <= all.size()) return std::make_shared<Tiling>(all[number - 1]);
  in.report(Severity::Error, "E0901",
            "Penrose's tilings, which do not repeat (25, 26, 27), are not supported yet", at);
  return std::make_shared<Tiling>(all.front());
}

} // namespace abbe::texture

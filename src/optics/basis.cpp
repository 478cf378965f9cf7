// SPDX-License-Identifier: MIT
#include "optics/basis.hpp"

#include "optics/decompose.hpp"

#include <algorithm>
#include <cmath>

namespace abbe::optics {
namespace {

/// What the eye makes of a band: the inner product's weight.
double importance(Bands const& grid, int band) {
  Vec3 const w = grid.xyz_weight(band);
  return w.x + w.y + w.z;
}

/// The lights of the family as rows of equal strength, then the parts of white if it is `parted`,
/// all without their part along `white`.
Matrix rows_of(std::vector<std::vector<double>> const& family, bool parted,
               std::span<double const> root, std::span<double const> white) {
  std::size_t const own = family.size(), n = root.size();
  Matrix lights(own + (parted ? n - 1 : 0), n);
  double const share = std::sqrt(static_cast<double>(std::max<std::size_t>(own, 1))
                                 / static_cast<double>(std::max<std::size_t>(n - 1, 1)));
  for (std::size_t r = 0; r < lights.rows(); ++r) {
    auto const row = lights.row(r);
    if (r < own) {
      for (std::size_t b = 0; b < n; ++b) row[b] = family[r][b] * root[b];
      double const size = length(row);
      if (size > 0)
        for (double& value : row) value /= size;
    } else {
      add(row.first(r - own + 1), share, white.first(r - own + 1));
    }
    add(row, -dot(row, white), white);
  }
  return lights;
}

} // namespace

ChannelSet choose_basis(Bands const& grid, std::vector<std::vector<double>> const& family, int size,
                        bool parted) {
  auto const n = static_cast<std::size_t>(grid.count());
  std::vector<double> root;
  for (int b = 0; b < grid.count(); ++b)
    root.push_back(std::sqrt(std::max(importance(grid, b), 0.0)));
  std::vector<double> white(n);
  add(white, 1 / length(root), root);

  // What is weaker than the rounding of the lights is no direction of theirs.
  Matrix const directions = right_singular_vectors(rows_of(family, parted, root, white), 1e-12);
  std::size_t const found = std::min({static_cast<std::size_t>(size), n, directions.rows() + 1});
  // sum_p W_p E_j(p) = sum_b w_b E_j(b), E = basis / root; solved for W / root, which keeps its
  // digits where the eye sees little. Rows: E_j root, and the right side for red, green and blue.
  Matrix equations(found, n + 3);
  for (std::size_t j = 0; j < found; ++j) {
    auto const row = equations.row(j);
    add(row.first(n), 1, j == 0 ? white : directions.row(j - 1));
    for (std::size_t b = 0; b < n; ++b) {
      if (root[b] == 0) continue;
      Vec3 const w = grid.rgb_weight(static_cast<int>(b));
      for (int c = 0; c < 3; ++c) row[n + static_cast<std::size_t>(c)] += w[c] / root[b] * row[b];
    }
  }
  auto const pivots = decompose_qr(equations, n, 0);
  std::vector<std::pair<int, Vec3>> chosen(pivots.size());
  for (std::size_t p = pivots.size(); p-- > 0;) { // back substitution
    auto const row = equations.row(p);
    Vec3 weight(row[n], row[n + 1], row[n + 2]);
    for (std::size_t q = p + 1; q < pivots.size(); ++q) weight -= row[pivots[q]] * chosen[q].second;
    chosen[p] = {static_cast<int>(pivots[p]), weight / row[pivots[p]]};
  }
  std::sort(chosen.begin(), chosen.end(),
            [](auto const& a, auto const& b) { return a.first < b.first; });
  ChannelSet out{grid, {}, {}, {}};
  for (auto const& [band, weight] : chosen) {
    out.chosen.push_back(band);
    out.chosen_rgb.push_back(weight * root[static_cast<std::size_t>(band)]);
  }
  return out;
}

} // namespace abbe::optics

// SPDX-License-Identifier: MIT
#include "optics/basis.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace abbe::optics {
namespace {

/// What the eye makes of a band: the inner product's weight.
double importance(Bands const& grid, int band) {
  Vec3 const w = grid.xyz_weight(band);
  return w.x + w.y + w.z;
}

} // namespace

ChannelSet choose_basis(Bands const& grid, std::vector<std::vector<double>> const& family, int size,
                        bool parted) {
  Eigen::Index const n = grid.count();
  Eigen::VectorXd root(n);
  for (Eigen::Index b = 0; b < n; ++b)
    root[b] = std::sqrt(std::max(importance(grid, static_cast<int>(b)), 0.0));
  // Rows: lights of equal strength, without their part along white.
  Eigen::RowVectorXd const white = root.transpose().normalized();
  auto const own = static_cast<Eigen::Index>(family.size());
  Eigen::MatrixXd lights(own + (parted ? n - 1 : 0), n);
  for (Eigen::Index r = 0; r < own; ++r) {
    auto const& light = family[static_cast<std::size_t>(r)];
    for (Eigen::Index b = 0; b < n; ++b)
      lights(r, b) = light[static_cast<std::size_t>(b)] * root[b];
    double const length = lights.row(r).norm();
    if (length > 0) lights.row(r) /= length;
    lights.row(r) -= lights.row(r).dot(white) * white;
  }
  double const share = std::sqrt(static_cast<double>(std::max<Eigen::Index>(own, 1))
                                 / static_cast<double>(std::max<Eigen::Index>(n - 1, 1)));
  for (Eigen::Index r = own; r < lights.rows(); ++r) {
    lights.row(r).setZero();
    lights.row(r).head(r - own + 1) = white.head(r - own + 1) * share;
    lights.row(r) -= lights.row(r).dot(white) * white;
  }
  Eigen::MatrixXd basis(std::min<Eigen::Index>(size, n), n);
  basis.row(0) = white;
  Eigen::Index found = 1;
  if (lights.rows() > 0 && basis.rows() > 1) {
    Eigen::BDCSVD<Eigen::MatrixXd> const svd(lights, Eigen::ComputeThinV);
    // What is weaker than the rounding of the lights is no direction of theirs.
    double const least = 1e-12;
    for (Eigen::Index i = 0; i < svd.singularValues().size() && found < basis.rows(); ++i)
      if (svd.singularValues()[i] > least) basis.row(found++) = svd.matrixV().col(i).transpose();
  }
  basis.conservativeResize(found, n);

  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> const qr(basis);
  std::vector<int> chosen;
  for (Eigen::Index i = 0; i < found; ++i)
    chosen.push_back(static_cast<int>(qr.colsPermutation().indices()[i]));
  std::sort(chosen.begin(), chosen.end());
  // sum_p W_p E_j(p) = sum_b w_b E_j(b), E = basis / root; solved for W / root, which keeps its
  // digits where the eye sees little.
  Eigen::MatrixXd values(found, found), colours(found, 3);
  colours.setZero();
  for (Eigen::Index p = 0; p < found; ++p)
    values.col(p) = basis.col(chosen[static_cast<std::size_t>(p)]);
  for (Eigen::Index b = 0; b < n; ++b) {
    if (root[b] == 0) continue;
    Vec3 const w = grid.rgb_weight(static_cast<int>(b));
    for (int c = 0; c < 3; ++c) colours.col(c) += w[c] / root[b] * basis.col(b);
  }
  Eigen::MatrixXd const weights = values.fullPivLu().solve(colours);
  ChannelSet out{grid, chosen, {}, {}};
  for (Eigen::Index p = 0; p < found; ++p)
    out.chosen_rgb.push_back(Vec3(weights(p, 0), weights(p, 1), weights(p, 2))
                             * root[chosen[static_cast<std::size_t>(p)]]);
  return out;
}

} // namespace abbe::optics

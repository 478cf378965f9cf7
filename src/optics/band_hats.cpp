// SPDX-License-Identifier: MIT
#include "optics/band_hats.hpp"

#include <algorithm>
#include <cmath>

namespace abbe::optics {

BandHats::BandHats(Bands const& bands)
    : edges_(bands.edges().begin(), bands.edges().end()),
      centers_(bands.centers().begin(), bands.centers().end()) {
  std::size_t const n = centers_.size();
  for (std::size_t j = 0; j < n; ++j) {
    // Half a ramp towards each neighbour, all of the flat part towards an end.
    double const left = j == 0 ? centers_[0] - edges_[0] : 0.5 * (centers_[j] - centers_[j - 1]);
    double const right =
        j + 1 == n ? edges_[n] - centers_[j] : 0.5 * (centers_[j + 1] - centers_[j]);
    masses_.push_back(left + right);
  }
}

double BandHats::jittered(int i, double xi) const {
  std::size_t const own = static_cast<std::size_t>(i);
  if (std::abs(xi) <= 0.5)
    return std::clamp(centers_[own] + xi * (edges_[own + 1] - edges_[own]), edges_[own],
                      edges_[own + 1]);
  return at(i + 0.5 + xi);
}

double BandHats::at(double position) const {
  double const n = static_cast<double>(centers_.size());
  double b = std::fmod(position, 2 * n);
  if (b < 0) b += 2 * n;
  if (b > n) b = 2 * n - b;
  std::size_t const k = std::min(static_cast<std::size_t>(b), centers_.size() - 1);
  return edges_[k] + (b - static_cast<double>(k)) * (edges_[k + 1] - edges_[k]);
}

BandHats::Spread BandHats::spread(double lambda_nm) const {
  int const last = static_cast<int>(centers_.size()) - 1;
  if (!(lambda_nm > centers_.front())) return {0, 0};
  if (!(lambda_nm < centers_.back())) return {last, 0};
  auto const above = std::upper_bound(centers_.begin(), centers_.end(), lambda_nm);
  double const lower = *(above - 1);
  return {static_cast<int>(above - centers_.begin()) - 1, (lambda_nm - lower) / (*above - lower)};
}

void BandHats::scatter(int i, double lambda_nm, double radiance,
                       std::vector<double>& values) const {
  std::size_t const own = static_cast<std::size_t>(i);
  double const energy = radiance * (edges_[own + 1] - edges_[own]);
  Spread const s = spread(lambda_nm);
  std::size_t const k = static_cast<std::size_t>(s.lower);
  values[k] += energy * (1 - s.a) / masses_[k];
  if (s.a > 0) values[k + 1] += energy * s.a / masses_[k + 1];
}

double BandHats::gather(double lambda_nm, std::vector<double> const& values) const {
  Spread const s = spread(lambda_nm);
  std::size_t const k = static_cast<std::size_t>(s.lower);
  return s.a > 0 ? values[k] * (1 - s.a) + values[k + 1] * s.a : values[k];
}

} // namespace abbe::optics

// SPDX-License-Identifier: MIT
#include "plan/representation.hpp"

#include "image/colour.hpp"
#include "optics/basis.hpp"
#include "plan/palette.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace abbe::plan {
namespace {

/// Fine enough for any spectrum but lines; catalogues are in steps of 5 nm.
constexpr double grid_nm = 2;

optics::Bands grid_over(optics::Bands const& range) {
  double const nm = range.hi_nm() - range.lo_nm();
  auto grid = optics::Bands::uniform(std::max(1, static_cast<int>(std::lround(nm / grid_nm))),
                                     range.lo_nm(), range.hi_nm());
  ABBE_ASSERT(grid);
  return *grid;
}

/// Halves the band that costs most until no colour is off by more than the tolerance.
/// @source after G. Rougeron and B. Peroche, Color fidelity in computer graphics, CGF 17(1), 1998
class Subdivision {
public:
  Subdivision(Palette palette, optics::Bands const& grid)
      : palette_(std::move(palette)), grid_(grid) {
    for (int b = 0; b < grid.count(); ++b) {
      Vec3 const w = grid.xyz_weight(b);
      importance_.push_back(w.x + w.y + w.z);
    }
    edges_ = {0, grid.count()};
  }

  optics::Bands run(double tolerance) {
    while (static_cast<int>(edges_.size()) - 1 < grid_.count()) {
      std::size_t const worst = worst_band(tolerance);
      if (worst == edges_.size()) break;
      int const middle = edges_[worst] + (edges_[worst + 1] - edges_[worst]) / 2;
      edges_.insert(edges_.begin() + static_cast<std::ptrdiff_t>(worst) + 1, middle);
    }
    std::vector<double> edges_nm;
    for (int const edge : edges_) edges_nm.push_back(grid_.edge(edge));
    auto bands = optics::Bands::from_edges(std::move(edges_nm));
    ABBE_ASSERT(bands);
    return *bands;
  }

private:
  /// Of factors (a light, then colours): what a band makes of their product, less what it should.
  Vec3 error_of(std::vector<std::vector<double> const*> const& factors, std::size_t band) const {
    Vec3 exact(0), weight(0);
    double seen = 0;
    double means[3] = {0, 0, 0};
    for (auto b = static_cast<std::size_t>(edges_[band]);
         b < static_cast<std::size_t>(edges_[band + 1]); ++b) {
      double value = 1;
      for (std::size_t f = 0; f < factors.size(); ++f) {
        value *= (*factors[f])[b];
        means[f] += (*factors[f])[b] * importance_[b];
      }
      Vec3 const w = grid_.xyz_weight(static_cast<int>(b));
      exact += w * value;
      weight += w;
      seen += importance_[b];
    }
    double value = 1;
    for (std::size_t f = 0; f < factors.size(); ++f) value *= seen > 0 ? means[f] / seen : 0;
    return weight * value - exact;
  }

  Vec3 exact_of(std::vector<std::vector<double> const*> const& factors) const {
    Vec3 sum(0);
    for (std::size_t b = 0; b < importance_.size(); ++b) {
      double value = 1;
      for (auto const* factor : factors) value *= (*factor)[b];
      sum += grid_.xyz_weight(static_cast<int>(b)) * value;
    }
    return sum;
  }

  /// The band to halve for the colour that is furthest off; edges_.size() when all are near enough.
  std::size_t worst_band(double tolerance) const {
    double furthest = tolerance;
    std::size_t worst = edges_.size();
    auto const look = [&](std::vector<std::vector<double> const*> const& factors) {
      Vec3 const exact = exact_of(factors);
      Vec3 error(0);
      double most = 0;
      std::size_t band_of_most = edges_.size();
      for (std::size_t band = 0; band + 1 < edges_.size(); ++band) {
        Vec3 const part = error_of(factors, band);
        error += part;
        double const size = std::abs(part.x) + std::abs(part.y) + std::abs(part.z);
        if (size > most && edges_[band + 1] - edges_[band] > 1) {
          most = size;
          band_of_most = band;
        }
      }
      // As bright as white at most: how bright it is shown is not known here.
      double const scale = exact.y > 1 ? 1 / exact.y : 1;
      double const off = image::ciede2000(image::xyz_to_lab(exact * scale),
                                          image::xyz_to_lab((exact + error) * scale));
      if (off > furthest && band_of_most != edges_.size()) {
        furthest = off;
        worst = band_of_most;
      }
    };
    for (auto const& light : palette_.lights) {
      look({&light});
      for (std::size_t i = 0; i < palette_.colours.size(); ++i) {
        look({&light, &palette_.colours[i]});
        if (i < palette_pair_limit) look({&light, &palette_.colours[i], &palette_.colours[i]});
      }
    }
    return worst;
  }

  Palette palette_;
  optics::Bands grid_;
  std::vector<double> importance_;
  std::vector<int> edges_; ///< on the grid
};

} // namespace

Result<optics::ChannelSet> make_channels(scene::Scene const& scene,
                                         scene::Representation const& representation,
                                         optics::Bands const& bands, bool disperses, bool draws) {
  using Kind = scene::Representation::Kind;
  switch (representation.kind) {
  case Kind::Bands:
    break;
  case Kind::Composite:
    return optics::ChannelSet{bands, {}, {}, find_lines_nm(scene, bands)};
  case Kind::Adaptive: {
    auto const grid = grid_over(bands);
    return optics::ChannelSet{
        Subdivision(find_palette(scene, grid), grid).run(representation.tolerance), {}, {}, {}};
  }
  case Kind::Basis: {
    if (draws)
      return Error{"E0432",
                   "a basis has no bands to draw wavelengths in: it goes with dispersion { none }, "
                   "deterministic or adaptive"};
    auto const grid = grid_over(bands);
    return optics::choose_basis(grid, find_palette(scene, grid).products(), representation.size,
                                disperses);
  }
  }
  return optics::ChannelSet{bands, {}, {}, {}};
}

std::string describe(optics::ChannelSet const& channels) {
  if (channels.is_basis()) return fmt::format("a basis of {}", channels.band_count());
  auto const lines = channels.lines_nm.size();
  std::string const bands =
      fmt::format("{} band{}", channels.band_count(), channels.band_count() == 1 ? "" : "s");
  return lines == 0 ? bands : fmt::format("{} and {} line{}", bands, lines, lines == 1 ? "" : "s");
}

} // namespace abbe::plan

// SPDX-License-Identifier: MIT
#include "optics/spectrum.hpp"

#include "optics/cie_table.hpp"
#include "optics/color.hpp"
#include "simd/math.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace abbe::optics {
namespace {

constexpr double planck_c2_nm_k = 1.438776877e7;

/// Calls cell(a, b) for the pieces of [lo, hi] between whole nanometres and knots.
template <class Cell>
void for_each_cell(double lo, double hi, std::vector<double> const& knots, Cell const& cell) {
  auto knot = std::upper_bound(knots.begin(), knots.end(), lo);
  for (double a = lo; a < hi;) {
    double b = std::min(std::floor(a) + 1, hi);
    if (knot != knots.end() && *knot <= b) b = *knot++;
    if (b > a) cell(a, b);
    a = b;
  }
}

/// Simpson's rule on each cell: exact to the third degree.
template <class F>
auto integrate(double lo, double hi, std::vector<double> const& knots, F const& f) {
  decltype(f(lo)) sum(0);
  for_each_cell(lo, hi, knots, [&](double a, double b) {
    sum += (f(a) + f(0.5 * (a + b)) * 4.0 + f(b)) * ((b - a) / 6);
  });
  return sum;
}

std::vector<double> knots_of(std::vector<Pair> const& rows) {
  std::vector<double> knots;
  for (Pair const& row : rows) knots.push_back(row[0]);
  return knots;
}

/// Planck's law up to a factor, scaled so that neither high nor low temperatures overflow.
double planck(double lambda_nm, double temperature_k) {
  double const x = planck_c2_nm_k / (lambda_nm * temperature_k);
  double const x_ref = planck_c2_nm_k / (cie_last_nm * temperature_k);
  return simd::pow(cie_last_nm / lambda_nm, 5.0) * simd::exp(x_ref - x)
         * (simd::expm1(-x_ref) / simd::expm1(-x));
}

Bands const& whole_range() {
  static Bands const bands = *Bands::uniform(1, cie_first_nm, cie_last_nm);
  return bands;
}

/// Wavelengths of so few nm are no light: um were meant.
bool in_um(std::vector<Pair> const& rows) {
  return std::all_of(rows.begin(), rows.end(), [](Pair const& row) { return row[0] <= 100; });
}

Error bad(std::string message) {
  return Error{"E0415", std::move(message)};
}

} // namespace

Spectrum::Spectrum(Kind kind, double value, std::vector<Pair> rows)
    : kind_(kind),
      value_(value),
      rows_(std::make_shared<std::vector<Pair> const>(std::move(rows))) {}

Spectrum Spectrum::constant(double value) {
  return Spectrum(Kind::Constant, value, {});
}

Result<Spectrum> Spectrum::samples(std::vector<Pair> nm_value) {
  if (auto message = check_table(nm_value); !message.empty()) return bad("spectrum: " + message);
  return Spectrum(Kind::Samples, 0, std::move(nm_value));
}

Result<Spectrum> Spectrum::power(std::vector<Pair> nm_power) {
  if (auto message = check_table(nm_power); !message.empty()) return bad("spectrum: " + message);
  for (Pair const& row : nm_power)
    if (row[1] < 0)
      return bad(fmt::format("a lamp has no negative power: {} at {} nm", row[1], row[0]));
  Spectrum const result(Kind::Power, 0, std::move(nm_power));
  if (!(result.raw_xyz(whole_range()).y > 0)) return bad("the lamp emits no visible light");
  return result;
}

Result<Spectrum> Spectrum::blackbody(double temperature_k) {
  if (!(temperature_k > 0 && std::isfinite(temperature_k)))
    return bad(
        fmt::format("the temperature of a blackbody must be positive, not {} K", temperature_k));
  return Spectrum(Kind::Blackbody, temperature_k, {});
}

Result<Spectrum> Spectrum::lines(std::vector<Pair> nm_energy) {
  for (Pair const& line : nm_energy)
    if (!(line[1] >= 0 && std::isfinite(line[1]) && std::isfinite(line[0])))
      return bad(fmt::format("a line needs a wavelength and an energy >= 0, not [{}, {}]", line[0],
                             line[1]));
  Spectrum const result(Kind::Lines, 0, std::move(nm_energy));
  if (!(result.raw_xyz(whole_range()).y > 0))
    return bad(
        fmt::format("none of the lines is visible light{}",
                    in_um(*result.rows_) ? ": are their wavelengths in um, not in nm?" : ""));
  return result;
}

Spectrum Spectrum::scaled(double factor) const {
  Spectrum result = *this;
  result.scale_ *= factor;
  return result;
}

double Spectrum::value(double lambda_nm) const {
  ABBE_ASSERT(!is_light_only());
  return scale_ * (kind_ == Kind::Constant ? value_ : interpolate_linear(*rows_, lambda_nm));
}

double Spectrum::power_at(double lambda_nm) const {
  switch (kind_) {
  case Kind::Constant:
    return value_ * d65_power_at(lambda_nm);
  case Kind::Blackbody:
    return planck(lambda_nm, value_);
  default:
    return interpolate_linear(*rows_, lambda_nm);
  }
}

Vec3 Spectrum::raw_xyz(Bands const& bands) const {
  auto const weight = [&](double l) { return bands.xyz_density(l) / d65_power_at(l); };
  if (kind_ == Kind::Lines) {
    Vec3 sum(0);
    for (Pair const& line : *rows_)
      if (bands.contains(line[0])) sum += weight(line[0]) * line[1];
    return sum;
  }
  double lo = bands.lo_nm();
  double hi = bands.hi_nm();
  if (kind_ == Kind::Power) {
    lo = std::max(lo, rows_->front()[0]);
    hi = std::min(hi, rows_->back()[0]);
  }
  return integrate(lo, hi, knots_of(*rows_), [&](double l) { return weight(l) * power_at(l); });
}

double Spectrum::raw_power(double a_nm, double b_nm) const {
  if (kind_ == Kind::Power) {
    a_nm = std::max(a_nm, rows_->front()[0]);
    b_nm = std::min(b_nm, rows_->back()[0]);
  }
  return integrate(a_nm, b_nm, knots_of(*rows_), [&](double l) { return power_at(l); });
}

double Spectrum::unit(Bands const& bands, double raw_luminance) const {
  if (kind_ == Kind::Constant) return scale_;
  if (kind_ == Kind::Samples) {
    double const equal_energy =
        integrate(bands.lo_nm(), bands.hi_nm(), std::vector<double>{},
                  [&](double l) { return bands.xyz_density(l).y / d65_power_at(l); });
    return scale_ / equal_energy;
  }
  return raw_luminance > 0 ? scale_ / raw_luminance : 0;
}

std::vector<double> light_bands(Spectrum const& light, Bands const& bands) {
  std::size_t const n = static_cast<std::size_t>(bands.count());
  if (light.kind_ == Spectrum::Kind::Constant)
    return std::vector<double>(n, light.scale_ * light.value_);
  double const raw_luminance = light.raw_xyz(bands).y;
  double const unit = light.unit(bands, raw_luminance);
  std::vector<double> values(n, 0.0);
  if (light.kind_ == Spectrum::Kind::Lines) {
    for (Pair const& line : *light.rows_) {
      if (!bands.contains(line[0])) continue;
      int const i = bands.index_of(line[0]);
      values[static_cast<std::size_t>(i)] += unit * line[1] / (bands.width(i) * bands.d65_power(i));
    }
  } else {
    for (int i = 0; i < bands.count(); ++i)
      values[static_cast<std::size_t>(i)] = unit * light.raw_power(bands.edge(i), bands.edge(i + 1))
                                            / (bands.width(i) * bands.d65_power(i));
  }
  double const luminance = bands.xyz(values).y;
  // A light without luminance (samples may be negative, or only ultraviolet) keeps its energy.
  if (luminance > 0 && unit * raw_luminance > 0)
    for (double& value : values) value *= unit * raw_luminance / luminance;
  return values;
}

Vec3 light_rgb(Spectrum const& light) {
  Bands const& range = whole_range();
  if (light.kind_ == Spectrum::Kind::Constant) return Vec3(light.scale_ * light.value_);
  Vec3 const raw = light.raw_xyz(range);
  return xyz_to_rgb(raw * light.unit(range, raw.y));
}

SplitTable Spectrum::split(Bands const& bands) const {
  if (kind_ == Kind::Power) return split_peaks(*rows_, bands);
  SplitTable out;
  if (kind_ == Kind::Lines)
    for (Pair const& line : *rows_)
      if (bands.contains(line[0])) out.lines.push_back(line);
  return out;
}

std::vector<double> light_beside_lines(Spectrum const& light, Bands const& bands) {
  if (light.kind_ == Spectrum::Kind::Lines)
    return std::vector<double>(static_cast<std::size_t>(bands.count()), 0.0);
  if (light.kind_ != Spectrum::Kind::Power) return light_bands(light, bands);
  auto split = light.split(bands);
  Spectrum smooth(Spectrum::Kind::Power, 0, std::move(split.smooth));
  // In the units of the whole.
  double const own = smooth.raw_xyz(bands).y;
  double const whole = light.raw_xyz(bands).y;
  smooth.scale_ = whole > 0 ? light.scale_ * own / whole : 0;
  return light_bands(smooth, bands);
}

std::vector<double> light_at_lines(Spectrum const& light, Bands const& bands,
                                   std::vector<double> const& lines_nm) {
  std::vector<double> values(lines_nm.size(), 0.0);
  double const unit = light.unit(bands, light.raw_xyz(bands).y);
  for (Pair const& line : light.split(bands).lines)
    for (std::size_t i = 0; i < lines_nm.size(); ++i)
      if (lines_nm[i] == line[0]) values[i] += unit * line[1] / d65_power_at(line[0]);
  return values;
}

std::vector<double> Spectrum::knots() const {
  return knots_of(*rows_);
}

std::vector<double> mean_over_bands(std::function<double(double)> const& f,
                                    std::vector<double> const& knots, Bands const& bands) {
  std::vector<double> values;
  auto const weight = [&](double l) {
    Vec3 const w = bands.xyz_density(l);
    return w.x + w.y + w.z;
  };
  for (int i = 0; i < bands.count(); ++i) {
    double const a = bands.edge(i);
    double const b = bands.edge(i + 1);
    double const sum = integrate(a, b, knots, [&](double l) { return f(l) * weight(l); });
    values.push_back(sum / integrate(a, b, knots, weight));
  }
  return values;
}

Vec3 rgb_under_d65(std::function<double(double)> const& f, std::vector<double> const& knots) {
  Bands const& range = whole_range();
  return xyz_to_rgb(integrate(range.lo_nm(), range.hi_nm(), knots,
                              [&](double l) { return range.xyz_density(l) * f(l); }));
}

Result<std::vector<double>> reflectance_bands(Spectrum const& spectrum, Bands const& bands) {
  if (spectrum.is_light_only()) return bad("the spectrum of a light is no reflectance");
  if (spectrum.knots().empty())
    return std::vector<double>(static_cast<std::size_t>(bands.count()),
                               spectrum.value(bands.lo_nm()));
  return mean_over_bands([&](double l) { return spectrum.value(l); }, spectrum.knots(), bands);
}

Result<Vec3> reflectance_rgb(Spectrum const& spectrum) {
  if (spectrum.is_light_only()) return bad("the spectrum of a light is no reflectance");
  if (spectrum.knots().empty()) return Vec3(spectrum.value(d_line_nm));
  return rgb_under_d65([&](double l) { return spectrum.value(l); }, spectrum.knots());
}

} // namespace abbe::optics

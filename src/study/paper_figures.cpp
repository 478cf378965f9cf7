// SPDX-License-Identifier: MIT
#include "optics/bands.hpp"
#include "optics/refract.hpp"
#include "study/drawing.hpp"
#include "study/paper.hpp"

#include "base/random.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace abbe::study {
namespace {

constexpr double degree = std::numbers::pi / 180;
constexpr int drawn_bands = 8; ///< of the paper's pictures

/// The colour of a wavelength at full drive.
std::string colour_of(double lambda_nm) {
  auto const bands = optics::Bands::uniform(1);
  Vec3 const colour = bands->rgb_density(std::clamp(lambda_nm, 415.0, 690.0));
  double const largest = std::max({colour.x, colour.y, colour.z});
  return css_colour(largest > 0 ? colour / largest : colour);
}

struct Ray {
  Vec2 from, direction; ///< unit
};

/// By the operator that the renderer uses. @param normal unit, either side
/// @return nothing at total reflection
std::optional<Vec2> refract(Vec2 d, Vec2 normal, double n1, double n2) {
  if (glm::dot(d, normal) > 0) normal = -normal;
  double const cos_i = -glm::dot(d, normal);
  auto const f = optics::fresnel<double>(n1, n2, n2 - n1, cos_i, (1 - cos_i) * (1 + cos_i));
  if (f.total) return std::nullopt;
  Vec3 const out = optics::refracted(f, {d.x, d.y, 0}, {normal.x, normal.y, 0});
  return Vec2(out.x, out.y);
}

/// Where a ray meets the line through a and b, as a distance along it.
double meet(Ray const& ray, Vec2 a, Vec2 b) {
  Vec2 const edge = b - a, to = a - ray.from;
  double const cross = ray.direction.x * edge.y - ray.direction.y * edge.x;
  return (to.x * edge.y - to.y * edge.x) / cross;
}

Vec2 normal_of(Vec2 a, Vec2 b) {
  Vec2 const edge = glm::normalize(b - a);
  return {edge.y, -edge.x};
}

double index_in_range(optics::Glass const& glass, double lambda_nm) {
  auto const range = glass.range_nm();
  return glass.index_unchecked(std::clamp(lambda_nm, range.lo_nm, range.hi_nm));
}

double band_centre(int i) {
  return 380 + (i + 0.5) * 400.0 / drawn_bands;
}

} // namespace

std::string index_curves(std::vector<optics::GlassPtr> const& glasses) {
  Drawing drawing(820, 560);
  Axes axes(drawing, {60, 40}, {610, 460}, {380, 780, 50, 0}, {1.4, 2.6, 0.1, 1});
  axes.titles("wavelength in air, nm", "index of refraction");
  char const* const colours[] = {"#0072b2", "#d55e00", "#009e73", "#b0529c",
                                 "#a07800", "#2f7fb8", "#7a4b2b", "#444444"};
  std::vector<std::pair<double, std::size_t>> order;
  for (std::size_t i = 0; i < glasses.size(); ++i)
    order.emplace_back(-index_in_range(*glasses[i], 700), i);
  std::sort(order.begin(), order.end());
  double above = -1e9; // of the last label
  for (auto const& [negative, i] : order) {
    auto const& glass = *glasses[i];
    auto const range = glass.range_nm();
    std::vector<Vec2> curve;
    for (double nm = std::max(380.0, range.lo_nm); nm <= std::min(780.0, range.hi_nm); nm += 2)
      curve.push_back(axes.place(nm, glass.index_unchecked(nm)));
    std::string const colour = colours[i % std::size(colours)];
    drawing.line(curve, colour, 2);
    double const y = std::max(curve.back().y + 4, above + 16);
    above = y;
    drawing.text({678, y}, glass.full_name(), Drawing::Anchor::Start, 13, colour);
  }
  return drawing.svg();
}

std::string split_at_interface(optics::Glass const& glass) {
  Drawing drawing(820, 460);
  Vec2 const at(360, 200);
  drawing.polygon({{0, 200}, {820, 200}, {820, 460}, {0, 460}}, "#eef3f7", "none");
  drawing.line({{0, 200}, {820, 200}}, "#55606b", 1.5);
  drawing.line({{360, 40}, {360, 440}}, "#9aa4ad", 1);
  double const incidence = 60 * degree;
  Vec2 const in(std::sin(incidence), std::cos(incidence)), normal(0, -1);
  drawing.line({at - 320.0 * in, at}, "#222222", 3.5);
  drawing.line({at, at + 300.0 * Vec2(in.x, -in.y)}, "#222222", 3.5);
  drawing.text({270, 186}, "all bands on one ray", Drawing::Anchor::End);
  drawing.text({450, 186}, "reflected: one ray, each band times its R");
  // The angles of the bands lie within a degree: the deviation from the middle is drawn 15 times.
  constexpr double exaggeration = 15;
  auto const angle = [&](double lambda_nm) {
    auto const out = refract(in, normal, 1, index_in_range(glass, lambda_nm));
    return std::atan2(out->x, out->y);
  };
  double const middle = angle(band_centre(drawn_bands / 2));
  for (int i = 0; i < drawn_bands; ++i) {
    double const nm = band_centre(i);
    double const drawn = middle + exaggeration * (angle(nm) - middle);
    Vec2 const direction(std::sin(drawn), std::cos(drawn));
    drawing.line({at, at + 235.0 * direction}, colour_of(nm), 2.5);
    if (i == 0 || i == drawn_bands - 1)
      drawing.text(at + 255.0 * direction + Vec2(0, 8), fmt::format("{:.0f} nm", nm),
                   Drawing::Anchor::Middle, 12, "#555555");
  }
  double const spread = std::abs(angle(band_centre(0)) - angle(band_centre(drawn_bands - 1)));
  std::string const words[] = {"refracted: split, one ray a band,",
                               "each with its own index and angle",
                               fmt::format("{},", glass.full_name()),
                               "60 degrees of incidence;",
                               fmt::format("angles apart drawn {:.0f} times", exaggeration),
                               fmt::format("({:.2f} degrees in all)", spread / degree)};
  for (std::size_t i = 0; i < std::size(words); ++i)
    drawing.text({540, 280 + 21.0 * static_cast<double>(i)}, words[i]);
  return drawing.svg();
}

namespace {

/// A prism of 60 degrees in a panel, and the traced path of one wavelength through it.
class Prism {
public:
  Prism(Vec2 centre, double side) {
    double const half = side / 2, height = half * std::sqrt(3.0);
    left_ = centre + Vec2(-half, height / 2);
    right_ = centre + Vec2(half, height / 2);
    top_ = centre + Vec2(0, -height / 2);
  }
  void draw(Drawing& drawing) const {
    drawing.polygon({left_, right_, top_}, "#eef3f7", "#55606b");
  }
  /// The ray that crosses at least deviation for index n, met in the middle of the left face.
  Ray incoming(double n) const {
    Vec2 const at = 0.45 * left_ + 0.55 * top_;
    double const incidence = std::asin(n * std::sin(30 * degree));
    Vec2 const inward = normal_of(top_, left_);
    Vec2 const n_in = glm::dot(inward, right_ - left_) > 0 ? inward : -inward;
    Vec2 const along = glm::normalize(top_ - left_);
    return {at, std::cos(incidence) * n_in + std::sin(incidence) * along};
  }
  /// Entry, exit, and a point `reach` beyond; where it is totally reflected, it ends.
  std::vector<Vec2> trace(Ray const& in, double n, double reach) const {
    auto const inside = refract(in.direction, normal_of(left_, top_), 1, n);
    if (!inside) return {in.from};
    double const t = meet({in.from, *inside}, top_, right_);
    Vec2 const exit = in.from + t * *inside;
    auto const out = refract(*inside, normal_of(top_, right_), n, 1);
    if (!out) return {in.from, exit};
    return {in.from, exit, exit + reach * *out};
  }

private:
  Vec2 left_, right_, top_;
};

} // namespace

std::string fan_through_prism(optics::Glass const& glass) {
  Drawing drawing(900, 320);
  double const n = index_in_range(glass, 550);
  for (int panel = 0; panel < 2; ++panel) {
    double const x0 = 450.0 * panel;
    Prism const prism({x0 + 190, 180}, 230);
    prism.draw(drawing);
    Ray const in = prism.incoming(n);
    drawing.line({in.from - 130.0 * in.direction, in.from}, "#222222", 3);
    for (int i = 0; i < drawn_bands; ++i)
      for (int k = 0; k < (panel == 0 ? 1 : 6); ++k) {
        // One offset for all bands of a sample, as the renderer draws it.
        double const xi =
            panel == 0 ? 0 : RandomKey(3).uniform(static_cast<std::uint64_t>(k)) - 0.5;
        double const nm = band_centre(i) + xi * 400.0 / drawn_bands;
        drawing.line(prism.trace(in, index_in_range(glass, nm), 190), colour_of(nm),
                     panel == 0 ? 1.8 : 1.1);
      }
    drawing.text({x0 + 20, 30}, panel == 0 ? "deterministic: the middle of each of 8 bands"
                                           : "stochastic: 6 samples of 8 jittered bands");
  }
  return drawing.svg();
}

} // namespace abbe::study

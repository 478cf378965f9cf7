// SPDX-License-Identifier: MIT
#include "pixel.hpp"

#include <algorithm>
#include <array>
#include <vector>

/// Light that glass and mirrors throw against closed formulas.
namespace abbe::physics {
namespace {

constexpr char const* white = "pigment { rgb 1 } finish { ambient 0 diffuse 1 }";
/// Without Fresnel, as POV-Ray's: all that comes goes through.
constexpr char const* clear = "pigment { rgbt 1 } finish { ambient 0 diffuse 0 }";
std::string photons(double error, char const* evaluate = "exact") {
  return fmt::format("global_settings {{ photons {{ }} caustics {{ error {} evaluate {} }} }}\n",
                     error, evaluate);
}

/// How far values are off, as shares of what they should be, in order.
class Shares {
public:
  void add(double seen, double expected) {
    values_.push_back(std::abs(seen - expected) / expected);
    std::ranges::sort(values_);
  }
  std::size_t count() const { return values_.size(); }
  /// Of all but a share, the largest.
  double all_but(double share) const {
    return values_[static_cast<std::size_t>(static_cast<double>(count() - 1) * (1 - share))];
  }

private:
  std::vector<double> values_;
};

/// A picture, as many pixels as it has, of a square of a plane z = `z`, seen from before it.
std::string square(double side, double z) {
  return fmt::format("camera {{ orthographic location <0, 0, {:.17g}> direction z "
                     "right {:.17g}*x up {:.17g}*y }}\n",
                     z - 0x1p-6, side, side);
}
/// Where the middle of a pixel is on it.
Vec2 place_of(int x, int y, int size, double side) {
  return Vec2(side * ((x + 0.5) / size - 0.5), side * (0.5 - (y + 0.5) / size));
}

/// Parallel light along z on a ball of radius 1 about the origin.
struct BallLens {
  double index, plane;
  /// Where light that comes at a distance from the axis goes on the plane: behind the axis it is
  /// below zero.
  double landing(double h) const {
    double const i = std::asin(h), inner = std::asin(h / index);
    double const p = i + std::numbers::pi - 2 * inner, v = 2 * (i - inner);
    return std::sin(p) - std::tan(v) * (plane + std::cos(p));
  }
  /// Irradiance beside that of the light, at a distance from the axis.
  double irradiance(double r) const {
    double sum = 0;
    constexpr int steps = 20000;
    for (double const side : {r, -r})
      for (int k = 0; k < steps; ++k) {
        double low = k * (1.0 / steps), high = (k + 1) * (1.0 / steps);
        if ((landing(low) - side > 0) == (landing(high) - side > 0)) continue;
        for (int turn = 0; turn < 60; ++turn) {
          double const middle = 0.5 * (low + high);
          ((landing(low) - side > 0) == (landing(middle) - side > 0) ? low : high) = middle;
        }
        double const h = 0.5 * (low + high), d = 1e-6;
        if (std::asin(h) - std::asin(h / index) >= std::numbers::pi / 4) continue; // goes back
        double const slope = (landing(h + d) - landing(h - d)) / (2 * d);
        sum += h / (r * std::abs(slope));
      }
    return sum;
  }
};

constexpr double lens_side = 0.9;
auto lens_picture(BallLens const& lens, int size, double error, char const* evaluate) {
  return picture(
      photons(error, evaluate) + square(lens_side, lens.plane)
          + fmt::format("light_source {{ <0, 0, -8>, rgb 1 parallel point_at 0 }}\n"
                        "sphere {{ 0, 1 {} interior {{ ior {} }} photons {{ target refraction on "
                        "reflection off collect off }} }}\n"
                        "plane {{ -z, {} {} }}\n",
                        clear, lens.index, -lens.plane, white),
      size, size);
}

TEST(Caustics, BallLensMeetsItsFormula) {
  constexpr int size = 24;
  constexpr double side = lens_side;
  for (auto const& [index, plane] : {std::pair(1.5, 1.3), {1.78, 1.2}, {1.33, 2.0}}) {
    BallLens const lens{index, plane};
    auto const image = lens_picture(lens, size, 0.0002, "exact");
    int lit = 0;
    for (int y = 0; y < size; ++y)
      for (int x = 0; x < size; ++x) {
        double const r = glm::length(place_of(x, y, size, side));
        double const expected = lens.irradiance(r);
        if (expected == 0) continue;
        ++lit;
        EXPECT_NEAR(pixel(image, x, y).x, expected, 1e-6 * expected)
            << "index " << index << ", " << r << " from the axis";
      }
    EXPECT_GT(lit, size * size / 8);
  }
}

TEST(Caustics, InterpolatedBallLensMeetsItsFormulaToAThousandth) {
  constexpr int size = 32;
  for (auto const& [index, plane] : {std::pair(1.5, 1.3), {1.78, 1.2}, {1.33, 2.0}}) {
    BallLens const lens{index, plane};
    auto const image = lens_picture(lens, size, 0.002, "interpolated");
    Shares off;
    for (int y = 0; y < size; ++y)
      for (int x = 0; x < size; ++x) {
        double const expected = lens.irradiance(glm::length(place_of(x, y, size, lens_side)));
        if (expected > 0) off.add(pixel(image, x, y).x, expected);
      }
    EXPECT_GT(off.count(), std::size_t{size * size / 8});
    EXPECT_LT(off.all_but(0.5), 3e-4) << "index " << index;
    EXPECT_LT(off.all_but(0.05), 3e-3) << "index " << index;
    EXPECT_LT(off.all_but(0), 0.05) << "index " << index; // beside the edge of the light
  }
}

TEST(Caustics, BallOfAlmostNoIndexIsNotThere) {
  auto const image = picture(
      photons(0.0002) + square(3, 2)
          + fmt::format("light_source {{ <1, 2, -8>, rgb 1 }}\n"
                        "sphere {{ 0, 1 {} interior {{ ior 1.000000001 }} photons {{ target "
                        "refraction on }} }}\n"
                        "plane {{ -z, -2 {} }}\n",
                        clear, white),
      9, 9);
  for (int y = 0; y < 9; ++y)
    for (int x = 0; x < 9; ++x) {
      Vec2 const at = place_of(x, y, 9, 3);
      Vec3 const lamp(1, 2, -8), way = lamp - Vec3(at.x, at.y, 2);
      double const passes = glm::length(glm::cross(lamp, glm::normalize(way)));
      if (std::abs(passes - 1) < 0.02) continue; // grazing light bends whatever the index
      EXPECT_NEAR(pixel(image, x, y).x, -way.z / glm::length(way), 5e-7) << x << ", " << y;
    }
}

TEST(Caustics, LampInTheMiddleOfABallShinesThroughIt) {
  auto const image =
      picture(photons(0.0002) + square(3, 2)
                  + fmt::format("light_source {{ 0, rgb 1 }}\n"
                                "sphere {{ 0, 1 {} interior {{ ior 1.7 }} photons {{ target "
                                "refraction on reflection off }} }}\n"
                                "plane {{ -z, -2 {} }}\n",
                                clear, white),
              9, 9);
  for (int y = 0; y < 9; ++y)
    for (int x = 0; x < 9; ++x) {
      Vec2 const at = place_of(x, y, 9, 3);
      EXPECT_NEAR(pixel(image, x, y).x, 2 / glm::length(Vec3(at.x, at.y, 2)), 2e-7);
    }
}

TEST(Caustics, PaneOfGlassGivesBackTheSumOfAllOrders) {
  auto const image = picture(
      square(1, 2)
          + fmt::format("light_source {{ <0, 0, -8>, rgb 1 parallel point_at 0 }}\n"
                        "box {{ <-9, -9, 0>, <9, 9, 1> interior {{ glass {{ \"N-BK7\" }} }} }}\n"
                        "plane {{ -z, -2 {} }} effects {{ spectral off }} global_settings {{ "
                        "caustics {{ }} }}\n",
                        white),
      3, 3);
  double const n = 1.5168, r = (n - 1) * (n - 1) / ((n + 1) * (n + 1));
  // What the plane throws back to the pane comes from a surface that scatters: it is not followed.
  EXPECT_NEAR(pixel(image, 1, 1).x, (1 - r) / (1 + r),
              4e-6); // orders below adc_bailout are left out
}

/// A mirror of radius 1 about (0, 0, -3) between a lamp at (0, 0, -10) and the plane z = 0.
struct MirrorBall {
  struct Ray {
    double way = 0, rest = 0, cosine = 0, incidence = 0, lands = 0;
  };
  /// The ray that is mirrored `angle` from the axis.
  static Ray ray(double angle) {
    Vec2 const normal(std::sin(angle), -std::cos(angle)), lamp(0, -10);
    Vec2 const at = Vec2(0, -3) + normal, d = glm::normalize(at - lamp);
    double const c = -glm::dot(d, normal);
    Vec2 const out = d + 2 * c * normal;
    Ray ray{glm::distance(at, lamp), -at.y / out.y, out.y, c, 0};
    ray.lands = at.x + ray.rest * out.x;
    return ray;
  }
  /// Irradiance by way of the mirror, beside I, by the two radii of the front that it leaves.
  static double irradiance(double r) {
    // Between the ray that goes level and the one that grazes.
    double low = 0.6, high = std::numbers::pi / 2 - std::asin(1.0 / 7);
    for (int turn = 0; turn < 100; ++turn) {
      double const middle = 0.5 * (low + high);
      Ray const at = ray(middle);
      (at.cosine <= 0 || at.lands > r ? low : high) = middle;
    }
    Ray const at = ray(0.5 * (low + high));
    double const d = at.way, across = 1 / d + 2 / at.incidence, along = 1 / d + 2 * at.incidence;
    double const whole = d + at.rest;
    return whole * whole * at.cosine / (d * d * (1 + at.rest * across) * (1 + at.rest * along));
  }
};

TEST(Caustics, MirrorBallLightsAFloorAsFarAsItGoes) {
  for (auto const& [evaluate, share] : {std::pair("exact", 1e-6), {"interpolated", 3e-3}})
    for (double const r : {2.0, 5.0, 30.0, 300.0, 3000.0}) {
      auto const image = picture(
          photons(0.002, evaluate)
              + fmt::format("camera {{ orthographic location <{:.17g}, 0, -0.0078125> direction z "
                            "right 1e-5*x up 1e-5*y }}\n"
                            "light_source {{ <0, 0, -10>, rgb 1 }}\n"
                            "sphere {{ <0, 0, -3>, 1 pigment {{ rgb 0 }} finish {{ ambient 0 "
                            "diffuse 0 reflection 1 }} photons {{ target reflection on }} }}\n"
                            "plane {{ -z, 0 {} }}\n",
                            r, white),
          1, 1);
      double const direct = 10 / std::sqrt(100 + r * r), thrown = MirrorBall::irradiance(r);
      EXPECT_NEAR(pixel(image, 0, 0).x, direct + thrown, share * thrown + 1e-7 * direct)
          << evaluate << ", " << r << " from the axis; thrown is " << thrown;
    }
}

/// Parallel light over the floor of half a cup, a mirror of radius 1 about the y axis.
struct Cup {
  double slope; ///< tangent of the light's elevation
  double height;
  /// Irradiance of what the wall throws on a place of the floor, beside that of the light there.
  double irradiance(Vec2 const& at) const {
    auto const off = [&](double a) {
      return at.x * std::sin(2 * a) - at.y * std::cos(2 * a) - std::sin(a);
    };
    double sum = 0;
    constexpr int steps = 20000;
    double const most = std::numbers::pi / 2;
    for (int k = 0; k < steps; ++k) {
      double low = -most + 2 * most * k / steps, high = -most + 2 * most * (k + 1) / steps;
      if ((off(low) > 0) == (off(high) > 0)) continue;
      for (int turn = 0; turn < 60; ++turn) {
        double const middle = 0.5 * (low + high);
        ((off(low) > 0) == (off(middle) > 0) ? low : high) = middle;
      }
      double const a = 0.5 * (low + high);
      double const s =
          (std::cos(a) - at.x) * std::cos(2 * a) + (std::sin(a) - at.y) * std::sin(2 * a);
      if (s > 0 && s * slope < height) sum += std::cos(a) / std::abs(std::cos(a) - 2 * s);
    }
    return sum;
  }
};

/// The floor is z = 0, light goes along x and down (z grows), the wall stands on it.
auto cup_picture(Cup const& cup, int size, double side, char const* evaluate) {
  return picture(
      photons(0.002, evaluate) + square(side, 0)
          + fmt::format("light_source {{ <-8, 0, {:.17g}>, rgb 1 parallel point_at 0 }}\n"
                        "cylinder {{ 0, <0, 0, {}>, 1 open pigment {{ rgb 0 }} finish {{ ambient 0 "
                        "diffuse 0 reflection 1 }} clipped_by {{ plane {{ -x, 0 }} }} photons {{ "
                        "target reflection on }} }}\n"
                        "plane {{ -z, 0 {} }}\n",
                        -8 * cup.slope, -cup.height, white),
      size, size);
}

TEST(Caustics, InterpolatedCupMeetsItsFormulaToAThousandth) {
  constexpr int size = 41;
  constexpr double side = 1.1;
  Cup const cup{std::tan(radians(40)), 0.7};
  auto const image = cup_picture(cup, size, side, "interpolated");
  double const straight = cup.slope / std::sqrt(1 + cup.slope * cup.slope);
  Shares off;
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) {
      Vec2 const at = place_of(x, y, size, side);
      if (glm::length(at) < 0.98)
        off.add(pixel(image, x, y).x, straight * (1 + cup.irradiance(at)));
    }
  EXPECT_LT(off.all_but(0.1), 1e-3);
  EXPECT_LT(off.all_but(0), 0.02);
}

TEST(Caustics, CupMeetsItsFormula) {
  constexpr int size = 21;
  constexpr double side = 1.1;
  Cup const cup{std::tan(radians(40)), 0.7};
  auto const image = cup_picture(cup, size, side, "exact");
  double const straight = cup.slope / std::sqrt(1 + cup.slope * cup.slope);
  int lit = 0;
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) {
      Vec2 const at = place_of(x, y, size, side);
      if (glm::length(at) > 0.98) continue;
      double const thrown = cup.irradiance(at);
      lit += thrown > 0 ? 1 : 0;
      EXPECT_NEAR(pixel(image, x, y).x, straight * (1 + thrown), 1e-6 * (1 + thrown))
          << at.x << ", " << at.y;
    }
  EXPECT_GT(lit, 50);
}

/// A slit of parallel light, a prism of N-SF11 whose edge is along z, and a screen x = 5; all in
/// the plane of x and y.
struct PrismAndSlit {
  static constexpr double screen = 5, rise_deg = 32.9;
  static constexpr double front = -3.01, back = -3, lower = -0.51, upper = -0.45; ///< of the slit
  /// Of N-SF11 @source SCHOTT's data sheet, its Sellmeier coefficients
  static double index(double nm) {
    double const l = nm * nm * 1e-6;
    return std::sqrt(1 + 1.73759695 * l / (l - 0.013188707) + 0.313747346 * l / (l - 0.0623068142)
                     + 1.89878101 * l / (l - 155.23629));
  }
  static Vec2 direction() { return {std::cos(radians(rise_deg)), std::sin(radians(rise_deg))}; }
  struct Landing {
    double y = 0, passed = 0, cosine = 0;
  };
  /// Of a ray that is `s` high where it leaves the slit. Fresnel's losses of both faces included.
  static Landing landing(double s, double nm) {
    double const n = index(nm);
    Vec2 at(back, s), d = direction();
    Landing out{0, 1, 0};
    auto const face = [&](Vec2 const& a, Vec2 const& b, double n1, double n2) {
      Vec2 const along = glm::normalize(b - a);
      Vec2 normal(-along.y, along.x);
      if (glm::dot(normal, d) > 0) normal = -normal;
      at = at + glm::dot(a - at, normal) / glm::dot(d, normal) * d;
      double const c1 = -glm::dot(d, normal), s2 = n1 / n2 * std::sqrt(1 - c1 * c1);
      double const c2 = std::sqrt(1 - s2 * s2);
      double const rs = (n1 * c1 - n2 * c2) / (n1 * c1 + n2 * c2),
                   rp = (n2 * c1 - n1 * c2) / (n2 * c1 + n1 * c2);
      out.passed *= 1 - 0.5 * (rs * rs + rp * rp);
      d = n1 / n2 * d + (n1 / n2 * c1 - c2) * normal;
    };
    face({-0.75, 0.65}, {0, 1.95}, 1, n);
    face({0, 1.95}, {0.75, 0.65}, n, 1);
    out.y = at.y + (screen - at.x) / d.x * d.y;
    out.cosine = d.x;
    return out;
  }
  /// Mean over a band of the irradiance on the screen, beside that of the light.
  static double irradiance(double y, double low_nm, double high_nm) {
    double const bottom = lower + (back - front) * direction().y / direction().x;
    double sum = 0;
    constexpr int steps = 20000;
    for (int k = 0; k < steps; ++k) {
      double const nm = low_nm + (high_nm - low_nm) * (k + 0.5) / steps;
      // The map is nearly linear in s: Newton's iteration.
      double s = 0.5 * (bottom + upper), slope = 1;
      for (int turn = 0; turn < 4; ++turn) {
        slope = (landing(s + 1e-6, nm).y - landing(s - 1e-6, nm).y) / 2e-6;
        s -= (landing(s, nm).y - y) / slope;
      }
      if (s < bottom || s > upper) continue;
      sum += landing(s, nm).passed * direction().x / std::abs(slope);
    }
    return sum / steps;
  }
  static std::string scene(bool direct, char const* evaluate = "exact") {
    std::string const light =
        fmt::format("light_source {{ <-7, {:.17g}, 0>, rgb 1 parallel point_at <-3, -0.48, 0> }}\n",
                    -0.48 - 4 * std::tan(radians(rise_deg)));
    std::string const wall = fmt::format("plane {{ -x, -5 {} }}\n", white);
    // Two surfaces, and no more.
    std::string const bands =
        fmt::format("global_settings {{ spectral {{ bands 16 }} caustics {{ max_trace_level 3 "
                    "evaluate {} }} }}\n",
                    evaluate);
    std::string const camera =
        "camera { orthographic location <4.9, -2.3, 0> direction x up 2*y right -0.001*z }\n";
    if (direct) return bands + camera + light + wall;
    return bands + camera + light + wall
           + fmt::format("box {{ <{0}, {1}, -40>, <{2}, 40, 40> pigment {{ rgb 0 }} }}\n"
                         "box {{ <{0}, -40, -40>, <{2}, {3}, 40> pigment {{ rgb 0 }} }}\n",
                         front, upper, back, lower)
           + "prism { linear_sweep linear_spline -0.9, 0.9, 4, <-0.75, 0>, <0.75, 0>, <0, 1.3>, "
             "<-0.75, 0> rotate -90*x translate <0, 0.65, 0> interior { glass { \"N-SF11\" } } }\n";
  }
};

class Prism : public testing::TestWithParam<char const*> {};

TEST_P(Prism, ThrowsTheSpectrumOfASlit) {
  constexpr int size = 48, bands = 16;
  auto const direct = picture(PrismAndSlit::scene(true), 1, 1, true).bands;
  auto const image = picture(PrismAndSlit::scene(false, GetParam()), 1, size, true).bands;
  ASSERT_EQ(image.size(), std::size_t{size} * bands);
  double largest = 0;
  int lit = 0;
  for (int y = 0; y < size; ++y)
    for (int band = 0; band < bands; ++band) {
      double const at = -2.3 + 2 * (0.5 - (y + 0.5) / size);
      double const expected = PrismAndSlit::irradiance(at, 380 + 25 * band, 380 + 25 * (band + 1));
      double const seen = image[static_cast<std::size_t>(y * bands + band)]
                          / direct[static_cast<std::size_t>(band)] * PrismAndSlit::direction().x;
      largest = std::max(largest, expected);
      lit += expected > 0 ? 1 : 0;
      EXPECT_NEAR(seen, expected, 3e-3) << "band " << band << " at " << at;
    }
  EXPECT_GT(largest, 0.3);
  EXPECT_GT(lit, 24);
}

INSTANTIATE_TEST_SUITE_P(Caustics, Prism, testing::Values("exact", "interpolated"),
                         [](auto const& one) { return std::string(one.param); });

TEST(Caustics, OffLetsLightThroughGlassAsThroughAFilter) {
  std::string const scene =
      square(1, 2)
      + fmt::format("light_source {{ <0, 0, -8>, rgb 1 parallel point_at 0 }}\n"
                    "sphere {{ 0, 1 interior {{ glass {{ \"N-BK7\" }} }} }}\n"
                    "plane {{ -z, -2 {} }} global_settings {{ caustics {{ }} }}\n",
                    white);
  auto const off = picture(scene + "effects { caustics off }\n", 4, 4);
  EXPECT_NEAR(pixel(off, 1, 1).x, 1, 1e-3); // white is not quite 1 in bands
  auto const on = picture(scene, 4, 4);
  EXPECT_GT(pixel(on, 1, 1).x, 1.5); // behind a lens
}

} // namespace
} // namespace abbe::physics

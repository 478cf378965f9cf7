// SPDX-License-Identifier: MIT
#include "pixel.hpp"

#include <functional>
#include <vector>

/// The same model in bands, band by band, as shares of a white that is seen straight. Colours are a
/// spectrum that rises evenly; what it comes to in each band is measured by a surface that glows.
namespace abbe::physics {
namespace {

constexpr int bands = 8;
/// Of the middle of a band, um.
double middle_um(int band) {
  return (380 + 400 * (band + 0.5) / bands) * 1e-3;
}

std::string in_bands(std::string const& body) {
  return fmt::format("global_settings {{ max_trace_level 60 adc_bailout 0 spectral {{ bands {} "
                     "dispersion {{ deterministic }} }} }}\n"
                     "#declare Ramp = spectrum {{ [380, 0.1] [780, 0.9] }};\n",
                     bands)
         + body;
}

/// Of each band and pixel.
std::vector<double> shares(std::string const& body, int width = 1, int height = 1) {
  auto const white = picture(in_bands("background { rgb 1 }"), 1, 1, true).bands;
  auto const image = picture(in_bands(body), width, height, true);
  std::vector<double> out;
  for (std::size_t i = 0; i < image.bands.size(); ++i)
    out.push_back(double(image.bands[i]) / double(white.at(i % bands)));
  return out;
}

double ramp(int band) {
  static auto const of_bands =
      shares(look(place(0)) + plane("pigment { Ramp } finish { ambient 0 diffuse 0 emission 1 }"));
  return of_bands.at(static_cast<std::size_t>(band));
}

/// By one ray and by many.
void expect_bands(std::string const& body, std::function<double(int band)> const& expected) {
  for (auto const& [width, height] : {std::pair(1, 1), {16, 3}}) {
    auto const seen = shares(body, width, height);
    ASSERT_EQ(seen.size(), std::size_t{bands} * width * height);
    for (std::size_t i = 0; i < seen.size(); ++i) {
      int const band = static_cast<int>(i % bands);
      double const wanted = expected(band);
      ASSERT_NEAR(seen[i], wanted, 3 * tolerance * std::abs(wanted) + 1e-12)
          << "band " << band << " of\n"
          << body;
    }
  }
}

/// A luminous wall behind everything, as bright as Ramp.
std::string const wall = "plane { -z, -50 pigment { Ramp } finish { ambient 0 diffuse 0 emission 1 "
                         "} }\n";

TEST(Bands, OfColoursAreTheirMeans) {
  // Weighted by light and eye: in the outer bands the half that is seen better counts.
  for (int b = 0; b < bands; ++b) {
    double const low = 0.1 + 0.8 * b / bands;
    EXPECT_GT(ramp(b), low);
    EXPECT_LT(ramp(b), low + 0.8 / bands);
  }
  expect_bands(look(place(20)) + plane("pigment { Ramp } finish { ambient 0.25 diffuse 0 }"),
               [](int b) { return 0.25 * ramp(b); });
}

TEST(Bands, ScatterAndShine) {
  Vec3 const eye = place(30), at = place(40, 170);
  Vec3 const way = glm::normalize(-eye), to_lamp = glm::normalize(at);
  double const lambert = std::cos(radians(40));
  double const phong = glm::dot(mirrored(way), to_lamp);
  double const blinn = glm::dot(normal, glm::normalize(to_lamp - way));
  expect_bands(look(eye)
                   + plane("pigment { Ramp } finish { ambient 0 diffuse 0.5 brilliance 2 phong 0.3 "
                           "phong_size 8 specular 0.4 roughness 0.1 }")
                   + lamp(at),
               [&](int b) {
                 return 0.5 * ramp(b) * lambert * lambert + 0.3 * std::pow(phong, 8)
                        + 0.4 * std::pow(blinn, 10);
               });
  expect_bands(
      look(eye)
          + plane("pigment { Ramp } finish { ambient 0 diffuse 0 phong 0.8 phong_size 8 "
                  "metallic 0.7 }")
          + lamp(at),
      [&](int b) { return 0.8 * std::pow(phong, 8) * metallic(0.7, lambert, Vec3(ramp(b))).x; });
}

TEST(Bands, OfLampsMultiply) {
  expect_bands(look(place(20)) + plane("pigment { Ramp } finish { ambient 0 diffuse 0.5 }")
                   + lamp(place(60, 20, 4), Vec3(1),
                          "spotlight point_at 0 tightness 3 fade_distance 2 fade_power 2")
                   + lamp(place(30), Vec3(0.5)),
               [](int b) {
                 return 0.5 * ramp(b)
                        * (std::cos(radians(60)) * 2 / (1 + 4.0) + 0.5 * std::cos(radians(30)));
               });
}

TEST(Bands, MirrorAndConserve) {
  double const share = 1 - std::cos(radians(50));
  expect_bands("background { rgb 1 }\n" + look(place(50))
                   + plane("pigment { Ramp } finish { ambient 0.1 diffuse 0 reflection { rgb 0.2, "
                           "rgb 0.8 metallic } }"),
               [&](int b) {
                 double const tint = metallic(1, std::cos(radians(50)), Vec3(ramp(b))).x;
                 return 0.1 * ramp(b) + (0.2 + 0.6 * share) * tint;
               });
  expect_bands("background { rgb 1 }\n" + look(place(50))
                   + plane("pigment { Ramp filter 0.5 } finish { ambient 0 diffuse 0 reflection { "
                           "rgb 0.2, rgb 0.8 } conserve_energy }")
                   + wall,
               [&](int b) {
                 double const mirrors = 0.2 + 0.6 * share;
                 return 0.5 * ramp(b) * (1 - mirrors) * ramp(b) + mirrors;
               });
}

TEST(Bands, PassLayersAndPanes) {
  std::string const film =
      "texture { pigment { Ramp filter 0.5 transmit 0.2 } finish { ambient 0.4 "
      "diffuse 0 } }\n";
  auto const through = [](int b) { return 0.5 * ramp(b) + 0.2; };
  auto const glow = [](int b) { return 0.3 * 0.4 * ramp(b); };
  expect_bands(look(place(30)) + plane(film + film) + wall,
               [&](int b) { return glow(b) + through(b) * (glow(b) + through(b) * ramp(b)); });
  // Both faces of a pane in the way of light.
  expect_bands(look({0, 0, -1}) + plane("pigment { rgb 1 } finish { ambient 0 diffuse 0.5 }")
                   + "box { <-9, -9, -2.1>, <9, 9, -2> pigment { Ramp filter 0.5 transmit 0.2 } }\n"
                   + lamp(place(50)),
               [&](int b) { return 0.5 * std::cos(radians(50)) * through(b) * through(b); });
}

/// A slab of 2 whose face is met at an angle.
std::string slab(double angle_deg, std::string const& interior) {
  return look(place(angle_deg, 60))
         + fmt::format("box {{ <-999, -999, 0>, <999, 999, 2> pigment {{ rgbt 1 }} finish {{ "
                       "ambient 0 diffuse 0 }} interior {{ {} }} }}\n",
                       interior);
}

/// Half of the sum of Fresnel's two reflectances, from air.
double fresnel(double angle_deg, double index) {
  double const i = radians(angle_deg), t = std::asin(std::sin(i) / index);
  double const s = (std::cos(i) - index * std::cos(t)) / (std::cos(i) + index * std::cos(t));
  double const p = (index * std::cos(i) - std::cos(t)) / (index * std::cos(i) + std::cos(t));
  return (s * s + p * p) / 2;
}

TEST(Bands, HaveEachItsIndexOfGlass) {
  for (double const angle : {0.0, 40.0, 75.0})
    expect_bands(slab(angle, "glass { cauchy <1.5, 0.02, 0> range 0.3, 1 }") + wall, [&](int b) {
      double const index = 1.5 + 0.02 / (middle_um(b) * middle_um(b));
      double const once = fresnel(angle, index);
      // To and fro within the slab: (1 - R)^2 (1 + R^2 + R^4 ...).
      return ramp(b) * (1 - once) / (1 + once);
    });
}

TEST(Bands, AreAbsorbedByTheWayInsideGlass) {
  // 0.6 of 10 mm; the slab has 2 units of 5 mm.
  for (double const angle : {0.0, 40.0, 75.0})
    expect_bands(
        "global_settings { spectral { unit 5 } }\n"
            + slab(angle, "glass { cauchy <1.6, 0, 0> range 0.3, 1 transmittance 10 { [0.3, 0.6] "
                          "[1, 0.6] } }")
            + wall,
        [&](int b) {
          double const way = 1 / std::sqrt(1 - std::pow(std::sin(radians(angle)) / 1.6, 2));
          double const left = std::pow(0.6, way), once = fresnel(angle, 1.6);
          double const round = once * left;
          return ramp(b) * (1 - once) * (1 - once) * left / (1 - round * round);
        });
}

TEST(Bands, ReachSurfacesBehindGlassOneByOne) {
  // Rays of one wavelength each on a surface with everything.
  Vec3 const at(1, 2, 20);
  double const cosine = glm::dot(normal, glm::normalize(at - Vec3(0, 0, 30)));
  expect_bands(slab(0, "glass { cauchy <1.5, 0.02, 0> range 0.3, 1 }")
                   + "plane { -z, -30 pigment { Ramp } finish { ambient 0.2 diffuse 0.5 metallic "
                     "specular 0.3 roughness 0.5 } }\n"
                   + lamp(at),
               [&](int b) {
                 double const index = 1.5 + 0.02 / (middle_um(b) * middle_um(b));
                 double const once = fresnel(0, index);
                 double const blinn =
                     glm::dot(normal, glm::normalize(glm::normalize(at - Vec3(0, 0, 30)) + normal));
                 double const seen = ramp(b) * (0.2 + 0.5 * cosine)
                                     + 0.3 * blinn * blinn * metallic(1, cosine, Vec3(ramp(b))).x;
                 return seen * (1 - once) / (1 + once);
               });
}

} // namespace
} // namespace abbe::physics

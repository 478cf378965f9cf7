// SPDX-License-Identifier: MIT
#include "optics/color.hpp"
#include "optics/data_library.hpp"
#include "optics/scan_pairs.hpp"
#include "optics/spectra_data.hpp"
#include "optics/spectrum.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

namespace abbe::optics {
namespace {

DataLibrary const& library() {
  static DataLibrary const result =
      *DataLibrary::open(std::filesystem::path(ABBE_STDLIB_DIR) / "spectra");
  return result;
}

Vec3 xy(Vec3 const& rgb) {
  Vec3 const xyz = rgb_to_xyz(rgb);
  return xyz / (xyz.x + xyz.y + xyz.z);
}

struct Chromaticity {
  char const* name;
  double x, y;
};

// CIE 15:2018 tables T.3, T.7 .. T.11, as listed in the header of the data file (sums at 5 nm).
Chromaticity const published[] = {
    {"A", 0.4476, 0.4074},        {"C", 0.3101, 0.3161},      {"D50", 0.3457, 0.3585},
    {"D55", 0.3324, 0.3474},      {"D65", 0.3127, 0.3290},    {"D75", 0.2990, 0.3149},
    {"F1", 0.3131, 0.3371},       {"F2", 0.3721, 0.3751},     {"F3", 0.4091, 0.3941},
    {"F4", 0.4402, 0.4031},       {"F5", 0.3138, 0.3452},     {"F6", 0.3779, 0.3882},
    {"F7", 0.3129, 0.3292},       {"F8", 0.3458, 0.3586},     {"F9", 0.3741, 0.3727},
    {"F10", 0.3458, 0.3588},      {"F11", 0.3805, 0.3769},    {"F12", 0.4370, 0.4042},
    {"F3.1", 0.4407, 0.4033},     {"F3.15", 0.3127, 0.3288},  {"HP1", 0.5330, 0.4150},
    {"HP5", 0.3776, 0.3713},      {"LED-B1", 0.4560, 0.4078}, {"LED-B5", 0.3118, 0.3236},
    {"LED-RGB1", 0.4557, 0.4211}, {"LED-V2", 0.3781, 0.3775}, {"ID65", 0.3107, 0.3307},
    {"ID50", 0.3432, 0.3602}};

TEST(Spectrum, IlluminantsHaveTheirPublishedChromaticity) {
  for (Chromaticity const& c : published) {
    auto const light = load_light(library(), c.name);
    ASSERT_TRUE(light.ok()) << c.name;
    Vec3 const rgb = light_rgb(*light);
    EXPECT_NEAR(luminance(rgb), 1, 1e-12) << c.name;
    // Published sums are at 5 nm; ours is at 1 nm: lines on the flanks of the cmf shift by some
    // 1e-4.
    EXPECT_NEAR(xy(rgb).x, c.x, 7e-4) << c.name;
    EXPECT_NEAR(xy(rgb).y, c.y, 7e-4) << c.name;
  }
}

TEST(Spectrum, D65IsWhite) {
  auto const d65 = *load_light(library(), "D65");
  Vec3 const rgb = light_rgb(d65);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(rgb[c], 1, 1e-12);
  for (int n : {1, 3, 8, 16, 45, 450})
    for (double const value : light_bands(d65, *Bands::uniform(n))) EXPECT_NEAR(value, 1, 1e-12);
  for (double const value : light_bands(Spectrum::constant(2).scaled(0.5), *Bands::uniform(16)))
    EXPECT_EQ(value, 1);
}

TEST(Spectrum, BlackbodyHasThePlanckianChromaticity) {
  // CIE illuminant A is Planck at 2856 K with c2 = 1.435e-2, i.e. 2848 K: x 0.44758, y 0.40745 (CIE
  // 15).
  Vec3 const a = xy(light_rgb(*Spectrum::blackbody(2848.0 * 1.438776877 / 1.435)));
  EXPECT_NEAR(a.x, 0.44758, 3e-5);
  EXPECT_NEAR(a.y, 0.40745, 3e-5);
  // Wyszecki & Stiles, Color Science, table 1(3.11): 6500 K x 0.3135, y 0.3237 (c2 1.4388e-2).
  Vec3 const b = xy(light_rgb(*Spectrum::blackbody(6500)));
  EXPECT_NEAR(b.x, 0.3135, 1.5e-4);
  EXPECT_NEAR(b.y, 0.3237, 1.5e-4);
  for (double const t : {1e-3, 100.0, 1e9}) {
    auto const light = Spectrum::blackbody(t);
    ASSERT_TRUE(light.ok());
    if (t >= 100) {
      EXPECT_NEAR(luminance(light_rgb(*light)), 1, 1e-12) << t;
    }
  }
}

TEST(Spectrum, EveryLightHasLuminanceOneForEveryNumberOfBands) {
  std::vector<Spectrum> const lights{*load_light(library(), "HP1"),
                                     *Spectrum::blackbody(3000),
                                     *load_light(library(), "sodium"),
                                     *load_light(library(), "mercury"),
                                     *Spectrum::lines({{404.66, 0.3}, {546.07, 1.0}, {578.0, 0.7}}),
                                     *Spectrum::samples({{300, 1}, {900, 1}})};
  for (auto const& light : lights)
    for (int n : {1, 3, 8, 16, 45, 450}) {
      Bands const bands = *Bands::uniform(n);
      EXPECT_NEAR(luminance(bands.rgb(light_bands(light, bands))), 1, 1e-12) << n;
      auto const triple = light_bands(light.scaled(3), bands);
      EXPECT_NEAR(luminance(bands.rgb(triple)), 3, 1e-11);
    }
}

TEST(Spectrum, EqualEnergyLightHasTheChromaticityOfE) {
  // x = y = 1/3 up to 1e-4 for our white-preserving scaling of the observer (1931 sums 106.87, .86,
  // .89).
  Vec3 const e = xy(light_rgb(*Spectrum::samples({{500, 1}})));
  EXPECT_NEAR(e.x, 1.0 / 3, 2e-4);
  EXPECT_NEAR(e.y, 1.0 / 3, 2e-4);
}

TEST(Spectrum, LinesGoToTheirBandWithTheirEnergy) {
  Bands const bands = *Bands::uniform(16);
  auto const light = *Spectrum::lines({{404.66, 0.3}, {546.07, 1.0}, {579.07, 0.7}, {1000, 5}});
  auto const values = light_bands(light, bands);
  double const ratio =
      values[0] * bands.d65_power(0) * bands.width(0)
      / (values[6] * bands.d65_power(6) * bands.width(6)); // 405 is the edge: 404.66 is in band 0
  EXPECT_NEAR(ratio, 0.3, 1e-14);
  int lit = 0;
  for (double const v : values) lit += v > 0;
  EXPECT_EQ(lit, 3);
}

TEST(Spectrum, ReflectanceMeansStayInBoundsAndConstantsConstant) {
  auto const step = *Spectrum::samples({{500, 0}, {500.001, 1}});
  for (int n : {3, 16, 450}) {
    auto const means = *reflectance_bands(step, *Bands::hall(n));
    for (double const v : means) {
      EXPECT_GE(v, 0);
      EXPECT_LE(v, 1 + 1e-15);
    }
  }
  auto const flat = *reflectance_bands(Spectrum::constant(0.3), *Bands::uniform(7));
  for (double const v : flat) EXPECT_EQ(v, 0.3);
  EXPECT_EQ((*reflectance_rgb(Spectrum::constant(0.3))).y, 0.3);
  EXPECT_EQ(reflectance_bands(*Spectrum::blackbody(3000), *Bands::uniform(3)).error().code,
            "E0415");
}

TEST(Spectrum, ColorCheckerHasItsPublishedColours) {
  // sRGB under D65 computed from Ohta's data, e.g. C. S. McCamy's chart: white patch Y about 0.89,
  // black 0.032.
  auto const y = [](char const* name) {
    return luminance(*reflectance_rgb(*load_reflectance(library(), name)));
  };
  EXPECT_NEAR(y("macbeth/19"), 0.90, 0.02);
  EXPECT_NEAR(y("macbeth/24"), 0.032, 0.003);
  EXPECT_NEAR(y("dark skin"), 0.10, 0.01);
  EXPECT_NEAR(y("neutral 5"), 0.195, 0.01);
}

TEST(Spectrum, RgbOfTheColorCheckerConvergesWithTheBands) {
  double worst[4] = {};
  int const counts[] = {8, 16, 45, 450};
  for (int k = 0; k < 4; ++k) {
    Bands const bands = *Bands::uniform(counts[k], 360, 830);
    for (int patch = 1; patch <= 24; ++patch) {
      auto const s = *load_reflectance(library(), fmt::format("macbeth/{}", patch));
      Vec3 const difference = bands.rgb(*reflectance_bands(s, bands)) - *reflectance_rgb(s);
      worst[k] = std::max(worst[k], glm::length(difference));
    }
    RecordProperty(fmt::format("n{}", counts[k]), std::to_string(worst[k]));
  }
  // Second order in the width of the bands; the constant is what these patches ask for.
  for (int k = 0; k < 4; ++k) EXPECT_LT(worst[k], 5.0 / (counts[k] * counts[k]));
}

TEST(Spectrum, RefusesNonsense) {
  EXPECT_FALSE(Spectrum::samples({}).ok());
  EXPECT_FALSE(Spectrum::samples({{500, 1}, {400, 1}}).ok());
  EXPECT_FALSE(Spectrum::power({{400, -1}, {500, 1}}).ok());
  EXPECT_FALSE(Spectrum::power({{400, 0}, {500, 0}}).ok());
  EXPECT_FALSE(Spectrum::blackbody(0).ok());
  EXPECT_FALSE(Spectrum::blackbody(NAN).ok());
  EXPECT_FALSE(Spectrum::lines({{1000, 1}}).ok());
  EXPECT_FALSE(Spectrum::lines({}).ok());
}

TEST(Conductor, MetalsHaveTheirColours) {
  // Normal reflectance of Johnson & Christy gold at 652.6 nm (1.90 eV, n 0.14, k 3.697 from the
  // table).
  auto const gold = *load_metal(library(), "Au");
  auto const [n, k] = gold.index(652.6);
  double const r = ((n - 1) * (n - 1) + k * k) / ((n + 1) * (n + 1) + k * k);
  EXPECT_NEAR(gold.reflectance(652.6, 1), r, 1e-15);
  EXPECT_GT(r, 0.93);
  Vec3 const rgb = gold.reflectance_rgb(1);
  EXPECT_GT(rgb.x, rgb.y);
  EXPECT_GT(rgb.y, rgb.z);
  Bands const bands = *Bands::uniform(45, 360, 830);
  EXPECT_LT(glm::length(bands.rgb(gold.reflectance_bands(bands, 0.5)) - gold.reflectance_rgb(0.5)),
            2e-3);
  EXPECT_NEAR(gold.reflectance(550, 0), 1, 1e-15);
  EXPECT_EQ(load_metal(library(), "D65").error().code, "E0413");
}

TEST(SpectraData, EveryEntryOfEveryKindLoads) {
  int lights = 0, metals = 0, reflectances = 0;
  for (auto const name : library().names()) {
    auto const entry = *library().find(name);
    if (entry.kind == "metal_entry") {
      auto const metal = load_metal(library(), name);
      ASSERT_TRUE(metal.ok()) << name << metal.error().message;
      ++metals;
    } else if (entry.kind == "reflectance_entry") {
      ASSERT_TRUE(load_reflectance(library(), name).ok()) << name;
      ++reflectances;
    } else {
      ASSERT_TRUE(load_light(library(), name).ok()) << name;
      ++lights;
    }
  }
  EXPECT_EQ(lights, 49 + 47 + 9); // illuminants, lamps, short names
  EXPECT_EQ(reflectances, 48);
  EXPECT_GT(metals, 90);
}

TEST(ScanRows, ReadsRowsAndPlacesMistakes) {
  auto const rows = *scan_pairs("lamp_entry \"a { b\" { [400, 1e-3] [401,+2.5],[402 3] }");
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_EQ(rows[1][1], 2.5);
  EXPECT_EQ((*scan_rows<3>("[1,2,3]")).size(), 1u);
  EXPECT_TRUE(scan_pairs("x { }")->empty());
  for (char const* text :
       {"", "x", "x {", "x { [1, 2]", "x { [1] }", "x { [1,2,3] }", "x { [a,b] }", "x { 1 }",
        "[1,2", "[1,2] x", "x { [1e999, 2] }", "x { [nan, 2] }"})
    EXPECT_EQ(scan_pairs(text).error().code, "E0417") << text;
}

} // namespace
} // namespace abbe::optics

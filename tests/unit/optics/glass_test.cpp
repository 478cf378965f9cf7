// SPDX-License-Identifier: MIT
#include "optics/bands.hpp"
#include "optics/glass_builder.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace abbe::optics {
namespace {

std::vector<double> const bk7_b{1.03961212, 0.231792344, 1.01046945};
std::vector<double> const bk7_c{0.00600069867, 0.0200179144, 103.560653};

GlassBuilder bk7() {
  return GlassBuilder("N-BK7").maker("SCHOTT").sellmeier(bk7_b, bk7_c).range_um(0.3, 2.5);
}

TEST(Glass, NBk7MatchesItsDataSheet) {
  // SCHOTT data sheet N-BK7 517642.251: six printed lines.
  auto const glass = *bk7().build();
  EXPECT_NEAR(*glass->nd(), 1.51680, 5e-6);
  EXPECT_NEAR(*glass->vd(), 64.17, 5e-3);
  EXPECT_NEAR(*glass->index(404.6561), 1.53024, 5e-6); // h
  EXPECT_NEAR(*glass->index(435.8343), 1.52668, 5e-6); // g
  EXPECT_NEAR(*glass->index(546.0740), 1.51872, 5e-6); // e
  EXPECT_NEAR(*glass->index(706.5188), 1.51289, 5e-6); // r
  EXPECT_NEAR(*glass->index(1060.0), 1.50669, 5e-6);
  EXPECT_EQ(glass->full_name(), "SCHOTT/N-BK7");
}

TEST(Glass, OutsideItsRangeIsAnErrorNamingGlassWavelengthAndRange) {
  auto const glass = *bk7().build();
  auto const n = glass->index(250);
  ASSERT_FALSE(n.ok());
  EXPECT_EQ(n.error().code, "E0412");
  EXPECT_EQ(n.error().message,
            "the index of glass 'SCHOTT/N-BK7' is known from 300 to 2500 nm, not at 250 nm");
}

TEST(Glass, EveryFormulaComputesItsEquation) {
  double const w = 0.55, w2 = w * w;
  auto const n = [](int id, std::vector<double> c) {
    return GlassFormula::make(id, std::move(c))->index(550);
  };
  EXPECT_NEAR(n(1, {0.1, 1.1, 0.1, 0.9, 10}),
              std::sqrt(1.1 + 1.1 * w2 / (w2 - 0.01) + 0.9 * w2 / (w2 - 100)), 1e-15);
  EXPECT_NEAR(n(2, {0.1, 1.1, 0.1, 0.9, 10}),
              std::sqrt(1.1 + 1.1 * w2 / (w2 - 0.1) + 0.9 * w2 / (w2 - 10)), 1e-15);
  EXPECT_NEAR(n(3, {2.2, 0.01, 2, 0.02, -2, 1e-3, -3.5}),
              std::sqrt(2.2 + 0.01 * w2 + 0.02 / w2 + 1e-3 * std::pow(w, -3.5)), 1e-15);
  EXPECT_NEAR(n(4, {2.2, 0.3, 2, 0.2, 2, 0.1, 0, 10, 1, 0.01, 4}),
              std::sqrt(2.2 + 0.3 * w2 / (w2 - 0.04) + 0.1 / (w2 - 10) + 0.01 * w2 * w2), 1e-15);
  EXPECT_NEAR(n(5, {1.5, 0.004, -2, 1e-4, -4}), 1.5 + 0.004 / w2 + 1e-4 / (w2 * w2), 1e-15);
  EXPECT_NEAR(n(6, {0, 0.05792105, 238.0185, 0.00167917, 57.362}),
              1 + 0.05792105 / (238.0185 - 1 / w2) + 0.00167917 / (57.362 - 1 / w2), 1e-16);
  double const l = 1 / (w2 - 0.028);
  EXPECT_NEAR(n(7, {1.5, 0.003, 1e-4, -0.01, 1e-3, 1e-4}),
              1.5 + 0.003 * l + 1e-4 * l * l - 0.01 * w2 + 1e-3 * w2 * w2 + 1e-4 * w2 * w2 * w2,
              1e-15);
  double const q = 0.2 + 0.1 * w2 / (w2 - 0.04) + 0.01 * w2;
  EXPECT_NEAR(n(8, {0.2, 0.1, 0.04, 0.01}), std::sqrt((1 + 2 * q) / (1 - q)), 1e-15);
  EXPECT_NEAR(n(9, {2.2, 0.1, 0.04, 0.02, 0.3, 0.5}),
              std::sqrt(2.2 + 0.1 / (w2 - 0.04) + 0.02 * (w - 0.3) / ((w - 0.3) * (w - 0.3) + 0.5)),
              1e-15);
}

TEST(Glass, AirOfFormula6MatchesCiddor) {
  // P. E. Ciddor, Appl. Opt. 35, 1566 (1996): standard air at 633 nm has n - 1 = 2.7653e-4.
  auto const air =
      *GlassBuilder("air").formula(6, {0, 0.05792105, 238.0185, 0.00167917, 57.362}).build();
  EXPECT_NEAR(air->index_unchecked(632.9914) - 1, 2.7653e-4, 2e-8);
}

TEST(Glass, AbbeReproducesBothNumbers) {
  auto const glass = *GlassBuilder("crown").abbe(1.5168, 64.17).build();
  EXPECT_NEAR(*glass->nd(), 1.5168, 1e-15);
  EXPECT_NEAR(*glass->vd(), 64.17, 1e-11); // nF - nC has lost two digits
  auto const flat =
      *GlassBuilder("flat").abbe(1.5, std::numeric_limits<double>::infinity()).build();
  EXPECT_FALSE(flat->is_dispersive(380, 780));
  EXPECT_FALSE(flat->vd().has_value());
}

TEST(Glass, SchottAndCauchyFollowTheirDefinitions) {
  std::vector<double> const a{2.2718929,    -1.0108077e-2, 1.0592509e-2,
                              2.0816965e-4, -7.6472538e-6, 4.9240991e-7};
  // BK7 in the old Schott formula (SCHOTT catalogue 1992): nd 1.5168.
  EXPECT_NEAR(*(*GlassBuilder("BK7").schott(a).build())->nd(), 1.5168, 1e-5);
  std::vector<double> const c{1.5, 0.004, 1e-4};
  EXPECT_NEAR((*GlassBuilder("c").cauchy(c).build())->index_unchecked(500), 1.5 + 0.016 + 1.6e-3,
              1e-15);
}

TEST(Glass, PovModelFollowsPovRay) {
  auto const glass = *GlassBuilder("pov").pov(1.5, 1.02).build();
  EXPECT_DOUBLE_EQ(glass->index_unchecked(555), 1.5);
  EXPECT_NEAR(glass->index_unchecked(380) / glass->index_unchecked(730), 1.02, 1e-14);
  EXPECT_TRUE(glass->is_dispersive(380, 780));
  EXPECT_FALSE((*GlassBuilder("pov").pov(1.5, 1).build())->is_dispersive(380, 780));
  EXPECT_FALSE((*GlassBuilder("c").constant(1.5).build())->is_dispersive(380, 780));
  EXPECT_TRUE(GlassBuilder("thin").constant(0.9).build().ok()); // POV-Ray allows it
}

TEST(Glass, SamplesPassThroughTheRowsWithoutOvershoot) {
  auto const glass =
      *GlassBuilder("t").samples({{0.4, 1.53}, {0.5, 1.52}, {0.55, 1.52}, {0.7, 1.51}}).build();
  EXPECT_DOUBLE_EQ(*glass->index(500), 1.52);
  EXPECT_DOUBLE_EQ(*glass->index(525), 1.52);
  double last = 2;
  for (double l = 400; l <= 700; l += 0.5) {
    double const n = *glass->index(l);
    EXPECT_LE(n, last);
    last = n;
  }
  EXPECT_EQ(glass->index(399).error().code, "E0412");
}

TEST(Glass, TransmittanceIsReproducedAtAnyThickness) {
  auto const glass = *bk7().transmittance(10, {{0.4, 0.992}, {0.5, 0.998}, {0.7, 0.997}}).build();
  EXPECT_NEAR(std::exp(-glass->absorption_per_mm(400) * 10), 0.992, 1e-15);
  EXPECT_NEAR(std::exp(-glass->absorption_per_mm(500) * 25), std::pow(0.998, 2.5), 1e-15);
  EXPECT_EQ(glass->absorption_per_mm(300), glass->absorption_per_mm(400));
  EXPECT_FALSE(glass->without_absorption()->absorbs());
  EXPECT_EQ(glass->without_absorption()->absorption_per_mm(400), 0);
}

TEST(Glass, TransmittancesOfFiltersAreWhatTheySay) {
  // 10^-30 of 10 mm: 10^-3 of 1 mm
  auto const filter = *bk7().transmittance(10, {{0.4, 1e-30}, {0.7, 0.9}}).build();
  EXPECT_NEAR(std::exp(-filter->absorption_per_mm(400)), 1e-3, 1e-15);
  auto const printed_zero = *bk7().transmittance(10, {{0.4, 0}, {0.7, 0.9}}).build();
  EXPECT_NEAR(std::exp(-10 * printed_zero->absorption_per_mm(400)), 0.0005, 1e-15);
  auto const darker = *bk7().transmittance(10, {{0.4, 0}, {0.5, 1e-6}, {0.7, 0.9}}).build();
  EXPECT_NEAR(std::exp(-10 * darker->absorption_per_mm(400)), 5e-7, 1e-18);
}

TEST(Glass, SlipsAreDoubted) {
  auto const doubts = [](GlassBuilder const& b) {
    std::string all;
    for (auto const& doubt : b.doubts(**b.build())) all += doubt + "\n";
    return all;
  };
  GlassBuilder const x("x");
  EXPECT_EQ(doubts(bk7()), "");
  EXPECT_EQ(doubts(bk7().printed(1.5168, 64.17)), "");
  EXPECT_EQ(doubts(GlassBuilder(x).abbe(64.17, 1.5168)),
            "the index of glass 'x' is 64.17 at 587.562 nm; no glass lies outside 1..4: are nd and "
            "Vd swapped?\n");
  EXPECT_NE(doubts(GlassBuilder(x).cauchy(std::vector{1.5, 4200.0})).find("are they in nm^2"),
            std::string::npos);
  std::vector<double> const c_nm2{6000.69867, 20017.9144, 103560653};
  EXPECT_NE(doubts(GlassBuilder(x).sellmeier(bk7_b, c_nm2)).find("is it in nm^2?"),
            std::string::npos);
  EXPECT_NE(doubts(GlassBuilder(x).formula(4, {0, 6.04, 2, 44.444, 2, -4088.9, 0, 44.444}))
                .find("formula 4 does not end after 8 coefficients"),
            std::string::npos);
  EXPECT_EQ(doubts(GlassBuilder(x).formula(5, {0.99})),
            "the index of glass 'x' is 0.99 at 587.562 nm; no glass lies outside 1..4\n");
  EXPECT_NE(doubts(bk7().printed(1.6, 64)).find("its nd says 1.6"), std::string::npos);
  EXPECT_NE(doubts(bk7().transmittance(10, {{400, 0.1}, {700, 0.99}})).find("are these nm?"),
            std::string::npos);
  EXPECT_NE(doubts(bk7().extinction({{1, 1e-8}, {2, 1e-7}})).find("no visible wavelength"),
            std::string::npos);
  // Germanium is opaque and far denser in the visible, of which its data says nothing.
  EXPECT_EQ(doubts(GlassBuilder(x).formula(5, {4.0}).range_um(2, 14).extinction({{3, 0}})), "");
  // POV-Ray takes any ior.
  EXPECT_EQ(doubts(GlassBuilder(x).pov(24, 1)), "");
}

TEST(Glass, ExtinctionGivesTheAbsorptionOfTheDataFilesExample) {
  auto const glass = *bk7().extinction({{0.4, 1e-8}, {0.5, 0}}).build();
  // exp(-4 pi k L / lambda) with L = 10 mm = 1e4 um
  EXPECT_NEAR(std::exp(-10 * glass->absorption_per_mm(400)),
              std::exp(-4 * 3.14159265358979 * 1e-8 * 1e4 / 0.4), 1e-14);
  EXPECT_EQ(glass->absorption_per_mm(500), 0);
}

TEST(Glass, RefusesNonsense) {
  auto const code = [](GlassBuilder const& b) {
    return b.build().ok() ? "ok" : b.build().error().code;
  };
  double const nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(code(GlassBuilder("x")), "E0410");
  EXPECT_EQ(code(bk7().constant(1.5)), "E0410");
  EXPECT_EQ(code(GlassBuilder("x").formula(10, {1})), "E0410");
  EXPECT_EQ(code(GlassBuilder("x").formula(7, {1, 2, 3, 4, 5, 6, 7})), "E0410");
  EXPECT_EQ(code(GlassBuilder("x").formula(3, {})), "E0410");
  EXPECT_EQ(code(GlassBuilder("x").formula(3, {nan})), "E0410");
  EXPECT_EQ(code(GlassBuilder("x").sellmeier(bk7_b, std::vector<double>{1})), "E0410");
  EXPECT_EQ(code(GlassBuilder("x").abbe(1.5, 0)), "E0410");
  EXPECT_EQ(code(GlassBuilder("x").samples({{0.5, 1.5}, {0.5, 1.5}})), "E0410");
  EXPECT_EQ(code(GlassBuilder("x").samples({})), "E0410");
  EXPECT_EQ(code(bk7().transmittance(0, {{0.4, 0.9}})), "E0410");
  EXPECT_EQ(code(bk7().transmittance(10, {{0.4, 1.1}})), "E0410");
  EXPECT_EQ(code(bk7().extinction({{0.4, -1e-8}})), "E0410");
  EXPECT_EQ(code(bk7().medium("water")), "E0410");
  EXPECT_EQ(code(GlassBuilder("x").constant(1.5).range_um(0.7, 0.4)), "E0410");
  // A pole at 500 nm, then n^2 < 0 without a pole, then n < 1.
  EXPECT_EQ(code(GlassBuilder("x").formula(2, {0, 1, 0.25})), "E0411");
  EXPECT_EQ(code(GlassBuilder("x").formula(3, {-1})), "E0411");
  EXPECT_EQ(code(GlassBuilder("x").formula(5, {-0.99})), "E0411");
}

} // namespace
} // namespace abbe::optics

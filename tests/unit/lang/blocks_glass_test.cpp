// SPDX-License-Identifier: MIT
#include "blocks_scene.hpp"
#include "optics/glass.hpp"

#include <cmath>

namespace abbe::lang {
namespace {

std::shared_ptr<scene::Interior const> interior(std::string const& items) {
  return scene_of("sphere { 0, 1 interior { " + items + " } }").objects.at(0).interior;
}
std::shared_ptr<optics::Glass const> glass(std::string const& content) {
  return interior("glass { " + content + " }")->glass;
}
std::string glass_codes(std::string const& content) {
  return codes("sphere { 0, 1 interior { glass { " + content + " } } }");
}

TEST(Glass, IsNamedOutOfTheCatalogue) {
  // SCHOTT data sheets: N-SF11 nd 1.78472 Vd 25.68; N-BK7 1.51680, 64.17
  auto const sf11 = glass("\"N-SF11\"");
  EXPECT_NEAR(*sf11->nd(), 1.78472, 5e-6);
  EXPECT_NEAR(*sf11->vd(), 25.68, 5e-3);
  auto const bk7 = interior("glass \"SCHOTT/N-BK7\"")->glass;
  EXPECT_NEAR(*bk7->nd(), 1.51680, 5e-6);
  EXPECT_EQ(bk7->full_name(), "SCHOTT/N-BK7");
  EXPECT_TRUE(bk7->absorbs());
  EXPECT_EQ(glass("\"sapphire/o\"")->full_name(), "sapphire/o");
}

TEST(Glass, UnknownNamesGetTheNearestAndAmbiguousOnesTheirMakers) {
  auto const unknown = evaluate("sphere { 0, 1 interior { glass { \"N-BK8\" } } }");
  ASSERT_EQ(unknown.diagnostics.size(), 1u);
  EXPECT_NE(unknown.diagnostics[0].message.find("N-BK7"), std::string::npos);
  auto const ambiguous = evaluate("sphere { 0, 1 interior { glass { \"F2\" } } }");
  ASSERT_EQ(ambiguous.diagnostics.size(), 1u);
  EXPECT_NE(ambiguous.diagnostics[0].message.find("SCHOTT/F2"), std::string::npos);
}

TEST(Glass, EveryFormulaOfTheContractIsRead) {
  // N-BK7's published Sellmeier coefficients
  auto const sellmeier = glass("sellmeier <1.03961212, 0.231792344, 1.01046945>,\n"
                               "<0.00600069867, 0.0200179144, 103.560653> range 0.3, 2.5\n"
                               "transmittance 10 { [0.40, 0.992] [0.50, 0.998] [0.70, 0.997] }");
  EXPECT_NEAR(*sellmeier->nd(), 1.51680, 5e-6);
  EXPECT_EQ(sellmeier->range_nm().lo_nm, 300);
  EXPECT_NEAR(std::exp(-10 * sellmeier->absorption_per_mm(500)), 0.998, 1e-12);
  EXPECT_NEAR(*glass("schott <2.25, 0, 0.01, 0, 0, 0>")->nd(),
              std::sqrt(2.25 + 0.01 / (0.5875618 * 0.5875618)), 1e-14);
  EXPECT_NEAR(*glass("cauchy <1.5, 0.004, 0.0001>")->nd(),
              1.5 + 0.004 / std::pow(0.5875618, 2) + 0.0001 / std::pow(0.5875618, 4), 1e-14);
  auto const abbe = glass("abbe 1.5168, 64.17");
  EXPECT_NEAR(*abbe->nd(), 1.5168, 1e-12);
  EXPECT_NEAR(*abbe->vd(), 64.17, 1e-8);
  auto const formula = glass("formula 2 { 0, 1.03961212, 0.00600069867, 0.231792344, 0.0200179144, "
                             "1.01046945, 103.560653 }");
  EXPECT_NEAR(*formula->nd(), *sellmeier->nd(), 1e-14);
  auto const samples = glass("samples { [0.38, 1.54] [0.55, 1.5185] [0.80, 1.51] }");
  EXPECT_NEAR(*samples->index(550), 1.5185, 1e-14);
}

TEST(Glass, DeclaredOnesCanBeChanged) {
  auto const s = scene_of("#declare Crown = glass { \"SCHOTT/N-BK7\" }\n"
                          "sphere { 0, 1 interior { glass { Crown absorption off } } }\n"
                          "sphere { 0, 1 interior { glass Crown } }\n"
                          "sphere { 0, 1 interior { glass { Crown } } }");
  EXPECT_FALSE(s.objects[0].interior->glass->absorbs());
  EXPECT_TRUE(s.objects[1].interior->glass->absorbs());
  EXPECT_EQ(s.objects[1].interior->glass, s.objects[2].interior->glass);
}

TEST(Glass, OurWordsStayFreeForPovRaysScenes) {
  auto const s = scene_of("#declare lines = 3; #declare Glass = texture { pigment { rgb 0.5 } }\n"
                          "#declare bands = 2; #declare glass = 1;\n"
                          "sphere { lines, bands texture { Glass } }");
  EXPECT_EQ(s.objects[0].placement.point(Vec3(0)), Vec3(3));
}

TEST(Glass, AnAgfFileMakesItsGlassesNameable) {
  auto const s = scene_of("glass_catalog \"sample.agf\"\n"
                          "sphere { 0, 1 interior { glass { \"sample/N-BK7\" } } }");
  EXPECT_NEAR(*s.objects[0].interior->glass->nd(), 1.5168, 1e-5);
  EXPECT_EQ(codes("glass_catalog \"nowhere.agf\""), "E0501");
}

TEST(Glass, MistakesAreNamedOnce) {
  EXPECT_EQ(glass_codes("range 0.3, 2.5"), "E0410");
  EXPECT_EQ(glass_codes("cauchy <1.5, 0.004> abbe 1.5, 60"), "E0410");
  EXPECT_EQ(glass_codes("formula 12 { 1 }"), "E0304");
  EXPECT_EQ(glass_codes("samples { [0.5, 1.5] [0.4, 1.6] }"), "E0410");
  EXPECT_EQ(glass_codes("\"N-BK7\" range 0.1, 0.2"), "E0203");
}

TEST(Glass, ItsRangeMustCoverTheBands) {
  std::string const narrow =
      "sphere { 0, 1 interior { glass { cauchy <1.5, 0.004> range 0.45, 0.7 } ";
  EXPECT_EQ(codes(narrow + "} }"), "E0412");
  EXPECT_EQ(codes(narrow + "} }\nglobal_settings { spectral { range 450, 700 } }"), "");
  EXPECT_EQ(codes(narrow + "dispersion { none } } }"), "");
  // Not in the scene, not asked.
  EXPECT_EQ(codes("#declare S = " + narrow + "} }"), "");
  auto const e = evaluate(narrow + "} }");
  ASSERT_EQ(e.diagnostics.size(), 1u);
  EXPECT_NE(e.diagnostics[0].message.find("380"), std::string::npos);
  EXPECT_NE(e.diagnostics[0].message.find("450"), std::string::npos);
}

TEST(Dispersion, ModesAreRead) {
  using Mode = scene::DispersionMode;
  auto const mode = [](std::string const& text) {
    return interior("glass { abbe 1.5, 60 } " + text)->dispersion;
  };
  EXPECT_EQ(mode("").kind, Mode::Kind::Inherit);
  EXPECT_EQ(mode("dispersion { none }").kind, Mode::Kind::None);
  EXPECT_EQ(mode("dispersion { deterministic }").kind, Mode::Kind::Deterministic);
  EXPECT_EQ(mode("dispersion { stochastic }").kind, Mode::Kind::Stochastic);
  EXPECT_EQ(mode("dispersion { stochastic faithful }").comb.follow, optics::Comb::Follow::Doubled);
  auto const jittered = mode("dispersion { stochastic jitter triangular 2 }");
  EXPECT_EQ(jittered.comb.jitter, optics::Comb::Jitter::Triangular);
  EXPECT_EQ(jittered.comb.width, 2);
  EXPECT_EQ(codes("sphere { 0, 1 interior { dispersion { } } }"), "E0250");
  EXPECT_EQ(codes("sphere { 0, 1 interior { dispersion { deterministic jitter uniform 1 } } }"),
            "E0252");
  EXPECT_EQ(codes("sphere { 0, 1 interior { dispersion { determinstic } } }"), "E0202");
}

TEST(Interior, KeepsPovRaysOwnForm) {
  auto const i =
      interior("ior 1.5 dispersion 1.02 dispersion_samples 9 caustics 0.5 fade_distance 2\n"
               "fade_power 1001 fade_color rgb <1, 0.5, 0>");
  EXPECT_EQ(i->ior, 1.5);
  EXPECT_EQ(i->pov_dispersion, 1.02);
  EXPECT_EQ(i->pov_dispersion_samples, 9);
  EXPECT_EQ(i->caustics, 0.5);
  EXPECT_EQ(i->fade_colour.rgb, Vec3(1, 0.5, 0));
  EXPECT_EQ(codes("sphere { 0, 1 interior { media { emission 1 density { spherical } } ior 1 } }"),
            "E0903");
  EXPECT_EQ(codes("sphere { 0, 1 interior { ior 1.5 glass { abbe 1.5, 60 } } }"), "E0422");
}

TEST(Interior, OddFadesWarnAndThoseWithoutBoundAreErrors) {
  auto const ok = [](std::string const& items) {
    return evaluate("sphere { 0, 1 interior { " + items + " } }").ok();
  };
  auto const warns = [](std::string const& items) {
    return codes("sphere { 0, 1 interior { " + items + " } }");
  };
  EXPECT_EQ(warns("fade_distance 2"), "E0353");
  EXPECT_EQ(warns("fade_distance 2 fade_power -1"), "E0353");
  EXPECT_EQ(warns("fade_power 0"), "");
  EXPECT_EQ(warns("fade_distance -2 fade_power 2"), "");
  EXPECT_TRUE(ok("fade_distance 2") && ok("fade_distance 2 fade_power -1"));
  for (char const* power : {"1", "3", "0.5", "1000", "-1"})
    EXPECT_FALSE(ok(std::string("fade_distance -2 fade_power ") + power)) << power;
}

} // namespace
} // namespace abbe::lang

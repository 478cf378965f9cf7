// SPDX-License-Identifier: MIT
#include "pixel.hpp"

/// Area lights, cylinders and groups of lights against closed formulas.
namespace abbe::physics {
namespace {

constexpr double diffuse = 0.5;

/// The origin of the white plane, seen from near by.
std::string lit(std::string const& lamps, std::string const& objects = "") {
  return look(place(0, 0, 0.5))
         + plane(fmt::format("pigment {{ rgb 1 }} finish {{ ambient 0 diffuse {} }}", diffuse))
         + objects + lamps;
}
void expect_lit(std::string const& body, Vec3 const& expected) {
  expect_light(body, diffuse * expected);
}

/// Straight before the plane, 4 away, 4 wide along x.
std::string area(int many, std::string const& items = "", double brightness = 1) {
  return lamp({0, 0, -4}, Vec3(brightness),
              fmt::format("area_light 4*x, y, {}, 1 {}", many, items));
}
/// Opaque, 1 before the plane: shadows the places between these x of the lamp's plane.
std::string blocker(double from, double to) {
  return fmt::format("box {{ <{}, -9, -1.0001>, <{}, 9, -1> }}\n", from / 4, to / 4);
}

TEST(Area, WeighsItsPlacesByQuarters) {
  // light.md of POV-Ray: n = 3: 1 2 1; 4: 1 1 1 1; 5: 1 2 2 2 1; 6: 1 2 1 1 2 1; 7: 1 1 1 2 1 1 1.
  std::vector<std::vector<int>> const weights{{1},
                                              {1, 1},
                                              {1, 2, 1},
                                              {1, 1, 1, 1},
                                              {1, 2, 2, 2, 1},
                                              {1, 2, 1, 1, 2, 1},
                                              {1, 1, 1, 2, 1, 1, 1}};
  for (auto const& row : weights) {
    int sum = 0, before = 0;
    for (int const weight : row) sum += weight;
    auto const many = static_cast<int>(row.size());
    for (int dark = 0; dark <= many; ++dark) {
      double const edge = many == 1 ? (dark == 0 ? -1 : 1) : -2 + 4 * (dark - 0.5) / (many - 1);
      expect_lit(lit(area(many), blocker(-9, edge)), Vec3(1 - static_cast<double>(before) / sum));
      if (dark < many) before += row[static_cast<std::size_t>(dark)];
    }
  }
}

TEST(Area, AsksCornersFirstWhereItIsAdaptive) {
  // The middle of nine is dark: what no corner sees is not there.
  std::string const thin = blocker(-0.2, 0.2);
  expect_lit(lit(area(9), thin), Vec3(1 - 2.0 / 16));
  expect_lit(lit(area(9, "adaptive 0"), thin), Vec3(1));
  expect_lit(lit(area(9, "adaptive 1"), thin), Vec3(1 - 2.0 / 16)); // 0 4 8, then between
  // One corner is dark: its side is looked at, unless the light is so faint that no one sees.
  std::string const half = blocker(-9, -0.2);
  expect_lit(lit(area(9, "adaptive 0"), half), Vec3(1 - 7.0 / 16));
  expect_lit(lit(area(9, "adaptive 0", 0.03), half), 0.03 * Vec3(0.5));
  expect_lit(lit(area(9, "adaptive 0", 0.034), half), 0.034 * Vec3(1 - 7.0 / 16));
}

TEST(Area, IsFilteredOnEachWay) {
  // Half of the places are seen through a pane.
  std::string const pane =
      "box { <-9, -9, -1.0001>, <0, 9, -1> pigment { rgbf <1, 0.5, 0, 1> } }\n";
  expect_lit(lit(area(4), pane), Vec3(1, 0.5 + 0.5 * 0.25, 0.5));
}

TEST(Area, IsTheMeanOfItsPlacesWhereTheseAreLights) {
  double sum = 0;
  for (int i = 0; i < 5; ++i) {
    double const x = i - 2;
    sum += 4 / std::sqrt(16 + x * x) * 2 / (1 + (16 + x * x) / 9); // cosine and fade
  }
  expect_lit(lit(area(5, "area_illumination fade_distance 3 fade_power 2")), Vec3(sum / 5));
  expect_lit(lit(area(5, "area_illumination off")), Vec3(1));
}

TEST(Area, OfParallelLightIsMovedWithTheSurface) {
  std::string const sun =
      lamp({7, 0, -4}, Vec3(1), "parallel point_at <7, 0, 0> area_light 4*x, y, 4, 1");
  expect_lit(lit(sun, blocker(-9, 0)), Vec3(0.5));
}

TEST(Area, IsTurnedToWhatIsLit) {
  // Its axes are along the way as they are given, and across it when they are turned.
  std::string const on_end = "area_light 2*z, z, 3, 1 ";
  std::string const narrow_pane = blocker(-9, -0.5);
  expect_lit(lit(lamp({0, 0, -4}, Vec3(1), on_end), narrow_pane), Vec3(1));
  // Across z, from (0, 1, 0) x: along x.
  expect_lit(lit(lamp({0, 0, -4}, Vec3(1), on_end + "orient"), narrow_pane), Vec3(0.75));
}

TEST(Area, ThatIsCircularHasItsCornersOnACircle) {
  // Of 3 x 3 places two apart, the corner ones are 2 from the middle, not 2 sqrt 2: 1.41 along x.
  for (double const edge : {-1.6, -1.3}) {
    std::string const body =
        lit(lamp({0, 0, -4}, Vec3(1), "area_light 4*x, 4*y, 3, 3 circular"), blocker(-9, edge));
    // Left of -1.6: the middle of the left side only; weights 1 2 1 squared, of 16.
    expect_lit(body, Vec3(edge < -1.5 ? 14.0 / 16 : 12.0 / 16));
  }
}

TEST(Area, JitteredIsRightInTheMean) {
  // Half of its extent is dark; pixels are samples of their own.
  auto const image = picture(lit(area(4, "jitter"), blocker(-9, 0.4)), 64, 64);
  double sum = 0, least = 1, most = 0;
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x) {
      double const value = pixel(image, x, y).x / diffuse;
      sum += value;
      least = std::min(least, value);
      most = std::max(most, value);
    }
  // Places at -2 -2/3 2/3 2, up to 2/3 to the side: the third is dark where it is drawn below 0.4.
  double const dark = 0.5 + 0.25 * (0.4 / (4.0 / 3));
  EXPECT_NEAR(sum / (64 * 64), 1 - dark, 0.01);
  EXPECT_NEAR(least, 0.25, 1e-6);
  EXPECT_NEAR(most, 0.5, 1e-6);
}

TEST(Cylinder, FallsWithTheDistanceFromItsAxis) {
  for (double const off : {0.0, 0.4, 1.0, 1.2, 1.9, 2.1})
    for (double const tightness : {0.0, 2.0}) {
      double const x = std::clamp(2 - off, 0.0, 1.0);
      double const share = off < 2 ? std::pow(1 - off / 2, tightness) * x * x * (3 - 2 * x) : 0;
      expect_lit(
          lit(lamp({off, 0, -4}, Vec3(1),
                   fmt::format("cylinder point_at <{}, 0, 0> radius 1 falloff 2 tightness {}", off,
                               tightness))),
          Vec3(share));
    }
}

TEST(Cylinder, HasRadiiAndShinesForwards) {
  expect_lit(lit(lamp({0.875, 0, -4}, Vec3(1), "cylinder point_at <0.875, 0, 0>")), Vec3(0.5));
  expect_lit(lit(lamp({0, 0, -4}, Vec3(1), "cylinder point_at <0, 0, -8>")), Vec3(0));
}

TEST(ProjectedThrough, LightComesThroughTheObjectOnly) {
  auto const through = [](std::string const& object) {
    return lamp({0, 0, -4}, Vec3(1), "projected_through { " + object + " }");
  };
  std::string const gate = "sphere { -2*z, 0.5 }";
  expect_lit(lit(through(gate)), Vec3(1));
  expect_lit(lit(through("sphere { <2, 0, -2>, 0.5 }")), Vec3(0));
  expect_lit(lit(through("sphere { -6*z, 0.5 }")), Vec3(0)); // behind the lamp
  // What is between the two casts no shadow; what is before it does.
  expect_lit(lit(through(gate), "sphere { -3.2*z, 0.3 }\n"), Vec3(1));
  expect_lit(lit(through(gate), "sphere { -z, 0.3 }\n"), Vec3(0));
  // It moves with the lamp.
  expect_lit(lit(lamp({9, 0, -4}, Vec3(1),
                      "projected_through { sphere { <9, 0, -2>, .5 } } "
                      "translate -9*x")),
             Vec3(1));
}

TEST(LightGroups, LightWhatIsInThem) {
  std::string const seen = look(place(0, 0, 0.5));
  std::string const wall = plane("pigment { rgb 1 } finish { ambient 0 diffuse 0.5 }");
  auto const of = [&](Vec3 const& colour) { return lamp({0, 0, -4}, colour); };
  Vec3 const r(1, 0, 0), g(0, 1, 0), b(0, 0, 1);
  auto const group = [](std::string const& content) { return "light_group { " + content + " }\n"; };
  expect_lit(seen + of(r) + group(of(g) + wall), g);
  expect_lit(seen + of(r) + group(of(g) + wall + " global_lights on"), r + g);
  expect_lit(seen + of(r) + group(of(g)) + wall, r);
  // Within another group: its own lights, and those of none where the outermost says so.
  expect_lit(seen + of(r) + group(of(g) + group(of(b) + wall)), b);
  expect_lit(seen + of(r) + group(of(g) + group(of(b) + wall + " global_lights on")), b);
  expect_lit(seen + of(r) + group(of(g) + group(of(b) + wall) + " global_lights on"), r + b);
  // A union is no group.
  expect_lit(seen + group(of(g) + "union { " + of(b) + wall + " }"), g);
  expect_lit(seen + group(of(g) + "union { " + of(b) + " sphere { 99, 1 } }") + wall, b);
  // Shadows are cast by all.
  expect_lit(seen + group(of(g) + wall) + "sphere { -2*z, 0.5 }\n", Vec3(0));
  // Each copy is a group of its own.
  expect_lit(seen + "#declare G = light_group { " + of(g) + " sphere { 99, 1 } }\n"
                 + "object { G } " + group(of(b) + wall + " object { G }"),
             b);
}

TEST(LooksLike, IsSeenAndCastsNoShadow) {
  std::string const body = lamp({0, 0, -4}, Vec3(1),
                                "looks_like { sphere { 0, 1 pigment { rgb x } finish { ambient 1 "
                                "diffuse 0 } } }");
  expect_lit(lit(body), Vec3(1));
  expect_light("camera { location -9*z direction z right 1e-9*x up 1e-9*y }\n" + body,
               Vec3(1, 0, 0));
}

} // namespace
} // namespace abbe::physics

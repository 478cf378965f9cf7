// SPDX-License-Identifier: MIT
#include "pixel.hpp"

/// Highlights of lamps: Phong's and Blinn's.
namespace abbe::physics {
namespace {

constexpr Vec3 sun(1, 0.75, 0.5);
constexpr Vec3 gold(0.9, 0.7, 0.2);

/// A lamp and an eye: angles to the normal, and how far the lamp is turned out of the plane of
/// incidence (at 180 the mirrored ray hits it, if the angles are alike).
struct View {
  Vec3 eye, at;

  Vec3 way() const { return glm::normalize(-eye); }
  Vec3 to_lamp() const { return glm::normalize(at); }
  double lambert() const { return glm::dot(normal, to_lamp()); }
  /// The cosine between the mirrored ray and the lamp.
  double phong() const { return glm::dot(mirrored(way()), to_lamp()); }
  /// The cosine between the normal and the direction half way between eye and lamp.
  double blinn() const { return glm::dot(normal, glm::normalize(to_lamp() - way())); }
};
View const views[] = {{place(0), place(0, 0, 7)},     {place(30), place(30, 180)},
                      {place(30), place(40, 170)},    {place(60, 20), place(45, 190)},
                      {place(80), place(70, 180, 2)}, {place(20), place(55, 60)}};

std::string shining(View const& view, std::string const& items, std::string const& more = "") {
  return look(view.eye)
         + plane(fmt::format("pigment {{ rgb {} }} finish {{ ambient 0 diffuse 0 {} }} {}",
                             text(gold), items, more))
         + lamp(view.at, sun);
}

TEST(Phong, IsThePowerOfTheCosineToTheMirroredRay) {
  for (View const& view : views) {
    ASSERT_GT(view.phong(), 0);
    for (double const size : {1.0, 2.5, 40.0, 250.0}) {
      double const given = std::pow(view.phong(), size);
      expect_light(shining(view, fmt::format("phong 0.8 phong_size {}", size)), sun * 0.8 * given);
      expect_light(shining(view, fmt::format("phong albedo 0.01 phong_size {}", size)),
                   sun * 0.01 * given * (size + 1) / 2.0);
    }
    expect_light(shining(view, "phong 0.8"), sun * 0.8 * std::pow(view.phong(), 40));
  }
}

TEST(Phong, EndsWhereTheMirroredRayTurnsAway) {
  View const view{place(60), place(60, 0)}; // back to where the eye is
  ASSERT_LT(view.phong(), 0);
  expect_light(shining(view, "phong 1 phong_size 2"), Vec3(0));
}

TEST(Specular, IsThePowerOfTheCosineToTheHalfWay) {
  for (View const& view : views) {
    for (double const roughness : {1.0, 0.3, 0.05, 0.004}) {
      double const e = 1 / roughness;
      double const given = std::pow(view.blinn(), e);
      expect_light(shining(view, fmt::format("specular 0.8 roughness {}", roughness)),
                   sun * 0.8 * given);
      expect_light(shining(view, fmt::format("specular albedo 0.01 roughness {}", roughness)),
                   sun * 0.01 * given * (e + 2) / (4 * (2 - std::pow(2, -e / 2))));
    }
    expect_light(shining(view, "specular 0.8"), sun * 0.8 * std::pow(view.blinn(), 20));
  }
}

TEST(Highlights, AddUpWithWhatIsScattered) {
  for (View const& view : views)
    expect_light(look(view.eye)
                     + plane(fmt::format("pigment {{ rgb {} }} finish {{ ambient 0.2 diffuse 0.5 "
                                         "phong 0.3 phong_size 8 specular 0.4 roughness 0.1 }}",
                                         text(gold)))
                     + lamp(view.at, sun),
                 gold * (0.2 + 0.5 * view.lambert() * sun)
                     + sun * (0.3 * std::pow(view.phong(), 8) + 0.4 * std::pow(view.blinn(), 10)));
}

TEST(Highlights, DoNotDependOnPigmentAndOpacity) {
  View const& view = views[2];
  double const given = 0.3 * std::pow(view.phong(), 8) + 0.4 * std::pow(view.blinn(), 10);
  for (char const* pigment : {"rgb 0", "rgbt <1, 0.5, 0.2, 0.75>", "rgbf <0.2, 0.5, 0.2, 1>"})
    expect_light(look(view.eye)
                     + plane(fmt::format("pigment {{ {} }} finish {{ ambient 0 diffuse 0 phong 0.3 "
                                         "phong_size 8 specular 0.4 roughness 0.1 }}",
                                         pigment))
                     + lamp(view.at, sun),
                 sun * given);
}

TEST(Highlights, OfMetalAreTintedLessAtGrazingAngles) {
  for (View const& view : views)
    for (double const amount : {1.0, 0.4}) {
      Vec3 const tint = metallic(amount, view.lambert(), gold);
      expect_light(shining(view, fmt::format("phong 0.8 phong_size 5 metallic {}", amount)),
                   sun * tint * 0.8 * std::pow(view.phong(), 5));
      expect_light(shining(view, fmt::format("specular 0.8 roughness 0.2 metallic {}", amount)),
                   sun * tint * 0.8 * std::pow(view.blinn(), 5));
    }
  expect_light(shining(views[3], "phong 0.8 phong_size 5 metallic"),
               sun * metallic(1, views[3].lambert(), gold) * 0.8 * std::pow(views[3].phong(), 5));
}

TEST(Highlights, AreOfLampsOnTheSideOfTheEye) {
  // The lamp just behind the plane, where the mirrored ray still goes its way.
  View view{place(85), place(88, 180)};
  view.at.z = -view.at.z;
  ASSERT_GT(view.phong(), 0.9);
  expect_light(shining(view, "phong 1 phong_size 2 specular 1"), Vec3(0));
  expect_light(shining(view, "phong 1 phong_size 2", "double_illuminate"),
               sun * std::pow(view.phong(), 2));
}

TEST(Highlights, AreNotOfLampsWithoutShadows) {
  View const& view = views[1];
  expect_light(look(view.eye)
                   + plane(fmt::format(
                       "pigment {{ rgb {} }} finish {{ ambient 0 diffuse 0.5 phong 1 specular "
                       "1 }}",
                       text(gold)))
                   + lamp(view.at, sun, "shadowless"),
               gold * 0.5 * view.lambert() * sun);
}

} // namespace
} // namespace abbe::physics

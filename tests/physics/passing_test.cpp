// SPDX-License-Identifier: MIT
#include "pixel.hpp"

#include <algorithm>
#include <vector>

/// Light that passes surfaces and what is within them.
namespace abbe::physics {
namespace {

/// A luminous wall behind everything.
constexpr Vec3 wall(0.9, 0.4, 0.2);
std::string behind() {
  return fmt::format("plane {{ -z, -50 pigment {{ rgb {} }} finish {{ ambient 0 diffuse 0 emission "
                     "1 }} }}\n",
                     text(wall));
}
std::string clear(std::string const& colour) {
  return fmt::format("pigment {{ {} }} finish {{ ambient 0 diffuse 0 }}", colour);
}

TEST(Passing, IsFilteredByTheColourAndTransmittedWithoutIt) {
  Vec3 const paint(0.8, 0.5, 0.3);
  for (auto const& [filter, transmit] :
       {std::pair(1.0, 0.0), {0.0, 1.0}, {0.5, 0.0}, {0.25, 0.5}, {0.0, 0.0}}) {
    std::string const pigment = fmt::format("rgbft <0.8, 0.5, 0.3, {}, {}>", filter, transmit);
    expect_light(look(place(35)) + plane(clear(pigment)) + behind(),
                 (filter * paint + transmit) * wall);
  }
}

TEST(Passing, ManySurfacesMultiplies) {
  Vec3 const once = 0.5 * Vec3(0.8, 0.5, 0.3) + 0.25;
  std::string panes;
  Vec3 expected = wall;
  for (int i = 0; i < 8; ++i) {
    panes +=
        fmt::format("disc {{ {}*z, -z, 100 {} }}\n", i, clear("rgbft <0.8, 0.5, 0.3, 0.5, 0.25>"));
    expected *= once;
  }
  expect_light(look(place(25)) + panes + behind(), expected);
}

/// A slab of 2 with an interior, entered at the origin at an angle.
std::string slab(double angle_deg, std::string const& interior) {
  return look(place(angle_deg, 60))
         + fmt::format("box {{ <-99, -99, 0>, <99, 99, 2> {} interior {{ {} }} }}\n",
                       clear("rgbt 1"), interior)
         + behind();
}

TEST(Fading, IsByAPowerOfTheWayInside) {
  for (double const angle : {0.0, 40.0, 75.0})
    for (double const power : {1.0, 2.0, 3.5}) {
      double const way = 2 / std::cos(radians(angle));
      double const left = 1 / (1 + std::pow(way / 1.5, power));
      expect_light(slab(angle, fmt::format("fade_distance 1.5 fade_power {}", power)), left * wall);
      Vec3 const colour(0.2, 0.5, 1);
      expect_light(slab(angle, fmt::format("fade_distance 1.5 fade_power {} fade_color rgb {}",
                                           power, text(colour))),
                   (colour + (Vec3(1) - colour) * left) * wall);
    }
}

TEST(Fading, IsExponentialFromAPowerOfAThousandOn) {
  Vec3 const colour(0.2, 0.5, 1);
  for (double const angle : {0.0, 40.0, 75.0})
    for (double const power : {1000.0, 1001.0}) {
      double const way = 2 / std::cos(radians(angle));
      Vec3 left;
      for (int c = 0; c < 3; ++c) left[c] = std::exp(-(1 - colour[c]) * way / 1.5);
      expect_light(slab(angle, fmt::format("fade_distance 1.5 fade_power {} fade_color rgb {}",
                                           power, text(colour))),
                   left * wall);
    }
}

TEST(Fading, OfShadowsIsByTheirOwnWay) {
  // The eye between the slab and the plane z = 0; light through 2 of it, at 60 degrees.
  std::string const body =
      look({0, 0, -1}) + plane("pigment { rgb 1 } finish { ambient 0 diffuse 1 }")
      + fmt::format("box {{ <-99, -99, -4>, <99, 99, -2> {} interior {{ fade_distance 3 fade_power "
                    "2 fade_color rgb <0.5, 0, 1> }} }}\n",
                    clear("rgbt 1"))
      + lamp(place(60, 0, 20));
  double const left = 1 / (1 + std::pow(2 / 0.5 / 3, 2));
  expect_light(body, 0.5 * Vec3(0.5 + 0.5 * left, left, 1));
}

/// A layer as the model has it.
struct Layer {
  Vec3 paint;
  double filter, transmit, ambient, diffuse, phong;

  std::string texture() const {
    return fmt::format("texture {{ pigment {{ rgbft <{}, {}, {}, {}, {}> }} finish {{ ambient {} "
                       "diffuse {} phong {} phong_size 3 }} }}\n",
                       paint.x, paint.y, paint.z, filter, transmit, ambient, diffuse, phong);
  }
};

/// From the top to the bottom each adds its own light, filtered by those above it.
Vec3 seen(std::vector<Layer> layers, double lambert, double phong, Vec3 const& under) {
  Vec3 sum(0), left(1);
  std::reverse(layers.begin(), layers.end());
  for (Layer const& layer : layers) {
    double const opacity = 1 - layer.filter - layer.transmit;
    sum += left
           * (layer.paint * opacity * (layer.ambient + layer.diffuse * lambert)
              + layer.phong * std::pow(phong, 3));
    left *= layer.filter * layer.paint + layer.transmit;
  }
  return sum + left * under;
}

TEST(Layers, AreSeenThroughThoseAboveThem) {
  Layer const ground{{0.8, 0.6, 0.2}, 0, 0, 0.2, 0.7, 0.1};
  Layer const glaze{{0.2, 0.9, 0.5}, 0.6, 0.1, 0.1, 0.5, 0.4};
  Layer const film{{0.9, 0.9, 0.1}, 0, 0.8, 0, 0.9, 0.2};
  Vec3 const eye = place(30), at = place(50, 170);
  double const lambert = std::cos(radians(50));
  double const phong = glm::dot(mirrored(glm::normalize(-eye)), glm::normalize(at));
  ASSERT_GT(phong, 0.5);
  for (std::vector<Layer> const& layers :
       std::vector<std::vector<Layer>>{{ground},
                                       {glaze},
                                       {ground, glaze},
                                       {glaze, film},
                                       {ground, glaze, film},
                                       {film, ground},
                                       {film, glaze, film, glaze}}) {
    std::string textures;
    for (Layer const& layer : layers) textures += layer.texture();
    expect_light(look(eye) + plane(textures) + lamp(at) + behind(),
                 seen(layers, lambert, phong, wall));
  }
}

TEST(Layers, MirrorEachWhatItIsGiven) {
  // Upper layers take nothing from what the lower ones mirror.
  std::string const layers =
      "texture { pigment { rgb 0 } finish { ambient 0 diffuse 0 reflection 0.4 } }\n"
      "texture { pigment { rgbt <0, 0, 0, 0.5> } finish { ambient 0 diffuse 0 reflection 0.25 } "
      "}\n";
  expect_light("background { rgb <0.6, 0.8, 1.5> }\n" + look(place(40)) + plane(layers),
               (0.4 + 0.25) * Vec3(0.6, 0.8, 1.5));
}

} // namespace
} // namespace abbe::physics

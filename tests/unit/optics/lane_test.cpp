// SPDX-License-Identifier: MIT
#include "base/random.hpp"
#include "optics/refract.hpp"

#include <gtest/gtest.h>

#include <array>
#include <functional>

namespace other {

/// The least a vector of doubles must offer to the templates of optics.
struct Mask {
  std::array<bool, 4> v{};
};
struct Four {
  std::array<double, 4> v{};
  Four() = default;
  explicit Four(double x) { v.fill(x); }
};
template <class F>
Four map(Four const& a, Four const& b, F f) {
  Four r;
  for (std::size_t i = 0; i < 4; ++i) r.v[i] = f(a.v[i], b.v[i]);
  return r;
}
template <class F>
Mask test(Four const& a, Four const& b, F f) {
  Mask r;
  for (std::size_t i = 0; i < 4; ++i) r.v[i] = f(a.v[i], b.v[i]);
  return r;
}
Four operator+(Four const& a, Four const& b) {
  return map(a, b, std::plus<>());
}
Four operator-(Four const& a, Four const& b) {
  return map(a, b, std::minus<>());
}
Four operator*(Four const& a, Four const& b) {
  return map(a, b, std::multiplies<>());
}
Four operator/(Four const& a, Four const& b) {
  return map(a, b, std::divides<>());
}
Four operator-(Four const& a) {
  return Four(0) - a;
}
Mask operator<(Four const& a, Four const& b) {
  return test(a, b, std::less<>());
}
Mask operator>(Four const& a, Four const& b) {
  return test(a, b, std::greater<>());
}
Mask operator<=(Four const& a, Four const& b) {
  return test(a, b, std::less_equal<>());
}
Mask operator>=(Four const& a, Four const& b) {
  return test(a, b, std::greater_equal<>());
}
Mask operator==(Four const& a, Four const& b) {
  return test(a, b, std::equal_to<>());
}
Mask operator&(Mask a, Mask const& b) {
  for (std::size_t i = 0; i < 4; ++i) a.v[i] = a.v[i] && b.v[i];
  return a;
}
Mask operator|(Mask a, Mask const& b) {
  for (std::size_t i = 0; i < 4; ++i) a.v[i] = a.v[i] || b.v[i];
  return a;
}
Mask operator!(Mask a) {
  for (bool& x : a.v) x = !x;
  return a;
}
Four sqrt(Four a) {
  for (double& x : a.v) x = std::sqrt(x);
  return a;
}
Four select(Mask const& m, Four const& a, Four const& b) {
  Four r;
  for (std::size_t i = 0; i < 4; ++i) r.v[i] = m.v[i] ? a.v[i] : b.v[i];
  return r;
}

} // namespace other

namespace abbe::optics {
namespace {

TEST(Lanes, GiveTheBitsOfTheScalar) {
  using other::Four;
  RandomKey const key(11);
  for (std::uint64_t round = 0; round < 5000; ++round) {
    RandomKey const k = key.child(round);
    Four n1(1 + k.uniform(0)), n2, c(k.uniform(1));
    for (std::size_t i = 0; i < 4; ++i) n2.v[i] = i == 3 ? n1.v[0] : 1 + k.uniform(2 + i);
    auto const wide = fresnel<Four>(n1, n2, c);
    double const s = std::sqrt((1 - c.v[0]) * (1 + c.v[0]));
    auto const t =
        refracted<Four>(wide, {Four(s), Four(-c.v[0]), Four(0)}, {Four(0), Four(1), Four(0)});
    auto const metal = conductor_reflectance<Four>(n1, n2, c);
    for (std::size_t i = 0; i < 4; ++i) {
      auto const one = fresnel<double>(n1.v[i], n2.v[i], c.v[i]);
      ASSERT_EQ(wide.total.v[i], one.total);
      ASSERT_EQ(wide.reflectance.v[i], one.reflectance);
      ASSERT_EQ(wide.transmittance.v[i], one.transmittance);
      ASSERT_EQ(metal.v[i], (conductor_reflectance<double>(n1.v[i], n2.v[i], c.v[i])));
      if (one.total) continue;
      Vec3 const direction = refracted(one, Vec3(s, -c.v[i], 0), Vec3(0, 1, 0));
      ASSERT_EQ(t.x.v[i], direction.x);
      ASSERT_EQ(t.y.v[i], direction.y);
    }
  }
}

} // namespace
} // namespace abbe::optics

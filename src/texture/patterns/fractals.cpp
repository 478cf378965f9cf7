// SPDX-License-Identifier: MIT
#include "texture/patterns/fractals.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace abbe::texture {
namespace {

/// Complex numbers with the same bits everywhere.
struct Complex {
  double re = 0, im = 0;
  Complex operator+(Complex const& b) const { return {re + b.re, im + b.im}; }
  Complex operator*(Complex const& b) const {
    return {re * b.re - im * b.im, re * b.im + im * b.re};
  }
  Complex operator*(double k) const { return {re * k, im * k}; }
  Complex operator/(Complex const& b) const {
    double const square = b.square();
    return {(re * b.re + im * b.im) / square, (im * b.re - re * b.im) / square};
  }
  Complex operator+(double k) const { return {re + k, im}; }
  double square() const { return re * re + im * im; }
};

class Fractal final : public Pattern {
public:
  int steps = 1;
  int magnet = 0; ///< 0: none
  std::optional<Complex> julia;
  int exponent = 2;
  struct Shading {
    int type;
    double factor;
  };
  Shading exterior{1, 1}, interior{0, 1};

  double raw(Vec3 const& p, PatternModifiers const&) const override {
    Complex const here{p.x, p.y};
    Complex const c = julia ? *julia : here;
    Complex z = magnet != 0 && !julia ? Complex{} : here;
    double least = magnet != 0 && !julia ? std::numeric_limits<double>::infinity() : z.square();
    for (int step = 0; step < steps; ++step) {
      z = next(z, c);
      double const square = z.square();
      least = std::min(least, square);
      if (!(square <= (magnet != 0 ? 1e4 : 4)) || (magnet != 0 && (z + -1).square() < 1e-4))
        return shaded(exterior, z, static_cast<double>(step) / steps, std::sqrt(square));
    }
    // Type 6 weighs the imaginary part alone, as POV-Ray does.
    if (interior.type == 6) return z.re * z.re + z.im * z.im * interior.factor;
    return shaded(interior, z, std::sqrt(least) * interior.factor, 0);
  }
  std::span<DefaultEntry const> default_map() const override {
    static DefaultEntry const map[] = {{0.001, Vec3(0)},
                                       {0.001, Vec3(0, 1, 1)},
                                       {0.012, Vec3(1, 1, 0)},
                                       {0.015, Vec3(1, 0, 1)},
                                       {0.1, Vec3(0, 1, 1)}};
    return map;
  }
  std::shared_ptr<Pattern const> read_item(Parameters& in) const override {
    auto changed = std::make_shared<Fractal>(*this);
    if (in.accept("exterior"))
      changed->exterior = {in.integer("exterior type", 0, 6), in.number("factor")};
    else if (in.accept("interior"))
      changed->interior = {in.integer("interior type", 0, 6), in.number("factor")};
    else if (magnet == 0 && in.accept("exponent"))
      changed->exponent = in.integer("exponent", 2, 33);
    else
      return nullptr;
    return changed;
  }

private:
  Complex next(Complex const& z, Complex const& c) const {
    if (magnet == 1) {
      Complex const root = (z * z + c + -1) / (z * 2 + c + -2);
      return root * root;
    }
    Complex const c1 = c + -1, c2 = c + -2;
    if (magnet == 2) {
      Complex const root =
          (z * z * z + c1 * z * 3 + c1 * c2) / (z * z * 3 + c2 * z * 3 + c1 * c2 + 1);
      return root * root;
    }
    Complex power = z;
    for (int k = 1; k < exponent; ++k) power = power * z;
    return power + c;
  }
  static double shaded(Shading const& shading, Complex const& z, double first, double size) {
    switch (shading.type) {
    case 1:
      return first;
    case 2:
      return z.re * shading.factor;
    case 3:
      return z.im * shading.factor;
    case 4:
      return z.re * z.re * shading.factor;
    case 5:
      return z.im * z.im * shading.factor;
    case 6:
      return size * shading.factor;
    default:
      return shading.factor;
    }
  }
};

constexpr int most_steps = 1000000;

void read_steps(Parameters& in, Fractal& fractal) {
  fractal.steps = in.integer("number of steps", 1, most_steps);
}

std::shared_ptr<Fractal> julia_of(Parameters& in) {
  auto fractal = std::make_shared<Fractal>();
  Vec2 const c = in.vec2("the constant of julia");
  fractal->julia = Complex{c.x, c.y};
  read_steps(in, *fractal);
  return fractal;
}

} // namespace

std::shared_ptr<Pattern const> read_mandel(Parameters& in) {
  auto fractal = std::make_shared<Fractal>();
  read_steps(in, *fractal);
  return fractal;
}

std::shared_ptr<Pattern const> read_julia(Parameters& in) {
  return julia_of(in);
}

std::shared_ptr<Pattern const> read_magnet(Parameters& in) {
  int const type = in.integer("magnet type", 1, 2);
  std::shared_ptr<Fractal> fractal;
  if (in.accept("julia")) {
    fractal = julia_of(in);
  } else {
    if (!in.accept("mandel"))
      in.report(Severity::Error, "E0250", "expected 'mandel' or 'julia' behind the type of magnet",
                in.next_span());
    fractal = std::make_shared<Fractal>();
    read_steps(in, *fractal);
  }
  fractal->magnet = type;
  return fractal;
}

} // namespace abbe::texture

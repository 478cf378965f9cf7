// SPDX-License-Identifier: MIT
#include "geometry/shapes/julia.hpp"

#include "geometry/shapes/isosurface.hpp"
#include "geometry/shapes/reading.hpp"

#include <cmath>
#include <utility>

namespace abbe::geometry {

namespace {

using Function = JuliaRule::Function;

constexpr std::pair<std::string_view, Function> functions[] = {
    {"sqr", Function::Sqr},
    {"cube", Function::Cube},
    {"exp", Function::Exp},
    {"sin", Function::Sin},
    {"asin", Function::Asin},
    {"sinh", Function::Sinh},
    {"asinh", Function::Asinh},
    {"cos", Function::Cos},
    {"acos", Function::Acos},
    {"cosh", Function::Cosh},
    {"acosh", Function::Acosh},
    {"tan", Function::Tan},
    {"atan", Function::Atan},
    {"tanh", Function::Tanh},
    {"atanh", Function::Atanh},
    {"ln", Function::Ln},
    {"reciprocal", Function::Reciprocal}};

bool read_function(Parameters& parameters, JuliaRule& rule) {
  for (auto const& [word, function] : functions) {
    if (!parameters.accept(word)) continue;
    rule.function = function;
    return true;
  }
  auto const power = parameters.call("pwr", 2);
  if (power.empty()) return false;
  rule.function = Function::Power;
  rule.power = {power[0], power[1]};
  return true;
}

double size_of(Vec4 const& v) {
  return std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z + v.w * v.w);
}

/// @return false after an error
bool read_slice(Parameters& parameters, JuliaRule& rule) {
  Span const at = parameters.next_span();
  Vec4 const normal = parameters.vec4("normal of the slice");
  rule.slice_distance = parameters.number("distance of the slice");
  double const size = size_of(normal);
  if (usable_size(size) && usable_size(normal.w / size) && std::isfinite(rule.slice_distance)) {
    rule.slice = normal / size;
    return true;
  }
  parameters.report(Severity::Error, "E0636",
                    "the normal of a slice needs finite numbers, of which the last is not zero",
                    at);
  return false;
}

} // namespace

std::optional<PlacedShape> make_julia_fractal(JuliaRule const& rule, double precision) {
  Isosurface::Container ball;
  ball.ball = true;
  // The field is at its level all over the ball of the bailout when there is one number only.
  ball.radius = rule.reach() * (1 + 1e-6);
  ball.low = Vec3(-ball.radius);
  ball.high = Vec3(ball.radius);
  if (!usable_size(ball.radius) || !usable_size(ball.radius * ball.radius)) return std::nullopt;
  double const accuracy = 1e-3 * 20 / precision;
  return PlacedShape{
      std::make_shared<Isosurface>(std::make_shared<JuliaField>(rule), ball, 0, accuracy, false),
      {}};
}

std::optional<PlacedShape> read_julia_fractal(Parameters& parameters) {
  JuliaRule rule;
  rule.c = parameters.vec4("parameter of the fractal");
  double precision = 20;
  bool good = true;
  for (;;) {
    Span const at = parameters.next_span();
    if (parameters.accept("quaternion")) {
      rule.quaternion = true;
    } else if (parameters.accept("hypercomplex")) {
      rule.quaternion = false;
    } else if (parameters.accept("max_iteration")) {
      rule.rounds = parameters.integer("max_iteration", 1, 1000);
    } else if (parameters.accept("precision")) {
      precision = parameters.number("precision");
      if (precision > 0 && std::isfinite(precision)) continue;
      parameters.report(Severity::Error, "E0636", "precision must be above zero", at);
      good = false;
    } else if (parameters.accept("slice")) {
      good = read_slice(parameters, rule) && good;
    } else if (!read_function(parameters, rule)) {
      break;
    }
  }
  if (rule.quaternion && rule.function != Function::Sqr && rule.function != Function::Cube) {
    parameters.report(
        Severity::Error, "E0636",
        "of quaternions there are sqr and cube only: the other functions are those of "
        "'hypercomplex'");
    good = false;
  }
  if (!rule.quaternion && rule.function == Function::Cube) {
    parameters.report(
        Severity::Warning, "E0636",
        "of hypercomplex numbers 'cube' is drawn as 'sqr', as in POV-Ray: 'pwr(3, 0)' "
        "is their cube");
    rule.function = Function::Sqr;
  }
  if (!good) return std::nullopt;
  return or_report(make_julia_fractal(rule, precision), parameters, "E0636",
                   "the parameter of a julia_fractal is out of range");
}

} // namespace abbe::geometry

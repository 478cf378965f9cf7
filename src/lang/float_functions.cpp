// SPDX-License-Identifier: MIT
#include "lang/float_functions.hpp"

#include "simd/math.hpp"

#include <cmath>
#include <cstdint>

namespace abbe::lang {
namespace {

constexpr double pi = 3.14159265358979323846;

constexpr FloatFunction table[] = {
    {"abs", 1, [](double a, double) { return std::abs(a); }},
    {"acos", 1, [](double a, double) { return simd::acos(a); }},
    {"acosh", 1, [](double a, double) { return std::acosh(a); }},
    {"asin", 1, [](double a, double) { return simd::asin(a); }},
    {"asinh", 1, [](double a, double) { return std::asinh(a); }},
    {"atan", 1, [](double a, double) { return simd::atan(a); }},
    {"atan2", 2, [](double a, double b) { return simd::atan2(a, b); }},
    {"atanh", 1, [](double a, double) { return std::atanh(a); }},
    {"ceil", 1, [](double a, double) { return std::ceil(a); }},
    {"cos", 1, [](double a, double) { return simd::cos(a); }},
    {"cosh", 1, [](double a, double) { return simd::cosh(a); }},
    {"degrees", 1, [](double a, double) { return a * (180 / pi); }},
    {"exp", 1, [](double a, double) { return simd::exp(a); }},
    {"floor", 1, [](double a, double) { return std::floor(a); }},
    {"int", 1, [](double a, double) { return whole_number(a); }},
    {"ln", 1, [](double a, double) { return simd::log(a); }},
    {"log", 1, [](double a, double) { return simd::log10(a); }},
    {"mod", 2, [](double a, double b) { return std::fmod(a, b); }},
    {"pow", 2, [](double a, double b) { return simd::pow(a, b); }},
    {"radians", 1, [](double a, double) { return a * (pi / 180); }},
    {"sin", 1, [](double a, double) { return simd::sin(a); }},
    {"sinh", 1, [](double a, double) { return simd::sinh(a); }},
    {"sqr", 1, [](double a, double) { return a * a; }},
    {"sqrt", 1, [](double a, double) { return std::sqrt(a); }},
    {"tan", 1, [](double a, double) { return simd::tan(a); }},
    {"tanh", 1, [](double a, double) { return simd::tanh(a); }},
};

} // namespace

std::span<FloatFunction const> float_functions() {
  return table;
}

FloatFunction const* find_float_function(std::string_view name) {
  for (auto const& function : table)
    if (function.name == name) return &function;
  return nullptr;
}

} // namespace abbe::lang

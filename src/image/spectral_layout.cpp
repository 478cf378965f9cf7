// SPDX-License-Identifier: MIT
#include "image/spectral_layout.hpp"

#include "base/result.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <utility>

namespace abbe::image {
namespace {

/// Reads a number off the front of the text.
std::optional<double> take_number(std::string_view& text) {
  double value = 0;
  auto const [end, failed] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (failed != std::errc() || !std::isfinite(value)) return std::nullopt;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return value;
}

/// Factor to metres or hertz of an SI prefix.
std::optional<double> si_factor(std::string_view prefix) {
  static constexpr std::array<std::pair<std::string_view, double>, 17> factors{{
      {"", 1},
      {"Y", 1e24},
      {"Z", 1e21},
      {"E", 1e18},
      {"P", 1e15},
      {"T", 1e12},
      {"G", 1e9},
      {"M", 1e6},
      {"k", 1e3},
      {"h", 1e2},
      {"da", 1e1},
      {"d", 1e-1},
      {"c", 1e-2},
      {"m", 1e-3},
      {"u", 1e-6},
      {"n", 1e-9},
      {"p", 1e-12},
  }};
  for (auto const& [name, factor] : factors)
    if (name == prefix) return factor;
  return std::nullopt;
}

std::string shortest(double value) {
  std::array<char, 400> text{};
  auto const end =
      std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed).ptr;
  return {text.data(), end};
}

} // namespace

std::string spectral_channel_name(double wavelength_nm) {
  ABBE_ASSERT(wavelength_nm > 0 && std::isfinite(wavelength_nm));
  std::string number = shortest(wavelength_nm);
  std::replace(number.begin(), number.end(), '.', ',');
  return "S0." + number + "nm";
}

std::optional<double> parse_spectral_channel(std::string_view name) {
  if (!name.starts_with("S0.")) return std::nullopt;
  std::string number(name.substr(3));
  if (number.empty() || number[0] == '-' || number.find('.') != std::string::npos)
    return std::nullopt;
  std::replace(number.begin(), number.end(), ',', '.');
  std::string_view rest = number;
  auto const value = take_number(rest);
  if (!value || !(*value > 0)) return std::nullopt;
  if (rest == "nm") return *value; // without the rounding of two factors
  bool const frequency = rest.ends_with("Hz");
  if (!frequency && !rest.ends_with("m")) return std::nullopt;
  rest.remove_suffix(frequency ? 2 : 1);
  auto const factor = si_factor(rest);
  if (!factor) return std::nullopt;
  constexpr double light_speed_nm_per_s = 299792458e9;
  return frequency ? light_speed_nm_per_s / (*value * *factor) : *value * *factor * 1e9;
}

std::string join_numbers(std::vector<double> const& values) {
  std::string text;
  for (double const value : values) {
    if (!text.empty()) text += ' ';
    text += shortest(value);
  }
  return text;
}

std::optional<std::vector<double>> split_numbers(std::string_view text) {
  std::vector<double> values;
  while (!text.empty()) {
    if (!values.empty()) {
      if (text[0] != ' ') return std::nullopt;
      text.remove_prefix(1);
    }
    auto const value = take_number(text);
    if (!value) return std::nullopt;
    values.push_back(*value);
  }
  return values;
}

} // namespace abbe::image

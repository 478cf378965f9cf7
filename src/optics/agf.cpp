// SPDX-License-Identifier: MIT
#include "optics/agf.hpp"

#include "optics/glass_builder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

namespace abbe::optics {
namespace {

using Numbers = std::vector<double>;

std::vector<std::string_view> split(std::string_view line) {
  std::vector<std::string_view> words;
  for (std::size_t at = 0; at < line.size();) {
    std::size_t const begin = line.find_first_not_of(" \t\r", at);
    if (begin == line.npos) break;
    std::size_t const end = std::min(line.find_first_of(" \t\r", begin), line.size());
    words.push_back(line.substr(begin, end - begin));
    at = end;
  }
  return words;
}

bool parse(std::string_view word, double& value) {
  if (!word.empty() && word.front() == '+') word.remove_prefix(1);
  auto const [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  return error == std::errc() && end == word.data() + word.size() && std::isfinite(value);
}

/// n^2 (or n) = first + sum pairs, as formulas 3 and 5 want them.
Numbers polynomial(Numbers const& c, std::initializer_list<double> exponents) {
  Numbers result{c[0]};
  std::size_t i = 1;
  for (double const exponent : exponents) {
    result.push_back(c[i++]);
    result.push_back(exponent);
  }
  return result;
}

/// K1 L1 K2 L2 ..: formula 2 with c1 = 0.
Numbers sellmeier(Numbers const& c, std::size_t terms) {
  Numbers result{0};
  result.insert(result.end(), c.begin(), c.begin() + static_cast<std::ptrdiff_t>(2 * terms));
  return result;
}

/// Gives the formula of ours that computes formula `id` of the format; false when there is none.
bool apply_formula(GlassBuilder& glass, int id, Numbers const& c) {
  switch (id) {
  case 1:
    glass.formula(3, polynomial(c, {2, -2, -4, -6, -8}));
    return true;
  case 2:
    glass.formula(2, sellmeier(c, 3));
    return true;
  case 3:
    glass.formula(7, {c[0], c[1], c[2], c[3], c[4], c[5]});
    return true;
  // n^2 = 1 + A + B1 w^2/(w^2 - l1^2) + B2/(w^2 - l2^2)
  case 4:
    glass.formula(4, {1 + c[0], c[1], 2, c[2], 2, c[3], 0, c[4], 2});
    return true;
  case 5:
    glass.formula(5, polynomial(c, {-1, -3.5}));
    return true;
  case 6:
    glass.formula(2, sellmeier(c, 4));
    return true;
  // n^2 = A + B/(w^2 - C) - D w^2, and with B w^2
  case 7:
    glass.formula(4, {c[0], c[1], 0, c[2], 1, 0, 0, 0, 1, -c[3], 2});
    return true;
  case 8:
    glass.formula(4, {c[0], c[1], 2, c[2], 1, 0, 0, 0, 1, -c[3], 2});
    return true;
  case 9:
    glass.formula(4, {c[0], c[1], 2, c[2], 1, c[3], 2, c[4], 1});
    return true;
  case 10:
    glass.formula(3, polynomial(c, {2, -2, -4, -6, -8, -10, -12}));
    return true;
  case 11:
    glass.formula(2, sellmeier(c, 5));
    return true;
  case 12:
    glass.formula(3, polynomial(c, {2, -2, -4, -6, -8, 4, 6}));
    return true;
  case 13:
    glass.formula(3, polynomial(c, {2, 4, -2, -4, -6, -8, -10, -12}));
    return true;
  default:
    return false;
  }
}

std::string_view status_name(int code) {
  constexpr std::string_view names[] = {"standard", "preferred", "obsolete", "special", "melt"};
  return code >= 0 && code < 5 ? names[code] : std::string_view{};
}

/// UTF-16 to bytes; anything beyond Latin-1 stands in comments only and becomes '?'.
std::string to_bytes(std::string_view text) {
  if (text.starts_with("\xEF\xBB\xBF")) return std::string(text.substr(3));
  bool const little = text.starts_with("\xFF\xFE");
  if (!little && !text.starts_with("\xFE\xFF")) return std::string(text);
  std::string result;
  for (std::size_t i = 2; i + 1 < text.size(); i += 2) {
    char const low = little ? text[i] : text[i + 1];
    char const high = little ? text[i + 1] : text[i];
    result += high == 0 ? low : '?';
  }
  return result;
}

class Reader {
public:
  explicit Reader(std::string_view maker) : maker_(maker) {}

  std::optional<Error> line(std::string_view text) {
    ++number_;
    auto const words = split(text);
    if (words.empty()) return std::nullopt;
    if (words[0] == "NM") return start(words);
    bool const used = words[0] == "CD" || words[0] == "LD" || words[0] == "IT";
    if (!used) return std::nullopt;
    if (!open_) return fail(fmt::format("{} stands before the first NM", words[0]));
    if (words[0] == "CD") return coefficients(words);
    if (words[0] == "LD") return range(words);
    return transmittance(words);
  }

  std::optional<Error> finish() {
    if (!open_) return std::nullopt;
    open_ = false;
    auto const at_glass = [&](std::string_view what) {
      return Error{"E0414", fmt::format("line {}: {}", glass_line_, what)};
    };
    if (coefficients_.empty()) return at_glass(fmt::format("glass '{}' has no CD line", name_));
    GlassBuilder glass(name_);
    glass.maker(std::string(maker_)).printed(nd_, vd_).status(std::string(status_));
    coefficients_.resize(std::max(coefficients_.size(), std::size_t{10}), 0.0);
    if (!apply_formula(glass, formula_, coefficients_))
      return at_glass(
          fmt::format("glass '{}' uses formula {}; known are 1 to 13", name_, formula_));
    if (range_) glass.range_um((*range_)[0], (*range_)[1]);
    if (!per_mm_.empty()) {
      std::sort(per_mm_.begin(), per_mm_.end());
      glass.transmittance(1, std::move(per_mm_));
    }
    auto built = glass.build();
    if (!built) return at_glass(built.error().message);
    glasses_.push_back(std::move(*built));
    return std::nullopt;
  }

  std::vector<GlassPtr> take() { return std::move(glasses_); }

private:
  Error fail(std::string_view what) const {
    return Error{"E0414", fmt::format("line {}: {}", number_, what)};
  }

  std::optional<Error> start(std::vector<std::string_view> const& words) {
    if (auto error = finish()) return error;
    double formula = 0;
    if (words.size() < 3 || !parse(words[2], formula) || std::abs(formula) > 1000)
      return fail("NM needs a name and the number of a formula");
    double const nan = std::numeric_limits<double>::quiet_NaN();
    name_ = words[1];
    formula_ = static_cast<int>(formula);
    nd_ = vd_ = nan;
    double value = 0;
    if (words.size() > 4 && parse(words[4], value)) nd_ = value;
    if (words.size() > 5 && parse(words[5], value)) vd_ = value;
    status_ = {};
    if (words.size() > 7 && parse(words[7], value) && value >= 0 && value < 5)
      status_ = status_name(static_cast<int>(value));
    coefficients_.clear();
    per_mm_.clear();
    range_.reset();
    glass_line_ = number_;
    open_ = true;
    return std::nullopt;
  }

  std::optional<Error> coefficients(std::vector<std::string_view> const& words) {
    constexpr std::size_t most = 64;
    coefficients_.clear();
    for (std::size_t i = 1; i < words.size() && i <= most; ++i) {
      double value = 0;
      if (!parse(words[i], value))
        return fail(fmt::format("'{}' is no number", words[i].substr(0, 40)));
      coefficients_.push_back(value);
    }
    return std::nullopt;
  }

  std::optional<Error> range(std::vector<std::string_view> const& words) {
    std::array<double, 2> range{};
    if (words.size() < 3 || !parse(words[1], range[0]) || !parse(words[2], range[1]))
      return fail("LD needs the lowest and the highest wavelength in um");
    range_ = range;
    return std::nullopt;
  }

  std::optional<Error> transmittance(std::vector<std::string_view> const& words) {
    if (words.size() < 4 || words[2] == "-" || words[3] == "-") return std::nullopt;
    double um = 0, tau = 0, mm = 0;
    if (!parse(words[1], um) || !parse(words[2], tau) || !parse(words[3], mm) || !(um > 0)
        || !(mm > 0))
      return fail("IT needs a wavelength in um, a transmittance and a thickness in mm");
    // Catalogues hold 1.0003 now and then: measured, and meaning 1.
    constexpr double measuring_error = 0.005;
    if (!(tau >= 0 && tau <= 1 + measuring_error))
      return fail(fmt::format("an internal transmittance must lie in 0..1, not {}", tau));
    constexpr double printed_zero = 0.0005; // as GlassBuilder::transmittance reads a printed 0
    tau = std::clamp(tau, printed_zero, 1.0);
    for (Pair const& row : per_mm_)
      if (row[0] == um) return std::nullopt; // a second thickness adds nothing
    // Through the logarithm: GlassBuilder takes one thickness for the whole table.
    per_mm_.push_back({um, std::pow(tau, 1 / mm)});
    return std::nullopt;
  }

  std::string_view maker_;
  std::vector<GlassPtr> glasses_;
  int number_ = 0;
  bool open_ = false;
  int glass_line_ = 0;
  std::string name_;
  std::string_view status_;
  int formula_ = 0;
  double nd_ = 0, vd_ = 0;
  Numbers coefficients_;
  std::optional<std::array<double, 2>> range_;
  std::vector<Pair> per_mm_;
};

} // namespace

Result<std::vector<GlassPtr>> read_agf(std::string_view text, std::string_view maker) {
  std::string const bytes = to_bytes(text);
  Reader reader(maker);
  for (std::size_t at = 0; at < bytes.size();) {
    std::size_t const end = std::min(bytes.find('\n', at), bytes.size());
    if (auto error = reader.line(std::string_view(bytes).substr(at, end - at))) return *error;
    at = end + 1;
  }
  if (auto error = reader.finish()) return *error;
  return reader.take();
}

} // namespace abbe::optics

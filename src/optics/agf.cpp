// SPDX-License-Identifier: MIT
#include "optics/agf.hpp"

#include "optics/glass_builder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <set>

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

/// A number as a program of any country prints it: "+1.5", "1,5", "1.5D-02".
bool parse(std::string_view word, double& value) {
  std::string text(word.substr(0, 64));
  for (char& c : text)
    if (c == 'D' || c == 'd') c = 'e';
  if (text.find('.') == text.npos)
    if (auto const comma = text.find(','); comma != text.npos) text[comma] = '.';
  char const* const begin = text.c_str() + (text.starts_with('+') ? 1 : 0);
  char const* const last = text.c_str() + text.size();
  auto const [end, error] = std::from_chars(begin, last, value);
  return error == std::errc() && end == last && word.size() <= 64 && std::isfinite(value);
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

/// Gives the formula of ours that computes formula `id` of the format.
void apply_formula(GlassBuilder& glass, int id, Numbers const& c) {
  switch (id) {
  case 1:
    glass.formula(3, polynomial(c, {2, -2, -4, -6, -8}));
    return;
  case 2:
    glass.formula(2, sellmeier(c, 3));
    return;
  case 3:
    glass.formula(7, {c[0], c[1], c[2], c[3], c[4], c[5]});
    return;
  // n^2 = 1 + A + B1 w^2/(w^2 - l1^2) + B2/(w^2 - l2^2)
  case 4:
    glass.formula(4, {1 + c[0], c[1], 2, c[2], 2, c[3], 0, c[4], 2});
    return;
  case 5:
    glass.formula(5, polynomial(c, {-1, -3.5}));
    return;
  case 6:
    glass.formula(2, sellmeier(c, 4));
    return;
  // n^2 = A + B/(w^2 - C) - D w^2, and with B w^2
  case 7:
    glass.formula(4, {c[0], c[1], 0, c[2], 1, 0, 0, 0, 1, -c[3], 2});
    return;
  case 8:
    glass.formula(4, {c[0], c[1], 2, c[2], 1, 0, 0, 0, 1, -c[3], 2});
    return;
  case 9:
    glass.formula(4, {c[0], c[1], 2, c[2], 1, c[3], 2, c[4], 1});
    return;
  case 10:
    glass.formula(3, polynomial(c, {2, -2, -4, -6, -8, -10, -12}));
    return;
  case 11:
    glass.formula(2, sellmeier(c, 5));
    return;
  case 12:
    glass.formula(3, polynomial(c, {2, -2, -4, -6, -8, 4, 6}));
    return;
  case 13:
    glass.formula(3, polynomial(c, {2, 4, -2, -4, -6, -8, -10, -12}));
    return;
  default:
    ABBE_ASSERT(false);
  }
}

/// How many coefficients formula `id` of the format has.
std::size_t coefficients_of(int id) {
  constexpr std::size_t counts[] = {6, 6, 6, 5, 3, 8, 4, 4, 5, 8, 10, 8, 9};
  return id >= 1 && id <= 13 ? counts[id - 1] : 0;
}

std::string_view status_name(int code) {
  constexpr std::string_view names[] = {"standard", "preferred", "obsolete", "special", "melt"};
  return code >= 0 && code < 5 ? names[code] : std::string_view{};
}

/// The text without what would disturb a terminal in messages about names: control characters other
/// than those that part words and lines are '?'.
std::string printable(std::string text) {
  for (char& c : text)
    if ((c >= 0 && c < ' ' && c != '\t' && c != '\r' && c != '\n') || c == 127) c = '?';
  return text;
}

/// UTF-16 to bytes; anything beyond Latin-1 stands in comments only and becomes '?'. A text without
/// byte order mark is UTF-16 when it begins with one letter and a zero byte.
std::string to_bytes(std::string_view text) {
  if (text.starts_with("\xEF\xBB\xBF")) return std::string(text.substr(3));
  bool const marked = text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF");
  bool const zero_first = text.size() > 1 && text[0] == '\0' && text[1] != '\0';
  bool const zero_second = text.size() > 1 && text[0] != '\0' && text[1] == '\0';
  if (!marked && !zero_first && !zero_second) return std::string(text);
  bool const little = marked ? text[0] == '\xFF' : zero_second;
  std::string result;
  for (std::size_t i = marked ? 2 : 0; i + 1 < text.size(); i += 2) {
    char const low = little ? text[i] : text[i + 1];
    char const high = little ? text[i + 1] : text[i];
    result += high == 0 ? low : '?';
  }
  return result;
}

class Reader {
public:
  explicit Reader(std::string_view maker) : maker_(maker) {}

  void line(std::string_view text) {
    ++number_;
    auto const words = split(text);
    if (words.empty()) return;
    if (words[0] == "NM") return start(words);
    bool const used = words[0] == "CD" || words[0] == "LD" || words[0] == "IT";
    if (!used) return;
    if (glass_line_ == 0) return problem(fmt::format("{} stands before the first NM", words[0]));
    if (!open_) return; // of a glass that is lost
    if (words[0] == "CD") return coefficients(words);
    if (words[0] == "LD") return range(words);
    transmittance(words);
  }

  AgfCatalogue finish() {
    finish_glass();
    std::stable_sort(result_.problems.begin(), result_.problems.end(),
                     [](auto const& a, auto const& b) { return a.line < b.line; });
    return std::move(result_);
  }

private:
  void problem(std::string message) {
    result_.problems.push_back({number_, name_, std::move(message), false});
  }
  /// The glass cannot be made, for a reason on this line.
  void lose(std::string message, int line) {
    if (open_) result_.problems.push_back({line, name_, std::move(message), true});
    open_ = false;
  }

  void finish_glass() {
    if (!open_) return;
    if (coefficients_.empty()) return lose("it has no CD line", glass_line_);
    GlassBuilder glass(name_);
    glass.maker(std::string(maker_)).printed(nd_, vd_).status(std::string(status_));
    coefficients_.resize(std::max(coefficients_.size(), std::size_t{10}), 0.0);
    apply_formula(glass, formula_, coefficients_);
    if (range_) glass.range_um((*range_)[0], (*range_)[1]);
    if (!rows_.empty()) glass.transmittance(sorted_rows());
    auto built = glass.build();
    if (!built) return lose(built.error().message, glass_line_);
    for (auto& doubt : glass.doubts(**built))
      result_.problems.push_back({glass_line_, name_, std::move(doubt), false});
    if (!names_.insert(name_).second)
      result_.problems.push_back(
          {glass_line_, name_, "a glass of this name stands before; this one counts", false});
    result_.glasses.push_back(std::move(*built));
    open_ = false;
  }

  void start(std::vector<std::string_view> const& words) {
    finish_glass();
    // A name may have blanks: it goes up to the first number, which is the formula's.
    double formula = 0;
    std::size_t at = 2;
    while (at < words.size() && !parse(words[at], formula)) ++at;
    double const nan = std::numeric_limits<double>::quiet_NaN();
    name_ = words.size() > 1 ? words[1] : std::string_view();
    for (std::size_t i = 2; i < at && at < words.size(); ++i) name_ += fmt::format(" {}", words[i]);
    coefficients_.clear();
    rows_.clear();
    range_.reset();
    glass_line_ = number_;
    open_ = true;
    if (at >= words.size()) return lose("NM needs a name and the number of a formula", number_);
    formula_ = formula > 0 && formula < 100 ? static_cast<int>(formula) : 0;
    if (coefficients_of(formula_) == 0 || formula_ != formula)
      return lose(fmt::format("it uses formula {}; known are 1 to 13", words[at]), number_);
    nd_ = vd_ = nan;
    double value = 0;
    if (words.size() > at + 2 && parse(words[at + 2], value)) nd_ = value;
    if (words.size() > at + 3 && parse(words[at + 3], value)) vd_ = value;
    status_ = {};
    if (words.size() > at + 5 && parse(words[at + 5], value) && value >= 0 && value < 5)
      status_ = status_name(static_cast<int>(value));
  }

  void coefficients(std::vector<std::string_view> const& words) {
    coefficients_.clear();
    // What stands behind the formula's own does not count, whatever it is.
    std::size_t const count = std::min(words.size() - 1, coefficients_of(formula_));
    for (std::size_t i = 1; i <= count; ++i) {
      double value = 0;
      if (!parse(words[i], value))
        return lose(fmt::format("'{}' is no number", words[i].substr(0, 40)), number_);
      coefficients_.push_back(value);
    }
    bool const all_zero =
        std::all_of(coefficients_.begin(), coefficients_.end(), [](double c) { return c == 0; });
    if (all_zero) lose("its CD line has no coefficients", number_);
  }

  void range(std::vector<std::string_view> const& words) {
    std::array<double, 2> range{};
    if (words.size() < 3 || !parse(words[1], range[0]) || !parse(words[2], range[1]))
      return problem("LD needs the lowest and the highest wavelength in um");
    if (!(range[0] > 0 && range[0] <= range[1]))
      return problem(fmt::format("{}..{} um is no range of wavelengths", words[1], words[2]));
    if (range[0] >= 100)
      return problem(fmt::format("{}..{} um is no light: is it in nm?", words[1], words[2]));
    range_ = range;
  }

  void transmittance(std::vector<std::string_view> const& words) {
    if (words.size() < 3 || words[2] == "-" || (words.size() > 3 && words[3] == "-")) return;
    double um = 0, tau = 0, mm = 0;
    if (words.size() < 4 || !parse(words[1], um) || !parse(words[2], tau) || !parse(words[3], mm))
      return problem("IT needs a wavelength in um, a transmittance and a thickness in mm");
    if (tau == 0 && mm == 0) return;
    if (!(um > 0 && mm > 0))
      return problem(fmt::format("{} must be positive, not {}",
                                 um > 0 ? "a thickness" : "a wavelength", um > 0 ? mm : um));
    // Catalogues hold 1.0003 now and then: measured, and meaning 1.
    constexpr double measuring_error = 0.005;
    if (!(tau >= 0 && tau <= 1 + measuring_error))
      return problem(fmt::format("an internal transmittance must lie in 0..1, not {}", tau));
    tau = std::min(tau, 1.0);
    rows_.push_back({um, tau, mm});
  }

  /// By wavelength, each once: the first, or the first that is not 0, of a thinner sample.
  std::vector<GlassBuilder::Transmittance> sorted_rows() {
    std::stable_sort(rows_.begin(), rows_.end(),
                     [](auto const& a, auto const& b) { return a.um < b.um; });
    std::vector<GlassBuilder::Transmittance> result;
    for (auto const& row : rows_) {
      if (result.empty() || result.back().um != row.um)
        result.push_back(row);
      else if (result.back().tau == 0)
        result.back() = row;
    }
    return result;
  }

  std::string_view maker_;
  AgfCatalogue result_;
  std::set<std::string> names_;
  int number_ = 0;
  bool open_ = false;  ///< a glass is being read
  int glass_line_ = 0; ///< of the last NM; 0 before the first
  std::string name_;
  std::string_view status_;
  int formula_ = 0;
  double nd_ = 0, vd_ = 0;
  Numbers coefficients_;
  std::optional<std::array<double, 2>> range_;
  std::vector<GlassBuilder::Transmittance> rows_;
};

} // namespace

AgfCatalogue read_agf(std::string_view text, std::string_view maker) {
  std::string const bytes = printable(to_bytes(text));
  Reader reader(maker);
  for (std::size_t at = 0; at < bytes.size();) {
    std::size_t const end = std::min(bytes.find_first_of("\r\n", at), bytes.size());
    reader.line(std::string_view(bytes).substr(at, end - at));
    at = end + (bytes.compare(end, 2, "\r\n") == 0 ? 2 : 1);
  }
  return reader.finish();
}

} // namespace abbe::optics

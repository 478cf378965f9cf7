// SPDX-License-Identifier: MIT
#include "optics/scan_pairs.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

namespace abbe::optics {
namespace {

bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == ',';
}

class Scanner {
public:
  explicit Scanner(std::string_view text) : text_(text) {}

  void skip_blanks() {
    while (at_ < text_.size() && is_blank(text_[at_])) ++at_;
  }
  bool accept(char c) {
    skip_blanks();
    if (at_ >= text_.size() || text_[at_] != c) return false;
    ++at_;
    return true;
  }
  bool at_end() {
    skip_blanks();
    return at_ >= text_.size();
  }
  bool number(double& value) {
    skip_blanks();
    if (at_ < text_.size() && text_[at_] == '+') ++at_;
    auto const [end, error] =
        std::from_chars(text_.data() + at_, text_.data() + text_.size(), value);
    if (error != std::errc() || !std::isfinite(value)) return false;
    at_ = static_cast<std::size_t>(end - text_.data());
    return true;
  }
  /// To just behind the first '{' outside quotes.
  bool enter() {
    bool quoted = false;
    for (; at_ < text_.size(); ++at_) {
      if (text_[at_] == '"') quoted = !quoted;
      if (text_[at_] == '{' && !quoted) {
        ++at_;
        return true;
      }
    }
    return false;
  }
  std::size_t at() const { return at_; }

private:
  std::string_view text_;
  std::size_t at_ = 0;
};

Error expected(std::string_view what, std::size_t at) {
  return Error{"E0417", fmt::format("expected {} at byte {} of the data", what, at)};
}

} // namespace

template <std::size_t N>
Result<std::vector<std::array<double, N>>> scan_rows(std::string_view text) {
  Scanner scanner(text);
  std::vector<std::array<double, N>> rows;
  scanner.skip_blanks();
  bool const bare = scanner.at() < text.size() && text[scanner.at()] == '[';
  if (!bare && !scanner.enter()) return expected("'{'", scanner.at());
  for (;;) {
    if (!bare && scanner.accept('}')) break;
    if (bare && scanner.at_end()) break;
    if (!scanner.accept('[')) return expected("'['", scanner.at());
    std::array<double, N> row{};
    for (double& value : row)
      if (!scanner.number(value)) return expected("a number", scanner.at());
    if (!scanner.accept(']')) return expected("']'", scanner.at());
    rows.push_back(row);
  }
  return rows;
}

template Result<std::vector<std::array<double, 2>>> scan_rows<2>(std::string_view text);
template Result<std::vector<std::array<double, 3>>> scan_rows<3>(std::string_view text);

} // namespace abbe::optics

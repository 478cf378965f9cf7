// SPDX-License-Identifier: MIT
#include "study/settings.hpp"

#include "base/diagnostic.hpp"
#include "scene/scene.hpp"

#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <optional>

namespace abbe::study {
namespace {

/// Of the renderer's grid.
constexpr int deepest = 64;

std::vector<std::string> split(std::string_view text) {
  std::vector<std::string> words;
  std::string word;
  bool quoted = false, any = false;
  for (char const c : text) {
    if (c == '\'') {
      quoted = !quoted;
      any = true;
    } else if (c == ' ' && !quoted) {
      if (any) words.push_back(std::exchange(word, {}));
      any = false;
    } else {
      word += c;
      any = true;
    }
  }
  if (any) words.push_back(word);
  return words;
}

std::optional<double> number(std::string_view text) {
  double value = 0;
  auto const [end, failed] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (failed != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

bool by_samples(std::string const& text) {
  return text.starts_with('s');
}

/// The numbers of "sN", "sA..B" and "sA..B/E".
struct Range {
  int least, most;
};
std::optional<Range> parse_range(std::string_view text) {
  auto const slash = text.find('/');
  auto const numbers = text.substr(1, slash == std::string_view::npos ? slash : slash - 1);
  auto const dots = numbers.find("..");
  auto const least = number(numbers.substr(0, dots));
  auto const most = dots == std::string_view::npos ? least : number(numbers.substr(dots + 2));
  auto const whole = [](std::optional<double> const& value) {
    return value && *value >= 1 && *value <= scene::SampleSettings::most_of_all
           && *value == std::floor(*value);
  };
  if (!whole(least) || !whole(most) || *most < *least) return std::nullopt;
  if (slash != std::string_view::npos) {
    auto const error = number(text.substr(slash + 1));
    if (dots == std::string_view::npos || !error || !(*error >= 0 && *error <= 1))
      return std::nullopt;
  }
  return Range{static_cast<int>(*least), static_cast<int>(*most)};
}

} // namespace

std::vector<std::string> fill_words(std::string_view words, std::string_view value) {
  auto filled = split(words);
  for (auto& word : filled)
    if (auto const at = word.find("{}"); at != std::string::npos) word.replace(at, 2, value);
  return filled;
}

std::vector<std::string> Sampling::words() const {
  if (text == "off") return {"--aa", "off"};
  auto const slash = text.find('/');
  if (by_samples(text)) {
    std::vector<std::string> out{"--samples", text.substr(1, slash - 1)};
    if (slash != std::string::npos) {
      out.emplace_back("--samples-error");
      out.push_back(text.substr(slash + 1));
    }
    return out;
  }
  if (slash == std::string::npos) return {"--aa", text};
  return {"--aa", text.substr(0, slash), "--aa-threshold", text.substr(slash + 1)};
}

int Sampling::samples() const {
  if (text == "off") return 1;
  if (by_samples(text)) return parse_range(text)->most;
  auto const depth = static_cast<int>(*number(std::string_view(text).substr(0, text.find('/'))));
  return depth * depth + 1;
}

Sampling Sampling::everywhere() const {
  if (by_samples(text)) return {fmt::format("s{}", samples())};
  return {text == "off" ? text : text.substr(0, text.find('/')) + "/0"};
}

Result<Sampling> parse_sampling(std::string const& text) {
  if (text == "off" || (by_samples(text) && parse_range(text))) return Sampling{text};
  auto const slash = text.find('/');
  auto const depth = number(std::string_view(text).substr(0, slash));
  auto const threshold =
      slash == std::string::npos ? 0.3 : number(std::string_view(text).substr(slash + 1));
  if (depth && *depth >= 1 && *depth <= deepest && *depth == static_cast<int>(*depth) && threshold
      && *threshold >= 0 && *threshold <= 3)
    return Sampling{text};
  return Error{
      "E0530",
      fmt::format("anti-aliasing '{}': expected off, a depth from 1 to {}, "
                  "DEPTH/THRESHOLD with a threshold from 0 to 3, sN samples of a pixel, or "
                  "sA..B[/ERROR]",
                  text, deepest)};
}

Result<std::vector<Setting>> make_settings(Selection const& selection) {
  std::vector<Family const*> chosen;
  for (auto const& family : families())
    if (selection.modes.empty()) chosen.push_back(&family);
  for (auto const& name : selection.modes) {
    if (auto const* family = find_family(name)) {
      chosen.push_back(family);
      continue;
    }
    std::vector<std::string_view> names;
    for (auto const& family : families()) names.push_back(family.name);
    return Error{"E0530", fmt::format("no mode '{}'{}; there are: {}", name,
                                      did_you_mean(name, names), fmt::join(names, ", "))};
  }
  std::vector<Setting> settings;
  for (auto const& aa : selection.aa) {
    auto const sampling = parse_sampling(aa);
    if (!sampling) return sampling.error();
    for (auto const* family : chosen) {
      auto values = split(family->values);
      if (values.empty())
        for (int const bands : selection.bands) values.push_back(std::to_string(bands));
      for (auto const& value : values) {
        Setting setting{family, number(value).value_or(0), "", aa,
                        fill_words(family->words, value)};
        setting.name = fmt::format("{} {}{}", family->name, value,
                                   aa == "off" ? "" : fmt::format(", aa {}", aa));
        for (auto& word : sampling->words()) setting.words.push_back(std::move(word));
        settings.push_back(std::move(setting));
      }
    }
  }
  return settings;
}

} // namespace abbe::study

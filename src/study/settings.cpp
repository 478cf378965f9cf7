// SPDX-License-Identifier: MIT
#include "study/settings.hpp"

#include "base/diagnostic.hpp"

#include <charconv>
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
  if (slash == std::string::npos) return {"--aa", text};
  return {"--aa", text.substr(0, slash), "--aa-threshold", text.substr(slash + 1)};
}

int Sampling::samples() const {
  if (text == "off") return 1;
  auto const depth = static_cast<int>(*number(std::string_view(text).substr(0, text.find('/'))));
  return depth * depth + 1;
}

Sampling Sampling::everywhere() const {
  return {text == "off" ? text : text.substr(0, text.find('/')) + "/0"};
}

Result<Sampling> parse_sampling(std::string const& text) {
  if (text == "off") return Sampling{text};
  auto const slash = text.find('/');
  auto const depth = number(std::string_view(text).substr(0, slash));
  auto const threshold =
      slash == std::string::npos ? 0.3 : number(std::string_view(text).substr(slash + 1));
  if (depth && *depth >= 1 && *depth <= deepest && *depth == static_cast<int>(*depth) && threshold
      && *threshold >= 0 && *threshold <= 3)
    return Sampling{text};
  return Error{"E0530", fmt::format("anti-aliasing '{}': expected off, a depth from 1 to {}, or "
                                    "DEPTH/THRESHOLD with a threshold from 0 to 3",
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

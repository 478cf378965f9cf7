// SPDX-License-Identifier: MIT
#include "cli/povray/options.hpp"

#include "base/diagnostic.hpp"
#include "base/file_text.hpp"

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <fmt/format.h>
#include <utility>

namespace abbe::cli {
namespace fs = std::filesystem;
namespace {

constexpr std::string_view blanks = " \t\r\n";

std::string trimmed(std::string const& text) {
  auto const first = text.find_first_not_of(blanks);
  if (first == std::string::npos) return "";
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

std::string unquoted(std::string const& text) {
  if (text.size() >= 2 && (text.front() == '"' || text.front() == '\'')
      && text.back() == text.front())
    return text.substr(1, text.size() - 2);
  return text;
}

/// Without what stands behind a ; or # outside quotes.
std::string without_comment(std::string const& line) {
  char quote = '\0';
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (quote != '\0') {
      if (line[i] == quote) quote = '\0';
    } else if (line[i] == '"' || line[i] == '\'') {
      quote = line[i];
    } else if (line[i] == ';' || line[i] == '#') {
      return line.substr(0, i);
    }
  }
  return line;
}

/// Words between blanks; quotes hold words together, and are taken away.
std::vector<std::string> words_of(std::string const& line) {
  std::vector<std::string> words;
  std::string word;
  char quote = '\0';
  bool begun = false;
  for (char const c : line + ' ') {
    if (quote != '\0') {
      if (c == quote)
        quote = '\0';
      else
        word += c;
    } else if (c == '"' || c == '\'') {
      quote = c;
      begun = true;
    } else if (blanks.find(c) != std::string_view::npos) {
      if (begun || !word.empty()) words.push_back(std::exchange(word, ""));
      begun = false;
    } else {
      word += c;
    }
  }
  return words;
}

/// %NAME% becomes the environment's value, where there is one.
std::string with_environment(std::string text) {
  for (std::size_t from = 0;;) {
    auto const begin = text.find('%', from);
    auto const end = begin == std::string::npos ? begin : text.find('%', begin + 1);
    if (end == std::string::npos) return text;
    std::string const name = text.substr(begin + 1, end - begin - 1);
    if (char const* const value = name.empty() ? nullptr : std::getenv(name.c_str())) {
      text.replace(begin, end - begin + 1, value);
      from = begin + std::string_view(value).size();
    } else {
      from = end;
    }
  }
}

/// "name=value": the name alone, if the word has that form.
std::optional<std::string> name_before_equals(std::string const& line) {
  auto const equals = line.find('=');
  if (equals == std::string::npos) return std::nullopt;
  std::string name = trimmed(line.substr(0, equals));
  auto const letter = [](unsigned char c) { return std::isalnum(c) || c == '_'; };
  if (name.empty() || !std::all_of(name.begin(), name.end(), letter)) return std::nullopt;
  return name;
}

} // namespace

std::string PovrayOptions::set(std::string_view name, std::string const& text) {
  if (auto const* const key = find_povray_key(name)) {
    auto const wrong = key->set(settings, text);
    return wrong.empty() ? "" : fmt::format("{}: {}", key->name, wrong);
  }
  std::vector<std::string_view> names;
  for (auto const& key : povray_keys()) names.push_back(key.name);
  return fmt::format("unknown option '{}'{}", name, did_you_mean(name, names));
}

std::string PovrayOptions::read_switch(std::string const& word) {
  std::string_view const letters = std::string_view(word).substr(1);
  PovraySwitch const* found = nullptr;
  for (auto const& each : povray_switches())
    if (same_word(letters.substr(0, each.letters.size()), each.letters)
        && (!found || each.letters.size() > found->letters.size()))
      found = &each;
  if (!found) return fmt::format("unknown switch '{}'", word);
  bool const on = word[0] == '+';
  std::string const value = unquoted(std::string(letters.substr(found->letters.size())));
  if (value.empty() && found->on_off.empty())
    return fmt::format("'{}' needs a value behind it, without a blank: {}", word, found->value);
  if (!value.empty() && found->value.empty())
    return fmt::format("unknown switch '{}': {} takes no value", word, found->on_off);
  std::string wrong;
  if (!found->on_off.empty()) wrong = set(found->on_off, on ? "on" : "off");
  if (wrong.empty() && !value.empty() && (on || found->on_off.empty()))
    wrong = set(found->value, value);
  return wrong.empty() ? "" : fmt::format("'{}': {}", word, wrong);
}

std::string PovrayOptions::read_file_word(std::string const& word) {
  std::string name = word, section;
  if (auto const bracket = word.find('['); bracket != std::string::npos && word.back() == ']') {
    name = word.substr(0, bracket);
    section = word.substr(bracket + 1, word.size() - bracket - 2);
  }
  std::string const extension = fs::path(name).extension().string();
  bool const is_ini = same_word(extension, ".ini") || !section.empty() || extension.empty();
  if (!is_ini) {
    settings.input = name;
    return "";
  }
  std::error_code none;
  if (extension.empty() && !fs::exists(name, none) && fs::exists(name + ".ini", none))
    name += ".ini";
  return read_ini(name, section);
}

std::string PovrayOptions::read_word(std::string const& word) {
  if (word.empty()) return "";
  if ((word[0] == '+' || word[0] == '-') && word.size() > 1) return read_switch(word);
  if (auto const name = name_before_equals(word))
    return set(*name, unquoted(trimmed(word.substr(word.find('=') + 1))));
  return read_file_word(word);
}

std::string PovrayOptions::read_line(std::string line) {
  line = trimmed(with_environment(without_comment(line)));
  if (line.empty()) return "";
  if (line[0] != '+' && line[0] != '-' && name_before_equals(line)) return read_word(line);
  for (auto const& word : words_of(line))
    if (auto wrong = read_word(word); !wrong.empty()) return wrong;
  return "";
}

std::string PovrayOptions::read_ini(fs::path const& path, std::string const& section) {
  constexpr int deepest = 10;
  if (depth_ >= deepest) return fmt::format("'{}': ini files name each other", path.string());
  auto const text = FileText::read(path.string());
  if (!text) return fmt::format("cannot read the ini file '{}'", path.string());
  ++depth_;
  std::string const content(text->view());
  std::string wrong, now;
  bool found = section.empty();
  int number = 0;
  for (std::size_t at = 0; at < content.size() && wrong.empty();) {
    auto const end = std::min(content.find('\n', at), content.size());
    std::string const line = trimmed(content.substr(at, end - at));
    at = end + 1;
    ++number;
    if (line.size() > 1 && line.front() == '[' && line.find(']') != std::string::npos) {
      now = line.substr(1, line.find(']') - 1);
      found = found || same_word(now, section);
    } else if (now.empty() || same_word(now, section)) {
      wrong = read_line(line);
      if (!wrong.empty()) wrong = fmt::format("{}:{}: {}", path.string(), number, wrong);
    }
  }
  --depth_;
  if (wrong.empty() && !found)
    return fmt::format("'{}' has no section [{}]", path.string(), section);
  return wrong;
}

std::string PovrayOptions::read_defaults() {
  if (char const* const named = std::getenv("POVINI"); named && *named) return read_ini(named, "");
  std::vector<fs::path> places{"povray.ini"};
  if (char const* const home = std::getenv("HOME"); home && *home)
    places.push_back(fs::path(home) / ".povray/3.7/povray.ini");
  places.push_back("/etc/povray/3.7/povray.ini");
  for (auto const& place : places) {
    std::error_code none;
    if (fs::exists(place, none)) return read_ini(place, "");
  }
  return "";
}

} // namespace abbe::cli

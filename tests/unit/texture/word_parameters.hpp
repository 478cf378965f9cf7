// SPDX-License-Identifier: MIT
#pragma once

#include "base/parameters.hpp"

#include <cctype>
#include <cstdlib>
#include <sstream>
#include <string>

namespace abbe::texture {

/// Parameters out of a plain text of words, numbers and <vectors>: the language in miniature.
class WordParameters final : public Parameters {
public:
  explicit WordParameters(std::string const& text) {
    std::istringstream in(text);
    for (std::string word; in >> word;) words_.push_back(word);
  }
  double number(std::string_view) override { return std::strtod(take().c_str(), nullptr); }
  int integer(std::string_view name, int low, int high) override {
    int const value = static_cast<int>(number(name));
    if (value < low || value > high) report(Severity::Error, "E0300", name);
    return value;
  }
  Vec2 vec2(std::string_view name) override { return Vec2(vec3(name)); }
  Vec3 vec3(std::string_view) override {
    std::string text = take();
    if (text == "x") return {1, 0, 0};
    if (text == "y") return {0, 1, 0};
    if (text == "z") return {0, 0, 1};
    if (text.front() != '<') return Vec3(std::strtod(text.c_str(), nullptr));
    for (char& c : text)
      if (c == '<' || c == ',' || c == '>') c = ' ';
    std::istringstream in(text);
    Vec3 v{0};
    in >> v.x >> v.y >> v.z;
    return v;
  }
  Vec4 vec4(std::string_view name) override { return Vec4(vec3(name), 0); }
  bool has_value() override { return !at_end() && !std::isalpha(words_[next_].front()); }
  bool accept(std::string_view word) override {
    if (at_end() || words_[next_] != word) return false;
    ++next_;
    return true;
  }
  std::optional<bool> flag(std::string_view word) override {
    if (!accept(word)) return std::nullopt;
    if (accept("off")) return false;
    accept("on");
    return true;
  }
  bool open(std::string_view) override { return false; }
  void close() override {}
  int face_texture() override { return -1; }
  bool at_end() override { return next_ == words_.size(); }
  Span next_span() override { return {}; }
  void report(Severity severity, std::string_view code, std::string_view, Span) override {
    reports.push_back((severity == Severity::Error ? "error " : "warning ") + std::string(code));
  }

  std::vector<std::string> reports;

private:
  void report(Severity severity, std::string_view code, std::string_view message) {
    report(severity, code, message, {});
  }
  std::string take() { return at_end() ? std::string("0") : words_[next_++]; }
  std::vector<std::string> words_;
  std::size_t next_ = 0;
};

} // namespace abbe::texture

// SPDX-License-Identifier: MIT
#include "base/diagnostic.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace abbe {
namespace {

char const* word(Severity severity) {
  switch (severity) {
  case Severity::Error:
    return "error";
  case Severity::Warning:
    return "warning";
  case Severity::Note:
    return "note";
  }
  return "";
}

/// Lines longer than this are cut around the place (a mesh file has lines of megabytes).
constexpr int max_shown = 160;

void append_excerpt(std::string& out, Span const& span) {
  auto const first = span.source->place(span.begin);
  auto const last = span.source->place(std::max(span.begin, span.end));
  std::string_view line = span.source->line(first.line);
  int column = first.column;
  int const length = static_cast<int>(line.size());
  int end_column = last.line == first.line ? last.column : length + 1;
  if (length > max_shown) {
    int const cut = std::max(0, std::min(column - 1 - max_shown / 2, length - max_shown));
    line = line.substr(static_cast<std::size_t>(cut), max_shown);
    column -= cut;
    end_column = std::min(end_column - cut, max_shown + 1);
  }
  std::string shown;
  std::string carets;
  for (std::size_t i = 0; i < line.size(); ++i) {
    char const c = line[i];
    shown += (c == '\t') ? ' ' : (static_cast<unsigned char>(c) < 32 || c == 127) ? '?' : c;
  }
  carets.assign(static_cast<std::size_t>(std::max(0, column - 1)), ' ');
  carets.append(static_cast<std::size_t>(std::max(1, end_column - column)), '^');
  out += fmt::format("\n  {}\n  {}", shown, carets);
}

std::string location(Span const& span) {
  if (!span.valid()) return {};
  auto const first = span.source->place(span.begin);
  auto const last = span.source->place(std::max(span.begin, span.end));
  if (last.line == first.line && last.column > first.column + 1)
    return fmt::format("{}:{}:{}-{}: ", span.source->name(), first.line, first.column,
                       last.column - 1);
  return fmt::format("{}:{}:{}: ", span.source->name(), first.line, first.column);
}

} // namespace

std::string format(Diagnostic const& d) {
  std::string out = location(d.span) + word(d.severity);
  if (!d.code.empty()) out += fmt::format("[{}]", d.code);
  out += ": " + d.message;
  if (d.span.valid()) append_excerpt(out, d.span);
  for (auto const& note : d.notes)
    out += fmt::format("\n{}note: {}", location(note.span), note.message);
  return out;
}

std::string_view nearest_name(std::string_view name, std::span<std::string_view const> valid) {
  std::string_view best;
  std::size_t best_distance = std::max<std::size_t>(1, (name.size() + 1) / 3) + 1;
  std::vector<std::size_t> row;
  for (auto const candidate : valid) {
    if (candidate.size() > name.size() + best_distance) continue;
    // Optimal string alignment distance would count "shpere" as one; plain Levenshtein as two.
    row.assign(candidate.size() + 1, 0);
    std::vector<std::size_t> before(row), older(row);
    for (std::size_t j = 0; j <= candidate.size(); ++j) before[j] = j;
    for (std::size_t i = 1; i <= name.size(); ++i) {
      row[0] = i;
      for (std::size_t j = 1; j <= candidate.size(); ++j) {
        std::size_t const cost = name[i - 1] == candidate[j - 1] ? 0 : 1;
        row[j] = std::min({before[j] + 1, row[j - 1] + 1, before[j - 1] + cost});
        if (i > 1 && j > 1 && name[i - 1] == candidate[j - 2] && name[i - 2] == candidate[j - 1])
          row[j] = std::min(row[j], older[j - 2] + 1);
      }
      older = before;
      before = row;
    }
    if (before[candidate.size()] < best_distance) {
      best_distance = before[candidate.size()];
      best = candidate;
    }
  }
  return best;
}

std::string did_you_mean(std::string_view name, std::span<std::string_view const> valid) {
  auto const near = nearest_name(name, valid);
  return near.empty() ? std::string{} : fmt::format("; did you mean '{}'?", near);
}

} // namespace abbe

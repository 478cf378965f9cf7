// SPDX-License-Identifier: MIT
#include "base/source.hpp"

#include <algorithm>

namespace abbe {

SourceFile::SourceFile(std::string name, FileText text)
    : name_(std::move(name)), text_(std::move(text)) {
  constexpr std::string_view mark = "\xef\xbb\xbf";
  mark_ = text_.view().starts_with(mark) ? mark.size() : 0;
}

void SourceFile::index_lines() const {
  if (!line_starts_.empty()) return;
  line_starts_.push_back(0);
  std::string_view const text = this->text();
  for (std::size_t i = 0; i < text.size(); ++i)
    if (text[i] == '\n' || (text[i] == '\r' && text.substr(i + 1, 1) != "\n"))
      line_starts_.push_back(static_cast<std::uint32_t>(i + 1));
}

SourceFile::Place SourceFile::place(std::uint32_t offset) const {
  index_lines();
  auto const next = std::upper_bound(line_starts_.begin(), line_starts_.end(), offset);
  auto const index = static_cast<std::size_t>(next - line_starts_.begin()) - 1;
  return {static_cast<int>(index) + 1, static_cast<int>(offset - line_starts_[index]) + 1};
}

std::string_view SourceFile::line(int number) const {
  index_lines();
  auto const index = static_cast<std::size_t>(number - 1);
  if (number < 1 || index >= line_starts_.size()) return {};
  std::size_t const begin = line_starts_[index];
  std::string_view const text = this->text();
  std::string_view const rest = text.substr(begin);
  return rest.substr(0, rest.find_first_of("\r\n"));
}

SourceFile const& SourceSet::add(std::string name, FileText text) {
  sources_.push_back(std::make_unique<SourceFile>(std::move(name), std::move(text)));
  return *sources_.back();
}

} // namespace abbe

// SPDX-License-Identifier: MIT
#include "cli/povray/sinks.hpp"

#include "base/file_text.hpp"

#include <algorithm>
#include <cstdio>
#include <cstdlib>

namespace abbe::cli {

image::Status WholePicture::black(int count) {
  constexpr int at_once = 64;
  for (int left = count; left > 0; left -= at_once) {
    image::Image rows = image::make_image(width_, std::min(left, at_once));
    if (alpha_) rows.alpha.assign(rows.pixels(), 1.0f);
    if (auto const taken = sink_.take(rows, passes_); !taken) return taken;
  }
  return std::monostate{};
}

image::Status WholePicture::take(image::Image const& rows, int passes) {
  passes_ = passes;
  if (!begun_) {
    begun_ = true;
    alpha_ = !rows.alpha.empty();
    if (auto const taken = black(part_.y0); !taken) return taken;
  }
  image::Image wide = image::make_image(width_, rows.height);
  if (alpha_) wide.alpha.assign(wide.pixels(), 1.0f);
  auto const width = static_cast<std::size_t>(rows.width);
  for (std::size_t y = 0; y < static_cast<std::size_t>(rows.height); ++y) {
    std::size_t const to =
        y * static_cast<std::size_t>(width_) + static_cast<std::size_t>(part_.x0);
    std::copy_n(&rows.rgb[3 * y * width], 3 * width, &wide.rgb[3 * to]);
    if (alpha_) std::copy_n(&rows.alpha[y * width], width, &wide.alpha[to]);
  }
  return sink_.take(wide, passes);
}

image::Status WholePicture::finish(render::RenderResult const& result) {
  if (auto const taken = black(height_ - part_.y1); !taken) return taken;
  return sink_.finish(result);
}

TemporaryFolder::TemporaryFolder() {
  std::error_code failed;
  std::string pattern = (std::filesystem::temp_directory_path(failed) / "abbe-XXXXXX").string();
  if (!failed && ::mkdtemp(pattern.data())) path_ = pattern;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  if (!path_.empty()) std::filesystem::remove_all(path_, ignored);
}

image::Status copy_to_standard_output(std::filesystem::path const& path) {
  auto const file = FileText::read(path.string());
  if (!file) return Error{"E0511", "cannot read '" + path.string() + "' again"};
  auto const bytes = file->view();
  if (std::fwrite(bytes.data(), 1, bytes.size(), stdout) == bytes.size()
      && std::fflush(stdout) == 0)
    return std::monostate{};
  return Error{"E0510", "cannot write to standard output"};
}

} // namespace abbe::cli

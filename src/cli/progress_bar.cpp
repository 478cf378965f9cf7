// SPDX-License-Identifier: MIT
#include "cli/progress_bar.hpp"
#include "cli/say.hpp"

#include <cstdio>
#include <fmt/format.h>
#include <string>
#include <unistd.h>

namespace abbe::cli {
namespace {

std::string duration(double seconds) {
  int const whole = static_cast<int>(seconds + 0.5);
  if (whole >= 3600)
    return fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
  return fmt::format("{}:{:02}", whole / 60, whole % 60);
}

} // namespace

ProgressBar::ProgressBar(bool quiet) : visible_(!quiet && isatty(STDERR_FILENO) == 1) {}

ProgressBar::~ProgressBar() {
  finish();
}

void ProgressBar::show(render::Progress const& progress) {
  auto const now = Clock::now();
  if (!visible_ || now - last_ < std::chrono::milliseconds(100)) return;
  last_ = now;
  double const elapsed = std::chrono::duration<double>(now - start_).count();
  double const left = progress.share > 0 ? elapsed * (1 - progress.share) / progress.share : 0;
  int const width = 30;
  int const filled = static_cast<int>(progress.share * width);
  std::string const bar = std::string(static_cast<std::size_t>(filled), '#')
                          + std::string(static_cast<std::size_t>(width - filled), '.');
  say_progress(fmt::format("\r[{}] {:5.1f} %  {:.2f} Mrays/s  {} left \033[K", bar,
                           100 * progress.share, static_cast<double>(progress.rays) / elapsed / 1e6,
                           duration(left)));
  shown_ = true;
}

void ProgressBar::finish() {
  if (!shown_) return;
  say_progress("\r\033[K");
  shown_ = false;
}

} // namespace abbe::cli

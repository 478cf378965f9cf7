// SPDX-License-Identifier: MIT
#pragma once

#include "render/render.hpp"

#include <chrono>

namespace abbe::cli {

/// Share done, rays a second and time left, on one line of a terminal; silent elsewhere.
class ProgressBar {
public:
  explicit ProgressBar(bool quiet);
  ~ProgressBar();
  void show(render::Progress const& progress);
  /// Wipes the line.
  void finish();

private:
  using Clock = std::chrono::steady_clock;
  bool visible_;
  bool shown_ = false;
  Clock::time_point start_ = Clock::now();
  Clock::time_point last_ = start_;
};

} // namespace abbe::cli

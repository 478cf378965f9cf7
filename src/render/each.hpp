// SPDX-License-Identifier: MIT
#pragma once

#include "render/render.hpp"

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

namespace abbe::render {

inline int cores_of(RenderOptions const& options) {
  return options.threads > 0 ? options.threads : tbb::this_task_arena::max_concurrency();
}

/// work(i) for each whole number from `first` to below `last`, on so many cores.
template <class Work>
void for_each(int first, int last, int cores, Work const& work) {
  if (cores == 1) { // also within another for_each, which has the other cores
    for (int i = first; i < last; ++i) work(i);
    return;
  }
  tbb::global_control const limit(tbb::global_control::max_allowed_parallelism,
                                  static_cast<std::size_t>(cores));
  tbb::task_arena arena(cores);
  arena.execute([&] { tbb::parallel_for(first, last, work); });
}

} // namespace abbe::render

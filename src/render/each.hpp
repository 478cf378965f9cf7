// SPDX-License-Identifier: MIT
#pragma once

#include "render/render.hpp"

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_pipeline.h>
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

/// The same, and then(i) for each in order, one at a time, while work on others goes on.
template <class Work, class Then>
void for_each_in_order(int first, int last, int cores, Work const& work, Then const& then) {
  if (cores == 1) {
    for (int i = first; i < last; ++i) {
      work(i);
      then(i);
    }
    return;
  }
  tbb::global_control const limit(tbb::global_control::max_allowed_parallelism,
                                  static_cast<std::size_t>(cores));
  tbb::task_arena arena(cores);
  int next = first;
  auto const begin = [&](tbb::flow_control& control) {
    if (next == last) control.stop();
    return next == last ? last : next++;
  };
  auto const go_on = [&](int i) {
    work(i);
    return i;
  };
  using Mode = tbb::filter_mode;
  arena.execute([&] {
    tbb::parallel_pipeline(static_cast<std::size_t>(last - first),
                           tbb::make_filter<void, int>(Mode::serial_in_order, begin)
                               & tbb::make_filter<int, int>(Mode::parallel, go_on)
                               & tbb::make_filter<int, void>(Mode::serial_in_order, then));
  });
}

} // namespace abbe::render

// SPDX-License-Identifier: MIT
#include "base/stopwatch.hpp"

#include <sys/resource.h>

namespace abbe {
namespace {

double process_cpu_s() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  auto const seconds = [](timeval const& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

} // namespace

Stopwatch::Stopwatch()
    : wall_begin_(std::chrono::steady_clock::now()), cpu_begin_s_(process_cpu_s()) {}

double Stopwatch::wall_s() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - wall_begin_).count();
}

double Stopwatch::cpu_s() const {
  return process_cpu_s() - cpu_begin_s_;
}

} // namespace abbe

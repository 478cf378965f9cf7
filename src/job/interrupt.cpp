// SPDX-License-Identifier: MIT
#include "job/interrupt.hpp"

#include "image/atomic_file.hpp"

#include <csignal>
#include <unistd.h>

namespace abbe::job {
namespace {

std::atomic<bool> stop_requested{false};

extern "C" void on_interrupt(int) {
  if (!stop_requested.exchange(true)) return;
  image::remove_unfinished();
  _exit(130);
}

} // namespace

void catch_interrupts() {
  std::signal(SIGINT, on_interrupt);
  std::signal(SIGTERM, on_interrupt);
}

std::atomic<bool> const& interrupted() {
  return stop_requested;
}

} // namespace abbe::job

// SPDX-License-Identifier: MIT
#include "job/interrupt.hpp"

#include "image/atomic_file.hpp"

#include <cmath>
#include <csignal>
#include <string_view>
#include <sys/time.h>
#include <unistd.h>

namespace abbe::job {
namespace {

/// What is told to end has so long to do it in its own way.
constexpr timeval patience{0, 700'000};

std::atomic<bool> stop_requested{false};
std::atomic<int> status{130};

void ring_after(timeval time) {
  itimerval const timer{{0, 0}, time};
  setitimer(ITIMER_REAL, &timer, nullptr);
}

extern "C" void on_interrupt(int signal) {
  if (!stop_requested.exchange(true)) {
    status = signal == SIGTERM ? 143 : signal == SIGINT ? 130 : 124;
    ring_after(patience);
    return;
  }
  image::remove_unfinished();
  constexpr std::string_view message = "abbe: interrupted\n";
  [[maybe_unused]] auto const written = write(STDERR_FILENO, message.data(), message.size());
  _exit(status);
}

} // namespace

void catch_interrupts() {
  struct sigaction action {};
  action.sa_handler = on_interrupt;
  action.sa_flags = SA_RESTART;
  sigemptyset(&action.sa_mask);
  for (int const signal : {SIGINT, SIGTERM, SIGALRM}) sigaddset(&action.sa_mask, signal);
  for (int const signal : {SIGINT, SIGTERM, SIGALRM}) sigaction(signal, &action, nullptr);
}

void limit_time(double seconds) {
  double const whole = std::floor(seconds);
  // A timer of zero would never ring.
  auto const rest = static_cast<suseconds_t>((seconds - whole) * 1e6);
  ring_after({static_cast<time_t>(whole), whole == 0 && rest == 0 ? 1 : rest});
}

std::atomic<bool> const& interrupted() {
  return stop_requested;
}

int interrupted_status() {
  return status;
}

} // namespace abbe::job

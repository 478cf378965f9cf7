// SPDX-License-Identifier: MIT
#pragma once

#include "lang/evaluate.hpp"

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>

namespace abbe::fuzz {

/// Sets a flag once a time has passed, unless it is destroyed before.
class Watchdog {
public:
  explicit Watchdog(std::chrono::milliseconds limit)
      : thread_([this, limit] {
          std::unique_lock lock(mutex_);
          if (!done_.wait_for(lock, limit, [this] { return over_; })) expired_ = true;
        }) {}
  ~Watchdog() {
    {
      std::lock_guard const lock(mutex_);
      over_ = true;
    }
    done_.notify_one();
    thread_.join();
  }
  std::atomic<bool> const& expired() const { return expired_; }

private:
  std::atomic<bool> expired_{false};
  bool over_ = false;
  std::mutex mutex_;
  std::condition_variable done_;
  std::thread thread_;
};

/// Evaluates a text that may be anything; a scene without end is stopped after two seconds.
/// @param name where the scene pretends to lie, so that it finds its includes
inline lang::Evaluated evaluate_limited(std::string name, std::string text) {
  Watchdog const watchdog(std::chrono::seconds(2));
  lang::EvaluateOptions options;
  options.stdlib_dir = ABBE_STDLIB_DIR;
  options.stop = &watchdog.expired();
  return lang::evaluate_text(std::move(name), std::move(text), options);
}

/// "" or what is wrong with the answer: an error must say what and where.
inline std::string complaint(lang::Evaluated const& evaluated) {
  for (auto const& diagnostic : evaluated.diagnostics) {
    std::string const text = format(diagnostic); // must not fail either
    if (diagnostic.severity != Severity::Error || diagnostic.code.empty()) continue;
    if (!diagnostic.span.valid() && diagnostic.code != "E0701") return "without a place: " + text;
    if (diagnostic.span.valid()
        && (diagnostic.span.begin > diagnostic.span.end
            || diagnostic.span.end > diagnostic.span.source->text().size()))
      return "outside its source: " + text;
  }
  return {};
}

} // namespace abbe::fuzz

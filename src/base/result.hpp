// SPDX-License-Identifier: MIT
#pragma once

#include <cstdio>
#include <cstdlib>
#include <string>
#include <utility>
#include <variant>

/// A broken invariant is our bug, never the user's: say where and stop.
#define ABBE_ASSERT(condition)                                                                     \
  do {                                                                                             \
    if (!(condition)) ::abbe::assertion_failed(#condition, __FILE_NAME__, __LINE__);               \
  } while (false)

namespace abbe {

[[noreturn]] inline void assertion_failed(char const* condition, char const* file, int line) {
  std::fprintf(stderr, "abbe: internal error: %s (%s:%d)\n", condition, file, line);
  std::abort();
}

/// Why an operation of a leaf library failed: the caller adds the place.
struct Error {
  std::string code; ///< "E0412"
  std::string message;
};

/// A value or the reason there is none.
template <class T, class E = Error>
class [[nodiscard]] Result {
public:
  Result(T value) : state_(std::in_place_index<0>, std::move(value)) {}
  Result(E error) : state_(std::in_place_index<1>, std::move(error)) {}

  bool ok() const { return state_.index() == 0; }
  explicit operator bool() const { return ok(); }

  T& value() & {
    ABBE_ASSERT(ok());
    return *std::get_if<0>(&state_);
  }
  T const& value() const& {
    ABBE_ASSERT(ok());
    return *std::get_if<0>(&state_);
  }
  T&& value() && {
    ABBE_ASSERT(ok());
    return std::move(*std::get_if<0>(&state_));
  }
  T& operator*() & { return value(); }
  T const& operator*() const& { return value(); }
  T&& operator*() && { return std::move(*this).value(); }
  T* operator->() { return &value(); }
  T const* operator->() const { return &value(); }

  E const& error() const {
    ABBE_ASSERT(!ok());
    return *std::get_if<1>(&state_);
  }

private:
  std::variant<T, E> state_;
};

} // namespace abbe

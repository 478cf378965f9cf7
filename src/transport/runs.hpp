// SPDX-License-Identifier: MIT
#pragma once

#include "geometry/batch.hpp"
#include "transport/lanes.hpp"

#include <algorithm>
#include <cstring>

namespace abbe::transport {

/// Some places of long arrays, in rising order, at most a chunk of them: what follows one another
/// is copied as one piece. Neighbours mostly meet the same.
class Runs {
public:
  template <class Place>
  Runs(Place const* places, std::size_t count) : count_(count) {
    for (std::size_t i = 0; i < count; ++i) {
      auto const place = static_cast<std::uint32_t>(places[i]);
      if (runs_ > 0 && place == run_[runs_ - 1].place + run_[runs_ - 1].length)
        ++run_[runs_ - 1].length;
      else
        run_[runs_++] = {place, 1};
    }
  }
  std::size_t count() const { return count_; }
  /// Values at the places, side by side. @param each so many of them a place
  template <class T>
  void take(T const* from, T* to, std::size_t each = 1) const {
    for (std::size_t i = 0; i < runs_; ++i) {
      std::size_t const length = run_[i].length * each;
      T const* const first = from + run_[i].place * each;
      if (length < least)
        for (std::size_t k = 0; k < length; ++k) to[k] = first[k];
      else
        std::copy_n(first, length, to);
      to += length;
    }
  }
  template <class From, class To>
  void take_vectors(From const& from, To const& to, std::size_t first = 0) const {
    take(&from.x[0], &to.x[first]);
    take(&from.y[0], &to.y[first]);
    take(&from.z[0], &to.z[first]);
  }

private:
  struct Run {
    std::uint32_t place, length;
  };
  /// Shorter pieces are copied value by value.
  static constexpr std::size_t least = 8;
  Run run_[chunk_width];
  std::size_t runs_ = 0, count_;
};

} // namespace abbe::transport

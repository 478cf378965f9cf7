// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace abbe::render {

/// Finds the numbers of things that are kept elsewhere by what these things are: 8 bytes each, at
/// most two of three places taken. (A million objects may each have a colour of its own.)
class NumberTable {
public:
  /// The number of a thing like this one, or else `fresh`, which stands for it from now on.
  /// @param hash of the thing; equal ones have the same
  /// @param equal called with numbers: is that thing like this one?
  template <class Equal>
  std::uint32_t find_or_add(std::uint64_t hash, std::uint32_t fresh, Equal&& equal) {
    if ((count_ + 1) * 3 > slots_.size() * 2) grow();
    auto const mark = static_cast<std::uint32_t>(hash >> 32 ^ hash);
    std::size_t at = mark & (slots_.size() - 1);
    for (; slots_[at].taken != 0; at = (at + 1) & (slots_.size() - 1))
      if (slots_[at].mark == mark && equal(slots_[at].taken - 1)) return slots_[at].taken - 1;
    slots_[at] = {fresh + 1, mark};
    ++count_;
    return fresh;
  }

private:
  struct Slot {
    std::uint32_t taken = 0; ///< number and one, or 0
    std::uint32_t mark = 0;
  };
  void grow() {
    std::vector<Slot> old(slots_.empty() ? 16 : slots_.size() * 2);
    old.swap(slots_);
    for (Slot const& slot : old) {
      if (slot.taken == 0) continue;
      std::size_t at = slot.mark & (slots_.size() - 1);
      while (slots_[at].taken != 0) at = (at + 1) & (slots_.size() - 1);
      slots_[at] = slot;
    }
  }
  std::vector<Slot> slots_; ///< a power of two
  std::size_t count_ = 0;
};

} // namespace abbe::render

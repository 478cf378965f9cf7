// SPDX-License-Identifier: MIT
#pragma once

#include "geometry/shape.hpp"

#include <cstdint>
#include <span>
#include <vector>

/// Which solids touch. A rule of the model, not a tolerance of rounding: facing surfaces of two
/// solids that are closer than a share of the smaller one's extent (the largest side of its bounds)
/// are in contact, as authors mean who write a vessel and its filling in decimal digits. Being
/// relative, it keeps the bits of a scene that is scaled by a power of two.
namespace abbe::geometry {

class Contacts {
public:
  struct Partner {
    std::uint32_t item;
    double reach; ///< widest gap, across it, that counts as none
  };
  Contacts() = default;
  /// @param boxes of the solids that can be in contact; an empty one never is
  /// @param share of the smaller extent; 0: no contacts
  Contacts(std::span<Bounds const> boxes, double share);

  bool any() const { return !partners_.empty(); }
  std::span<Partner const> partners(std::uint32_t item) const {
    return {partners_.data() + first_[item], first_[item + 1] - first_[item]};
  }
  /// Widest reach to any partner; 0 without partners.
  double reach(std::uint32_t item) const;
  /// Reach to `other`; 0 when it is no partner.
  double reach(std::uint32_t item, std::uint32_t other) const;

private:
  std::vector<std::size_t> first_; ///< by item, and an end
  std::vector<Partner> partners_;
};

} // namespace abbe::geometry

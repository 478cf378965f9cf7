// SPDX-License-Identifier: MIT
#pragma once

#include "transport/stage.hpp"

#include <cstddef>
#include <vector>

namespace abbe::transport::caustics {

/// Wavelengths that light is traced at from lamps, with the indices of all media there. The first,
/// `whole`, is none: every medium has the index that it has where no wavelength is distinguished.
class Waves {
public:
  static constexpr int whole = 0;

  /// The same wavelengths of the same stage, which may have been moved since.
  Waves(Stage const& stage, Waves const& other)
      : stage_(stage), lambdas_nm_(other.lambdas_nm_), index_(other.index_) {}
  Waves(Waves const&) = delete;
  Waves& operator=(Waves const&) = delete;
  explicit Waves(Stage const& stage) : stage_(stage) {
    lambdas_nm_.push_back(0);
    for (Medium const& medium : stage.media) index_.push_back(medium.index_d);
  }
  /// @return number of the wavelength
  int add(double lambda_nm) {
    lambdas_nm_.push_back(lambda_nm);
    for (Medium const& medium : stage_.media)
      index_.push_back(medium.dispersive ? medium.glass->index_unchecked(lambda_nm)
                                         : medium.index_d);
    return static_cast<int>(lambdas_nm_.size()) - 1;
  }
  int count() const { return static_cast<int>(lambdas_nm_.size()); }
  /// Forgets all but the first so many.
  void keep(int count) {
    lambdas_nm_.resize(static_cast<std::size_t>(count));
    index_.resize(static_cast<std::size_t>(count) * stage_.media.size());
  }
  double lambda_nm(int wave) const { return lambdas_nm_[static_cast<std::size_t>(wave)]; }
  double index(int wave, int medium) const {
    return index_[static_cast<std::size_t>(wave) * stage_.media.size()
                  + static_cast<std::size_t>(medium)];
  }

private:
  Stage const& stage_;
  std::vector<double> lambdas_nm_;
  std::vector<double> index_; ///< by wavelength, then by medium
};

} // namespace abbe::transport::caustics

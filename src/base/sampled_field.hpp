// SPDX-License-Identifier: MIT
#pragma once

#include "base/scalar_field.hpp"

#include <memory>

namespace abbe {

/// A field parts of which may be known at points alone, as patterns are.
class SampledField : public ScalarField {
public:
  /// The field as one whose slope is nowhere above `most`, which the scene vouches for; null: its
  /// enclosures need no such help.
  virtual std::shared_ptr<ScalarField const> with_slope(double most) const = 0;
};

} // namespace abbe

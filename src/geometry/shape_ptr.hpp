// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

namespace abbe::geometry {

/// For those who keep shapes and ask them nothing.
class Shape;
using ShapePtr = std::shared_ptr<Shape const>;

} // namespace abbe::geometry

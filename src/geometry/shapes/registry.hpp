// SPDX-License-Identifier: MIT
#pragma once

#include "base/parameters.hpp"
#include "geometry/shape.hpp"

#include <optional>
#include <span>
#include <string_view>

namespace abbe::geometry {

/// A shape of the scene language.
struct ShapeKind {
  std::string_view keyword;
  /// Reads the shape's own parameters (not the modifiers that all objects have). What is wrong is
  /// reported with a code E06xx; nullopt when nothing can be drawn, by an error or a warning.
  std::optional<PlacedShape> (*read)(Parameters&);
};

/// All of them, by keyword.
std::span<ShapeKind const> shape_kinds();

} // namespace abbe::geometry

// SPDX-License-Identifier: MIT
#pragma once

#include "surface/textures.hpp"

namespace abbe::surface {

/// The normal of a surface as a layer has it.
/// @param number in Textures::normals
/// @param point in texture space
/// @param normal unit, of the surface, on the side of the ray
/// @return unit, on the side of the ray
Vec3 tilted_normal(Textures const& textures, int number, Vec3 const& point, Vec3 const& normal,
                   texture::Sight const& sight);

} // namespace abbe::surface

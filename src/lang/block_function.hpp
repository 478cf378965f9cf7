// SPDX-License-Identifier: MIT
#pragma once

#include "lang/function.hpp"
#include "lang/reader.hpp"

namespace abbe::lang {

/// Reads the block that a function is made of: `spline { }`, `pigment { }`, `pattern { }` or
/// `transform { }`. What is not supported yet in it makes a function that cannot be called.
void read_block_function(Reader&, FunctionValue&);
/// A part of a vector or colour by the name behind the '.'; -1: gray. nullopt for another name.
std::optional<int> part_of(std::string_view member);
double take_part(Numeric const&, int part);
/// The colour of a pigment at a point of the space around it.
Numeric colour_at(scene::Pigment const& pigment, Vec3 const& point);

} // namespace abbe::lang

// SPDX-License-Identifier: MIT
#pragma once

#include "geometry/shape.hpp"

#include <cstddef>

namespace abbe::geometry {

/// For shapes with any number of crossings: finds the known root of a ray that starts on the
/// surface among out[first ...) (ascending in t, alternating), puts it to t == 0, and sees to it
/// that what comes before and after it stays before and after 0.
///
/// The known root has the direction that the departure says and is within its error and slack of 0;
/// when there is none (the line grazes, and its two roots were lost to rounding), both are put in,
/// the other one just before or just after the start.
/// @param flat_faces a face is crossed at most once: then the face tells the root
void impose_start(Start const& start, bool flat_faces, std::size_t first, Crossings& out);

/// Is there a crossing that impose_start() would take for the known root, and which is nearer than
/// `near`? Then nothing that lies further away is taken for it.
bool has_start(Start const& start, double near, std::size_t first, Crossings const& out);

} // namespace abbe::geometry

// SPDX-License-Identifier: MIT
#pragma once

#include "texture/pattern.hpp"

namespace abbe::texture {

/** @scene checker [ITEM [, ITEM]]
 * A list pattern: unit cubes, alternately of the first and the second item.
 * @code pigment { checker rgb 1, rgb <.1, .1, .3> } @endcode */
std::shared_ptr<Pattern const> read_checker(Parameters&);

} // namespace abbe::texture

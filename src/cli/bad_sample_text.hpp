// SPDX-License-Identifier: MIT
#pragma once

#include "render/render.hpp"

#include <string>

namespace abbe::cli {

/// What `--check-finite` says of a sample: an error E0710, then a line a ray of its path.
std::string bad_sample_text(render::BadSample const& sample);

} // namespace abbe::cli

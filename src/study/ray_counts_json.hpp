// SPDX-License-Identifier: MIT
#pragma once

#include "render/render.hpp"

#include <nlohmann/json_fwd.hpp>

namespace abbe::study {

/// Rays by kind and "total", as `abbe render --stats` and the records of a study have them.
nlohmann::ordered_json rays_to_json(render::RayCounts const& counts);
/// "total" is not read: it is the sum. @throws nlohmann::json::exception what is not of that form
render::RayCounts rays_from_json(nlohmann::json const& rays);

} // namespace abbe::study

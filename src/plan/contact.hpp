// SPDX-License-Identifier: MIT
#pragma once

#include "scene/scene.hpp"

#include <optional>
#include <string>

namespace abbe::plan {

/// What calls for the contact rule of media (geometry/contact.hpp).
struct MediaContact {
  std::string reason; ///< "N-BK7 may touch ior 1.33"
  Span span;          ///< of the interior that comes later in the scene
};

/// The first two refracting solids whose bounds, grown by the share that counts as contact, meet;
/// nullopt when there are none, or when the scene says `contact 0`. Bounds are conservative.
std::optional<MediaContact> find_contact(scene::Scene const& scene);

} // namespace abbe::plan

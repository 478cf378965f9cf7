// SPDX-License-Identifier: MIT
#pragma once

#include "scene/scene.hpp"

#include <vector>

namespace abbe::plan {

/// Which objects can no ray reach in a scene in which rays go straight (nothing reflects or
/// refracts): camera rays stay in the cone of the picture, shadow rays between it and the lights.
/// An object is apart when a plane through the camera has all of that on one side and the object's
/// bounds clearly (1e-6 of a radian) on the other.
class Reach {
public:
  explicit Reach(scene::Scene const& scene);
  /// Surely out of reach; false when in doubt (infinite objects, orthographic cameras).
  bool apart(scene::Object const& object) const;

private:
  Vec3 eye_{0};
  std::vector<Vec3> normals_; ///< of planes through the camera with all rays on their positive side
};

} // namespace abbe::plan

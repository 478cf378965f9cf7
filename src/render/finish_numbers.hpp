// SPDX-License-Identifier: MIT
#pragma once

#include "scene/scene.hpp"

#include <utility>
#include <vector>

namespace abbe::render {

/// Numbers for finishes, by value: objects that were given the same one share what is made of it.
/// Only the latest few are looked through, so that a scene in which each object has its own costs
/// no more than that; one that comes again later has another number then.
class FinishNumbers {
public:
  /// @param tilts finishes of layers with normals of their own have other numbers
  int of(Shared<scene::Finish> const& finish, bool tilts);

private:
  std::vector<std::pair<Shared<scene::Finish>, bool>> known_;
};

} // namespace abbe::render

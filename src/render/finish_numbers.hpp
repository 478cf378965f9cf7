// SPDX-License-Identifier: MIT
#pragma once

#include "scene/scene.hpp"

#include <vector>

namespace abbe::render {

/// Numbers for finishes, by value: objects that were given the same one share what is made of it.
/// Only the latest few are looked through, so that a scene in which each object has its own costs
/// no more than that; one that comes again later has another number then.
class FinishNumbers {
public:
  int of(Shared<scene::Finish> const& finish);

private:
  std::vector<Shared<scene::Finish>> known_;
};

} // namespace abbe::render

// SPDX-License-Identifier: MIT
#pragma once

#include "surface/textures.hpp"

#include <map>
#include <memory>

namespace abbe::render {

/// Normals as numbers into the textures; those that several maps share are compiled once.
class NormalCompiler {
public:
  explicit NormalCompiler(surface::Textures& textures) : textures_(textures) {}

  /// @param linear of the way into the texture's space
  /// @return -1: nothing is tilted
  int add(std::shared_ptr<scene::Normal const> const& normal, Mat3 const& linear);

private:
  int add_entry(std::shared_ptr<scene::Normal const> const& normal);
  surface::Textures& textures_;
  std::map<scene::Normal const*, int> shared_;
};

} // namespace abbe::render

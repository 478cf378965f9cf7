// SPDX-License-Identifier: MIT
#pragma once

#include "render/colour_compiler.hpp"

#include <array>
#include <map>
#include <unordered_map>
#include <vector>

namespace abbe::render {

/// Pigments as numbers into the stage; those that several maps or objects share are compiled once.
class PigmentCompiler {
public:
  PigmentCompiler(ColourCompiler& colours, std::vector<CompiledPigment>& out)
      : colours_(colours), out_(out) {}

  int add(scene::Pigment const& pigment);
  bool opaque(int number) const { return out_[static_cast<std::size_t>(number)].opaque; }
  /// The same everywhere, and all light passes unchanged.
  bool clear(int number) const {
    CompiledPigment const& pigment = out_[static_cast<std::size_t>(number)];
    return !pigment.pattern && pigment.colour.filter == 0 && pigment.colour.transmit == 1;
  }

private:
  int add_shared(std::shared_ptr<scene::Pigment const> const& pigment);
  ColourCompiler& colours_;
  std::vector<CompiledPigment>& out_;
  std::map<scene::Pigment const*, int> shared_;
  /// rgb, filter, transmit.
  using Plain = std::array<double, 5>;
  struct PlainHash {
    std::size_t operator()(Plain const& plain) const;
  };
  std::unordered_map<Plain, int, PlainHash> plain_;
};

CompiledFinish compile_finish(scene::Finish const& finish, scene::Settings const& settings,
                              ColourCompiler& colours);

} // namespace abbe::render

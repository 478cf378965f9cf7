// SPDX-License-Identifier: MIT
#pragma once

#include "render/colour_compiler.hpp"
#include "render/number_table.hpp"

#include <map>
#include <memory>

namespace abbe::render {

/// Pigments as numbers into the stage; those that several maps or objects share are compiled once,
/// and equal plain colours are one.
class PigmentCompiler {
public:
  PigmentCompiler(ColourCompiler& colours, Stage& stage) : colours_(colours), stage_(stage) {}

  int add(scene::Pigment const& pigment);
  bool opaque(int number) const { return of(number).opaque; }
  /// The same everywhere, and all light passes unchanged.
  bool clear(int number) const {
    CompiledPigment const& pigment = of(number);
    return pigment.pattern < 0 && pigment.filter == 0 && pigment.transmit == 1;
  }

private:
  int add_shared(std::shared_ptr<scene::Pigment const> const& pigment);
  /// For patterns with colours of their own.
  void make_colour_grid();
  int add_plain(scene::Colour const& colour);
  CompiledPigment const& of(int number) const {
    return stage_.textures.pigments[static_cast<std::size_t>(number)];
  }
  ColourCompiler& colours_;
  Stage& stage_;
  std::map<scene::Pigment const*, int> shared_;
  NumberTable plain_; ///< by what they were compiled to
};

CompiledFinish compile_finish(scene::Finish const& finish, scene::Settings const& settings,
                              ColourCompiler& colours);

} // namespace abbe::render

// SPDX-License-Identifier: MIT
#pragma once

#include "plan/plan.hpp"
#include "render/colour_compiler.hpp"

#include <map>

namespace abbe::render {

/// Interiors as media of the stage, each compiled once.
class MediaCompiler {
public:
  MediaCompiler(scene::Settings const& settings, plan::Plan const& plan, ColourCompiler& colours,
                Stage& stage);
  /// Number of the interior's medium.
  int add(std::shared_ptr<scene::Interior const> const& interior);

private:
  Medium compile(scene::Interior const& interior);
  int comb_number(optics::Comb comb);

  scene::Settings const& settings_;
  plan::Plan const& plan_;
  ColourCompiler& colours_;
  Stage& stage_;
  std::map<scene::Interior const*, int> known_;
};

} // namespace abbe::render

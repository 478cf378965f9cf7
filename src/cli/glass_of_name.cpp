// SPDX-License-Identifier: MIT
#include "cli/glass_of_name.hpp"

#include "cli/scene_arguments.hpp"
#include "lang/evaluate.hpp"
#include "lang/folders.hpp"

namespace abbe::cli {

Result<optics::GlassPtr> glass_of_name(std::string const& name) {
  lang::EvaluateOptions options;
  options.stdlib_dir = lang::stdlib_dir();
  if (name.find_first_of("\"\\\n\r") != std::string::npos)
    return Error{"E0413", "a glass has no such name: '" + name + "'"};
  auto const evaluated = lang::evaluate_text(
      "--glass", "sphere { 0, 1 interior { glass { \"" + name + "\" } } }\n", options);
  for (auto const& diagnostic : evaluated.diagnostics)
    if (diagnostic.severity == Severity::Error && diagnostic.code != "E0412")
      return Error{diagnostic.code, diagnostic.message};
  if (evaluated.scene.objects.empty() || !evaluated.scene.objects[0].interior)
    return Error{"E0413", "no glass '" + name + "'"};
  return evaluated.scene.objects[0].interior->glass;
}

} // namespace abbe::cli

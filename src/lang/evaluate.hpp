// SPDX-License-Identifier: MIT
#pragma once

#include "base/diagnostic.hpp"
#include "base/result.hpp"
#include "scene/scene.hpp"

#include <atomic>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace abbe::lang {

/// Which picture of a series is made, as POV-Ray's options +K, +KI, +KF, +KFI and +KFF tell a
/// scene. The values are those of a picture alone.
struct AnimationFrame {
  double clock = 0;
  double clock_delta = 0; ///< from one picture to the next
  bool clock_on = false;  ///< was a clock or a series asked for?
  double initial_clock = 0;
  double final_clock = 0;
  int number = 0; ///< `frame_number`
  int initial_frame = 0;
  int final_frame = 0;
};

struct EvaluateOptions {
  std::filesystem::path stdlib_dir;
  std::filesystem::path povray_dir;                              ///< POV-Ray's includes, or none
  std::vector<std::filesystem::path> include_dirs;               ///< -I
  std::vector<std::filesystem::path> read_dirs;                  ///< --allow-read
  std::vector<std::pair<std::string, std::string>> declarations; ///< -D name=value
  std::string before; ///< statements that are read before the scene's, of a source "options"
  int image_width = 640;
  int image_height = 480;
  AnimationFrame frame = {};
  bool allow_write = false; ///< --allow-write
  bool strict = false;      ///< --strict: as `effects strict` in the scene
  int max_errors = 50;
  int max_macro_depth = 1000;
  /// Texts of #debug, #render and #statistics as they come; out of a source above `whole_text`,
  /// once its last statement is parsed. (Warnings and errors are diagnostics.)
  std::function<void(std::string_view)> on_message;
  /// The diagnostics as they come, in the same order; of a source above `whole_text` likewise.
  std::function<void(Diagnostic const&)> on_diagnostic;
  /// Sources of up to so many bytes are parsed before their first statement is evaluated; of larger
  /// ones `text_piece` bytes at a time, so that not the whole tree is in memory. No difference but
  /// that.
  std::size_t whole_text = std::size_t{1} << 20;
  std::size_t text_piece = std::size_t{1} << 16;
  /// Shapes that are copied where declared objects are placed, before such are stored once
  /// (lang/instances.hpp).
  double most_copied_shapes = 0x1p20;
  /// Set from outside (an interrupt), it ends the evaluation at the next step.
  std::atomic<bool> const* stop = nullptr;
};

struct Evaluated {
  std::unique_ptr<SourceSet> sources; ///< spans point into these
  /// The scene file, what it includes, the entries of catalogues that it names.
  std::vector<SourceFile const*> texts;
  scene::Scene scene;
  std::vector<Diagnostic> diagnostics;
  bool unreadable = false;  ///< the scene file itself could not be read: exit status 3
  bool interrupted = false; ///< by EvaluateOptions::stop
  bool ok() const;          ///< no diagnostic is an error
};

/// Reads, parses and evaluates a scene file.
Evaluated evaluate_file(std::filesystem::path const& path, EvaluateOptions const& options);
/// The same for a text (tests, fuzzing).
Evaluated evaluate_text(std::string name, std::string text, EvaluateOptions const& options);

/// Settings as they stand in `global_settings { spectral { ... } }`: "dispersion { hero 4 }
/// representation basis 6". @error of the first diagnostic
Result<scene::SpectralSettings> read_spectral(std::string const& phrases);

/// `abbe dump --scene`: the object graph, one node a line, stable over runs.
std::string dump_scene(scene::Scene const&);

} // namespace abbe::lang

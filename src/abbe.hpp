// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

/// abbe as a library: a scene in, a picture in memory out. Nothing is printed and nothing is
/// written; the same bytes come out as from the program `abbe render`, for any number of threads.
///
/// In CMake: `find_package(abbe)`, `target_link_libraries(mine PRIVATE abbe::abbe)`.
namespace abbe {

/// A message of abbe about a scene.
struct Message {
  enum class Kind {
    Error,   ///< there is no picture because of it
    Warning, ///< what the scene says is strange, or `#warning`
    Text     ///< of the scene itself: `#debug`, `#render`, `#statistics`
  };
  Kind kind = Kind::Error;
  std::string code; ///< "E0203"; empty for a Text
  std::string text;
  /// Where: the file (or the name that render_text was given), line and column from 1. An empty
  /// file: nowhere in particular.
  std::string file;
  int line = 0, column = 0;
};

struct PictureOptions {
  int width = 640;
  int height = 480;
  int threads = 0; ///< 0: one a core

  /// Anti-aliasing as by `--aa N`: up to N x N rays where pixels differ by more than the
  /// threshold. 0: off.
  int aa_depth = 0;
  double aa_threshold = 0.3;
  double aa_jitter = 0; ///< 0..1
  /// Rays of each pixel as by `--samples A..B` instead; 0: as the scene says, if aa_depth is 0.
  int samples = 0;
  int most_samples = 0;        ///< 0: as many as `samples`
  double samples_error = 0.05; ///< standard error of a pixel as displayed, 0..1, that is enough

  std::uint64_t seed = 0; ///< of all random numbers
  int bands = 0;          ///< spectral bands instead of the scene's. 0: as the scene says

  /// Values by name before the scene begins, as by `-D NAME=VALUE`.
  std::vector<std::pair<std::string, std::string>> declarations;
  std::vector<std::filesystem::path> include_folders; ///< -I
  std::vector<std::filesystem::path> read_folders;    ///< --allow-read
  /// abbe's own include files and catalogues. Empty: $ABBE_STDLIB, else where they were installed.
  std::filesystem::path stdlib;

  /// Any thread or signal handler may set it: the picture ends soon after.
  std::atomic<bool> const* stop = nullptr;
  /// The share of the picture that is made, 0..1; called by one thread at a time.
  std::function<void(double share)> on_progress;
};

/// A picture, or why there is none.
struct Picture {
  enum class End {
    Done,
    SceneIsWrong, ///< `messages` say why
    Unreadable,   ///< the scene file cannot be read
    Interrupted   ///< by PictureOptions::stop
  };
  End end = End::SceneIsWrong;
  int width = 0;
  int height = 0;
  /// Linear light, sRGB (Rec. 709) primaries, three numbers a pixel, row by row from the top. 1 is
  /// the white of a display; not clamped. Empty when there is no picture.
  std::vector<float> rgb;
  std::vector<Message> messages; ///< in the order in which they were made

  bool ok() const { return end == End::Done; }
};

/// Renders a scene that is given as text.
/// @param name what messages call it. Files that it includes are looked for in the current folder,
///        PictureOptions::include_folders and the standard library
Picture render_text(std::string const& text, PictureOptions const& options,
                    std::string const& name = "scene");

/// Renders a scene file.
Picture render_file(std::filesystem::path const& path, PictureOptions const& options);

/// "0.1.0"
char const* version();

} // namespace abbe

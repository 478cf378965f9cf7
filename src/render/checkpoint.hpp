// SPDX-License-Identifier: MIT
#pragma once

#include "base/result.hpp"
#include "transport/cut_light.hpp"
#include "transport/ray_counts.hpp"

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

namespace abbe::render {

using transport::CutLight, transport::RayCounts;

/// One tile of one pass: what the picture and its report need of it.
struct TileResult {
  std::vector<float> values; ///< of its pixels, row by row
  RayCounts counts;          ///< of this tile
  CutLight cut;              ///< of this tile; worst_sample: of its thread so far
};

/// A file of finished tiles, from which an interrupted render goes on.
///
/// Tiles are appended whole, each with a checksum: whatever moment the program is killed at, the
/// file holds whole tiles and at most one torn one at its end, which is dropped. It begins with
/// what it belongs to: tiles of another scene, size, options or program are never taken.
/// The file is made when the render has run for `delay`; tiles finished before are made again.
class Checkpoint {
public:
  /// @param delay_seconds 0: from the first tile on
  /// @param identity a hash of scene, options and program: everything that the tiles depend on.
  /// Asked for when it is needed.
  Checkpoint(std::filesystem::path path, double delay_seconds,
             std::function<std::uint64_t()> identity);
  ~Checkpoint();
  Checkpoint(Checkpoint const&) = delete;

  /// Looks at what an earlier render left. Nothing there is no error: everything is to be done.
  /// @error E0520 it belongs to another scene, other options or another build of the program
  /// @error E0521 it is no checkpoint, or another render has it, or it cannot be read
  /// @return the number of tiles that need not be made again
  Result<std::size_t> resume();

  /// Before the first tile. What was resumed must have as many tiles and passes.
  void begin(std::uint32_t tiles, std::uint32_t passes);
  std::optional<TileResult> find(std::uint32_t pass, std::uint32_t tile) const;
  /// Any thread. A write that fails ends checkpointing, not the render (problem()).
  void keep(std::uint32_t pass, std::uint32_t tile, TileResult const& result);

  /// Is there a file that a render could go on from?
  bool written() const { return descriptor_ >= 0 && problem_.empty(); }
  /// Why there is no checkpoint, if there should be one.
  std::string const& problem() const { return problem_; }
  std::filesystem::path const& path() const { return path_; }
  /// The picture is complete.
  void remove();

private:
  Result<std::size_t> read_tiles();
  bool start_file();
  bool append(void const* bytes, std::size_t count);
  std::size_t slot(std::uint32_t pass, std::uint32_t tile) const {
    return std::size_t{pass} * tiles_ + tile;
  }

  std::filesystem::path path_;
  std::chrono::steady_clock::time_point from_;
  std::function<std::uint64_t()> identity_;
  std::uint32_t tiles_ = 0, passes_ = 0;
  int descriptor_ = -1;
  std::uint64_t end_ = 0;                                  ///< of the last whole tile
  std::unordered_map<std::size_t, std::uint64_t> offsets_; ///< by slot
  std::string problem_;
  std::mutex appending_;
};

} // namespace abbe::render

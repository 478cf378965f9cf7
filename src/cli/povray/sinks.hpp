// SPDX-License-Identifier: MIT
#pragma once

#include "job/job.hpp"

#include <filesystem>

namespace abbe::cli {

/// Puts a part of a picture at its place in the whole of it; the rest is black and opaque.
class WholePicture : public job::Sink {
public:
  WholePicture(job::Sink& sink, render::Region const& part, int width, int height)
      : sink_(sink), part_(part), width_(width), height_(height) {}
  image::Status take(image::Image const& rows, int passes) override;
  image::Status finish(render::RenderResult const& result) override;

private:
  image::Status black(int count);
  job::Sink& sink_;
  render::Region part_;
  int width_, height_;
  int passes_ = 1;
  bool begun_ = false, alpha_ = false;
};

/// Takes a picture and keeps nothing of it.
class NoPicture : public job::Sink {
public:
  image::Status take(image::Image const&, int) override { return std::monostate{}; }
  image::Status finish(render::RenderResult const&) override { return std::monostate{}; }
};

/// A folder of its own that is removed with all that is in it.
class TemporaryFolder {
public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(TemporaryFolder const&) = delete;
  TemporaryFolder& operator=(TemporaryFolder const&) = delete;
  /// Empty: it could not be made.
  std::filesystem::path const& path() const { return path_; }

private:
  std::filesystem::path path_;
};

/// Copies a file to standard output. @error E0510, E0511
image::Status copy_to_standard_output(std::filesystem::path const& path);

} // namespace abbe::cli

// SPDX-License-Identifier: MIT
#pragma once

#include "image/writer.hpp"
#include "job/job.hpp"

#include <filesystem>
#include <memory>
#include <string>

namespace abbe::job {

/// What the file of a picture says of itself: size, bands, and as metadata "Software", "Scene",
/// "Plan", "Seed" and "AntiAliasing".
/// @param scene its name
image::ImageHead head_of(render::RenderOptions const& options, plan::Plan const& plan,
                         std::string const& scene);

/// A picture as a file, written while it is made. It is opened when the first rows are done and
/// appears under its name when it is complete: a job that ends before leaves nothing, and a file
/// that was there stays. The metadata get "Passes", if there are several, and "MissingLight".
/// Errors are those of image/writer.hpp.
class PictureFile : public Sink {
public:
  PictureFile(std::filesystem::path path, image::WriteOptions const& options, image::ImageHead head)
      : path_(std::move(path)), options_(options), head_(std::move(head)) {}

  image::Status take(image::Image const& rows, int passes) override;
  image::Status finish(render::RenderResult const& result) override;

private:
  std::filesystem::path path_;
  image::WriteOptions options_;
  image::ImageHead head_;
  std::unique_ptr<image::ImageWriter> writer_;
};

} // namespace abbe::job

// SPDX-License-Identifier: MIT
#pragma once

#include "image/image.hpp"

#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <unistd.h>

namespace abbe::image {

/// A fixture with a directory of its own, removed afterwards.
class ImageFiles : public ::testing::Test {
protected:
  void SetUp() override {
    auto const* info = ::testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::temp_directory_path()
              / ("abbe_image_" + std::string(info->name()) + std::to_string(::getpid()));
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path at(std::string const& name) const { return folder_ / name; }

  std::size_t files() const {
    return static_cast<std::size_t>(
        std::distance(std::filesystem::directory_iterator(folder_), {}));
  }

  static std::string bytes_of(std::filesystem::path const& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }

  static void put_bytes(std::filesystem::path const& path, std::string const& bytes) {
    std::ofstream(path, std::ios::binary) << bytes;
  }

  /// What a command prints; the test is skipped when the machine does not have the command.
  static std::string output_of(std::string const& command) {
    std::string text;
    std::FILE* pipe = ::popen((command + " 2>&1").c_str(), "r");
    char part[4096];
    while (pipe && std::fgets(part, sizeof part, pipe)) text += part;
    if (pipe) ::pclose(pipe);
    return text;
  }
  static bool installed(std::string const& program) {
    return !output_of("command -v " + program).empty();
  }

  std::filesystem::path folder_;
};

/// Values of all signs and sizes that no two pixels share.
inline Image gradient(int width, int height) {
  Image image = make_image(width, height);
  for (std::size_t i = 0; i < image.pixels(); ++i) {
    auto const t = static_cast<float>(i) / static_cast<float>(image.pixels());
    image.rgb[3 * i] = t;
    image.rgb[3 * i + 1] = 1 - t * t;
    image.rgb[3 * i + 2] = t / 3;
  }
  return image;
}

} // namespace abbe::image

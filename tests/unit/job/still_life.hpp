// SPDX-License-Identifier: MIT
#pragma once

#include "job/job.hpp"
#include "tests/unit/render/table_scene.hpp"

#include <cstdlib>
#include <filesystem>
#include <gtest/gtest.h>
#include <string>
#include <variant>
#include <vector>

/// A scene with everything that jobs have to do with, and places for what comes of them.
namespace abbe::job::testing {

namespace fs = std::filesystem;

/// Keeps the rows; may refuse some.
class Kept : public Sink {
public:
  image::Status take(image::Image const& rows, int made) override {
    if (error && ++calls == refused_call) return *error;
    image.width = rows.width;
    image.height += rows.height;
    image.rgb.insert(image.rgb.end(), rows.rgb.begin(), rows.rgb.end());
    passes.push_back(made);
    return std::monostate();
  }
  image::Status finish(render::RenderResult const&) override {
    ++finished;
    if (error && refused_call == 0) return *error;
    return std::monostate();
  }

  image::Image image;
  std::vector<int> passes; ///< as they were told with the rows
  int finished = 0;
  std::optional<Error> error; ///< of a call to take(), from 1; 0: of finish()
  int refused_call = 0, calls = 0;
};

class Jobs : public ::testing::Test {
protected:
  Jobs() {
    std::string name = (fs::temp_directory_path() / "abbe-XXXXXX").string();
    folder = ::mkdtemp(name.data());
    options.render.width = 37;
    options.render.height = 29;
    options.render.tile_size = 4;
    options.render.threads = 1;
  }
  ~Jobs() override { fs::remove_all(folder); }

  static constexpr int tiles = 10 * 8;

  void keep(Keeping::When when = Keeping::When::FromTheFirst) {
    options.keeping.when = when;
    options.keeping.path = folder / "checkpoint";
    options.keeping.scene_identity = 7;
  }
  Outcome make(Sink& sink) const { return run(scene::Scene(scene), *plan, options, sink); }
  /// Without a job.
  render::RenderResult directly() const { return render::render(scene, *plan, options.render); }
  /// Stops when so many more tiles are done.
  void stop_after(int count) {
    stop = false;
    told = 0;
    options.render.stop = &stop;
    options.render.on_progress = [this, count](render::Progress const&) { stop = ++told >= count; };
  }
  static render::AntiAliasing jittered() {
    render::AntiAliasing aa;
    aa.method = 1;
    aa.depth = 2;
    aa.threshold = 0.1;
    aa.jitter = 1;
    return aa;
  }

  scene::Scene scene = render::testing::table(render::testing::deterministic(), true);
  Result<plan::Plan> plan = plan::make_plan(scene, {});
  Options options;
  fs::path folder;
  std::atomic<bool> stop{false};
  int told = 0; ///< calls of on_progress
};

} // namespace abbe::job::testing

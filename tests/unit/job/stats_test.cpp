// SPDX-License-Identifier: MIT
#include "job/stats.hpp"

#include "image/io.hpp"
#include "still_life.hpp"

#include <fstream>
#include <nlohmann/json.hpp>

namespace abbe::job::testing {
namespace {

TEST_F(Jobs, WriteStats) {
  Kept kept;
  auto const outcome = make(kept);
  ASSERT_TRUE(
      write_stats(folder / "stats.json", {"table.scn", 2, 3}, *plan, options.render, outcome));
  std::ifstream file(folder / "stats.json");
  auto const stats = nlohmann::json::parse(file);
  EXPECT_EQ(stats.at("scene"), "table.scn");
  EXPECT_EQ(stats.at("width"), 37);
  EXPECT_EQ(stats.at("height"), 29);
  EXPECT_EQ(stats.at("bands"), 8);
  EXPECT_EQ(stats.at("passes"), 1);
  EXPECT_EQ(stats.at("scene_s").at("wall"), 2);
  EXPECT_EQ(stats.at("scene_s").at("cpu"), 3);
  EXPECT_EQ(stats.at("render_s").at("wall"), outcome.wall_s);
  EXPECT_EQ(stats.at("render_s").at("cpu"), outcome.cpu_s);
  auto const& counts = outcome.result.counts;
  EXPECT_EQ(stats.at("rays").at("camera"), 37 * 29);
  EXPECT_EQ(stats.at("rays").at("total"), counts.total());
  ASSERT_GT(counts.splits, 0u);
  EXPECT_EQ(stats.at("fan_out"), double(counts.monochromatic) / double(counts.splits));
  auto const read = rays_from_json(stats.at("rays"));
  EXPECT_EQ(read.camera, counts.camera);
  EXPECT_EQ(read.shadow, counts.shadow);
  EXPECT_EQ(read.total(), counts.total());
  EXPECT_THROW(rays_from_json(nlohmann::json{{"camera", 1}}), nlohmann::json::exception);
  EXPECT_FALSE(write_stats(folder / "no" / "stats.json", {}, *plan, options.render, outcome));
}

TEST_F(Jobs, WriteCostMaps) {
  options.count_rays = true;
  options.render.region = render::Region{3, 2, 20, 11};
  Kept kept;
  auto const outcome = make(kept);
  ASSERT_TRUE(write_cost_map(folder / "cost.exr", options.render, outcome));
  auto const map = image::read_exr(folder / "cost.exr");
  ASSERT_TRUE(map);
  EXPECT_EQ(map->width, 17);
  ASSERT_EQ(map->pixels(), outcome.rays_of_pixels.size());
  for (std::size_t i = 0; i < map->pixels(); ++i)
    for (std::size_t c = 0; c < 3; ++c) EXPECT_EQ(map->rgb[3 * i + c], outcome.rays_of_pixels[i]);
}

} // namespace
} // namespace abbe::job::testing

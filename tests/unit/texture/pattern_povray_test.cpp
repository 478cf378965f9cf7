// SPDX-License-Identifier: MIT
#include "read_pattern.hpp"

#include <fstream>
#include <set>

namespace abbe::texture {
namespace {

struct Row {
  std::string pattern;
  Vec3 point{0};
  double value = 0;
};

std::vector<Row> povray_rows() {
  std::ifstream file(ABBE_SOURCE_DIR "/tests/unit/texture/povray_patterns.tsv");
  std::vector<Row> rows;
  for (std::string line; std::getline(file, line);) {
    if (line.empty() || line.front() == '#') continue;
    std::istringstream in(line);
    Row row;
    std::getline(in, row.pattern, '\t');
    in >> row.point.x >> row.point.y >> row.point.z >> row.value;
    rows.push_back(row);
  }
  return rows;
}

// Every value that POV-Ray 3.7 printed, to its 12 decimals: half a unit of the last, and as much
// for the rounding of sums of a few hundred terms of size 1.
TEST(Patterns, AgreeWithPovrayToTwelveDecimals) {
  std::vector<Row> const rows = povray_rows();
  ASSERT_GT(rows.size(), 1000u);
  std::set<std::string> seen;
  for (Row const& row : rows) {
    PatternInstance const instance = read_pattern(row.pattern);
    ASSERT_TRUE(instance.pattern);
    seen.insert(row.pattern.substr(0, row.pattern.find(' ')));
    EXPECT_NEAR(instance.evaluate(row.point), row.value, 1e-12)
        << row.pattern << " at " << row.point.x << ' ' << row.point.y << ' ' << row.point.z;
  }
  // POV-Ray makes no functions of these; tests/povray compares pictures of them.
  for (char const* const pictured :
       {"aoi", "average", "facets", "slope", "square", "tiling", "triangular"})
    seen.insert(pictured);
  for (PatternKind const& kind : pattern_kinds())
    EXPECT_TRUE(seen.count(std::string(kind.keyword))) << kind.keyword << " is not compared";
}

} // namespace
} // namespace abbe::texture

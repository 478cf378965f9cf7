// SPDX-License-Identifier: MIT
// The functions of functions.inc against what POV-Ray prints (make_internal_functions.py).
#include "core_run.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <vector>

namespace abbe::lang {
namespace {

struct Row {
  int number = 0;
  std::string arguments; ///< with commas
  double value = 0;
};

std::vector<Row> rows() {
  std::ifstream in(std::string(ABBE_SOURCE_DIR) + "/tests/unit/lang/internal_functions.tsv");
  std::vector<Row> out;
  std::string line;
  while (std::getline(in, line)) {
    std::istringstream parts(line);
    std::string number, arguments, value;
    std::getline(parts, number, '\t');
    std::getline(parts, arguments, '\t');
    std::getline(parts, value);
    for (char& c : arguments)
      if (c == ' ') c = ',';
    out.push_back({std::atoi(number.c_str()), arguments, std::strtod(value.c_str(), nullptr)});
  }
  return out;
}

TEST(InternalFunctions, AgreeWithPovray) {
  std::vector<Row> const table = rows();
  ASSERT_GT(table.size(), 500U);
  std::string text;
  for (Row const& row : table)
    text += "#declare F = function { internal(" + std::to_string(row.number)
            + ") }\n#debug concat(str(F(" + row.arguments + "), 0, 12), \"\\n\")\n#undef F\n";
  std::istringstream values(said(text));
  for (Row const& row : table) {
    std::string value;
    std::getline(values, value);
    // POV-Ray keeps some constants in single precision: 1e-8 of the value.
    EXPECT_NEAR(std::strtod(value.c_str(), nullptr), row.value,
                2e-9 * std::max(1.0, std::abs(row.value)))
        << "internal(" << row.number << ") of " << row.arguments << ": " << value;
  }
}

TEST(InternalFunctions, OthersCannotBeCalledYet) {
  for (int const number : {9, 18, 24})
    EXPECT_EQ(codes_of("#declare F = function { internal(" + std::to_string(number)
                       + ") } #debug str(F(1, 2, 3, 1), 0, 3)"),
              "E0902")
        << number;
}

} // namespace
} // namespace abbe::lang

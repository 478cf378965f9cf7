// SPDX-License-Identifier: MIT
// Long lists of literal vectors are one node of the tree (grammar/ast.hpp, LiteralVectors): what
// reads them sees as many items.
#include "core_run.hpp"

#include <fmt/format.h>

namespace abbe::lang {
namespace {

std::string vectors(int count) {
  std::string text;
  for (int i = 0; i < count; ++i) text += fmt::format("<{}, 1, 2>,\n", i);
  return text;
}

TEST(VectorRun, FillsArrays) {
  std::string const array = "#declare A = array[40] {\n" + vectors(40) + "}\n";
  EXPECT_EQ(said(array + "#debug vstr(3, A[0] + A[17] + A[39], \",\", 0, 0)"), "56,3,6");
  EXPECT_EQ(codes_of("#declare A = array[39] {\n" + vectors(40) + "}\n"), "E0314");
}

TEST(VectorRun, FillsMeshesAndSaysWhereAVectorIsWrong) {
  std::string const mesh =
      "mesh2 { vertex_vectors { 20,\n" + vectors(20) + "} face_indices { 17,\n";
  std::string faces;
  for (int i = 0; i < 17; ++i) faces += fmt::format("<0, {}, 19>,\n", i + 1);
  // Corners in a row have no area: the faces are read, and dropped.
  EXPECT_NE(said(mesh + faces + "} }").find("17 of 17 triangles have no area"), std::string::npos);
  std::string const wrong = said(mesh + "<0, 1, 20>,\n" + faces + "} }");
  EXPECT_NE(wrong.find("test.scn:22:"), std::string::npos) << wrong;
}

} // namespace
} // namespace abbe::lang

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

/// Corners that no other has, so that each face has an area.
std::string corners(int count) {
  std::string text;
  for (int i = 0; i < count; ++i) text += fmt::format("<{}, {}, 2>,\n", i, i * i);
  return text;
}

TEST(VectorRun, IsTakenAsFarAsTheListCounts) {
  // The run is longer or shorter than announced, or broken by what is no literal.
  std::string const faces = "face_indices { 1, <0, 1, 2> } }";
  auto const mesh = [&](int announced, std::string const& list) {
    return codes_of(fmt::format("mesh2 {{ vertex_vectors {{ {}, {} }}", announced, list) + faces);
  };
  EXPECT_EQ(mesh(40, corners(40)), "");
  EXPECT_EQ(mesh(39, corners(40)), "E0203"); // one is left unread
  EXPECT_EQ(mesh(41, corners(40)), "E0613");
  EXPECT_EQ(mesh(58, corners(20) + "<1, 2 * 3, 4>, 5,\n" + corners(36)), "");
  EXPECT_EQ(mesh(40, corners(39) + "#if (1) <7, 8, 9> #end"), "");
}

} // namespace
} // namespace abbe::lang

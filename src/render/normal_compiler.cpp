// SPDX-License-Identifier: MIT
#include "render/normal_compiler.hpp"

namespace abbe::render {

int NormalCompiler::add_entry(std::shared_ptr<scene::Normal const> const& normal) {
  auto const found = shared_.find(normal.get());
  if (found != shared_.end()) return found->second;
  int const number = add(normal, Mat3(1));
  shared_.emplace(normal.get(), number);
  return number;
}

int NormalCompiler::add(std::shared_ptr<scene::Normal const> const& normal, Mat3 const& linear) {
  if (!normal || !normal->pattern) return -1;
  surface::CompiledNormal out;
  out.source = normal;
  Mat3 way = linear;
  for (auto step = normal->pattern->mappings.rbegin(); step != normal->pattern->mappings.rend();
       ++step)
    way = step->linear * way;
  out.in = glm::transpose(glm::inverse(way));
  out.out = glm::transpose(way);
  for (auto const& entry : normal->entries) {
    out.values.push_back(entry.value);
    out.entries.push_back(add_entry(entry.normal));
  }
  textures_.normals.push_back(std::move(out));
  return static_cast<int>(textures_.normals.size()) - 1;
}

} // namespace abbe::render

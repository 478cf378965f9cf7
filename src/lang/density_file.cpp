// SPDX-License-Identifier: MIT
#include "lang/blocks.hpp"
#include "lang/load_file.hpp"
#include "lang/scene_patterns.hpp"
#include "texture/catmull_rom.hpp"

#include <algorithm>
#include <cmath>

namespace abbe::lang {

namespace {

/// Values of a DF3 file, 0..1, x fastest.
struct Voxels {
  int size[3] = {1, 1, 1};
  std::vector<float> values{0.0F};
};

std::optional<Voxels> unpack(std::string const& bytes) {
  auto const byte = [&](std::size_t k) { return static_cast<unsigned char>(bytes[k]); };
  if (bytes.size() < 6) return std::nullopt;
  Voxels out;
  std::size_t count = 1;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    out.size[axis] = byte(2 * axis) << 8 | byte(2 * axis + 1);
    count *= static_cast<std::size_t>(out.size[axis]);
  }
  std::size_t const each = count == 0 ? 0 : (bytes.size() - 6) / count;
  if (each != 1 && each != 2 && each != 4) return std::nullopt;
  out.values.resize(count);
  double const most = std::ldexp(1.0, static_cast<int>(8 * each)) - 1;
  for (std::size_t k = 0; k < count; ++k) {
    double value = 0;
    for (std::size_t part = 0; part < each; ++part) value = value * 256 + byte(6 + k * each + part);
    out.values[k] = static_cast<float>(value / most);
  }
  return out;
}

/// A place along an axis: the file is repeated, and what stands before its first value is the one
/// that POV-Ray's unsigned remainder finds there.
int around(int place, int size) {
  if (place < 0) return static_cast<int>(0xffffffffU % static_cast<unsigned>(size));
  return place % size;
}

class DensityFile final : public texture::Pattern {
public:
  explicit DensityFile(std::shared_ptr<Voxels const> voxels) : voxels_(std::move(voxels)) {}

  double raw(Vec3 const& p, texture::PatternModifiers const&) const override {
    int const* const size = voxels_->size;
    double at[3];
    for (int axis = 0; axis < 3; ++axis) {
      if (!(p[axis] >= 0 && p[axis] < 1)) return 0;
      at[axis] = p[axis] * size[axis];
    }
    if (interpolate_ == 0)
      return value(static_cast<int>(at[0]), static_cast<int>(at[1]), static_cast<int>(at[2]));
    // Shares of the values around the point: two an axis, or four.
    int const first = interpolate_ == 2 ? -1 : 0, count = interpolate_ == 2 ? 4 : 2;
    int place[3][4];
    double share[3][4];
    for (int axis = 0; axis < 3; ++axis) {
      int const low = static_cast<int>(std::floor(at[axis]));
      double const t = at[axis] - low;
      if (count == 4) {
        texture::catmull_rom(t, share[axis]);
      } else {
        share[axis][0] = 1 - t;
        share[axis][1] = t;
      }
      for (int k = 0; k < count; ++k) place[axis][k] = around(low + first + k, size[axis]);
    }
    double sum = 0;
    for (int z = 0; z < count; ++z)
      for (int y = 0; y < count; ++y)
        for (int x = 0; x < count; ++x)
          sum += share[0][x] * share[1][y] * share[2][z]
                 * value(place[0][x], place[1][y], place[2][z]);
    return sum;
  }
  std::shared_ptr<Pattern const> read_item(Parameters& in) const override {
    if (!in.accept("interpolate")) return nullptr;
    auto changed = std::make_shared<DensityFile>(*this);
    changed->interpolate_ = in.integer("interpolation", 0, 2);
    return changed;
  }

private:
  double value(int x, int y, int z) const {
    auto const place = [&](int axis, int k) {
      return static_cast<std::size_t>(std::clamp(k, 0, voxels_->size[axis] - 1));
    };
    auto const width = static_cast<std::size_t>(voxels_->size[0]),
               height = static_cast<std::size_t>(voxels_->size[1]);
    return static_cast<double>(
        voxels_->values[(place(2, z) * height + place(1, y)) * width + place(0, x)]);
  }
  std::shared_ptr<Voxels const> voxels_;
  int interpolate_ = 0;
};

} // namespace

std::shared_ptr<texture::Pattern const> read_density_file(Reader& in, bool&) {
  in.accept("density_file");
  if (!in.accept("df3")) in.unexpected("'df3'");
  Span const at = in.next_span();
  std::string const name = in.path("the file of a density");
  auto const bytes = load_file(in.interpreter(), name, {".df3"});
  auto voxels = bytes ? unpack(*bytes) : std::optional<Voxels>();
  if (!bytes)
    in.report(Severity::Error, bytes.error().code, bytes.error().message, at);
  else if (!voxels)
    in.report(Severity::Error, "E0513",
              "'" + name + "' is damaged: its length is not that of three sizes and as many values",
              at);
  return std::make_shared<DensityFile>(
      std::make_shared<Voxels const>(voxels ? std::move(*voxels) : Voxels{}));
}

} // namespace abbe::lang

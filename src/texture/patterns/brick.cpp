// SPDX-License-Identifier: MIT
#include "texture/patterns/brick.hpp"

#include "texture/lattice.hpp"

namespace abbe::texture {
namespace {

/// Position inside its brick, from the mortar's near edge: 0 <= position < size.
double within(double position, double size) {
  return position - size * std::floor(position / size);
}

class Brick final : public Pattern {
public:
  /// 0: mortar, 1: brick.
  double raw(Vec3 const& p, PatternModifiers const&) const override {
    Vec3 q = p + (mortar_ + cell_tolerance);
    if (within(q.y, size_.y) <= mortar_) return 0;
    bool const odd_course = wrapped_floor(q.y / size_.y, 1) != 0;
    (odd_course ? q.x : q.z) += 0.5 * (odd_course ? size_.x : size_.z);
    return within(q.x, size_.x) > mortar_ && within(q.z, size_.z) > mortar_ ? 1 : 0;
  }
  int list_size() const override { return 2; }
  double default_frequency() const override { return 0; }
  std::span<DefaultEntry const> default_map() const override {
    static DefaultEntry const mortar_and_brick[] = {{0, Vec3(0.5)}, {1, Vec3(0.6, 0.15, 0.15)}};
    return mortar_and_brick;
  }
  std::shared_ptr<Pattern const> read_item(Parameters& in) const override {
    auto changed = std::make_shared<Brick>(*this);
    Span const span = in.next_span();
    if (in.accept("brick_size")) {
      changed->size_ = in.vec3("brick size");
      if (!(changed->size_.x > 0 && changed->size_.y > 0 && changed->size_.z > 0)) {
        in.report(Severity::Error, "E0382", "every component of brick_size must be positive", span);
        changed->size_ = size_;
      }
    } else if (in.accept("mortar")) {
      changed->mortar_ = in.number("mortar width");
      if (!(changed->mortar_ >= 0)) {
        in.report(Severity::Error, "E0382", "the mortar's width must not be negative", span);
        changed->mortar_ = mortar_;
      }
    } else {
      return nullptr;
    }
    return changed;
  }

private:
  Vec3 size_{8, 3, 4.5};
  double mortar_ = 0.5;
};

} // namespace

std::shared_ptr<Pattern const> read_brick(Parameters&) {
  return std::make_shared<Brick>();
}

} // namespace abbe::texture

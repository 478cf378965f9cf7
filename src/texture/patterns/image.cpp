// SPDX-License-Identifier: MIT
#include "texture/patterns/image.hpp"

#include "simd/math.hpp"
#include "texture/catmull_rom.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace abbe::texture {
namespace {

constexpr double pi = std::numbers::pi;

double fraction(double v) {
  return v - std::floor(v);
}

int modulo(int value, int by) {
  int const left = value % by;
  return left < 0 ? left + by : left;
}

double around(Vec3 const& p) {
  return fraction(simd::atan2(p.z, p.x) / (2 * pi));
}

} // namespace

std::optional<ImagePattern::Place> ImagePattern::place(Vec3 const& p) const {
  double u = p.x, v = p.y;
  switch (map_type_) {
  case 1:
    u = around(p);
    v = 0.5 + simd::asin(std::clamp(p.y / glm::length(p), -1.0, 1.0)) / pi;
    break;
  case 2:
    u = around(p);
    break;
  case 5:
    u = around(p);
    v = (simd::atan2(p.y, std::sqrt(p.x * p.x + p.z * p.z) - 1) + pi) / (2 * pi);
    break;
  default:
    break;
  }
  if (once_ && (u < 0 || u > 1 || v < 0 || v > 1)) return std::nullopt;
  if (!std::isfinite(u + v)) u = v = 0;
  return Place{fraction(u) * picture_->width, fraction(v) * picture_->height};
}

std::size_t ImagePattern::place_of(int x, int y) const {
  int const w = picture_->width, h = picture_->height;
  if (once_) {
    x = std::clamp(x, 0, w - 1);
    y = std::clamp(y, 0, h - 1);
  }
  int const row = h - 1 - modulo(y, h);
  return static_cast<std::size_t>(row) * static_cast<std::size_t>(w)
         + static_cast<std::size_t>(modulo(x, w));
}

template <class Of>
double ImagePattern::mixed(Place const& place, Of const& of) const {
  if (interpolate_ == 0) return of(place_of(static_cast<int>(place.x), static_cast<int>(place.y)));
  double const x = place.x - 0.5, y = place.y - 0.5;
  int const x0 = static_cast<int>(std::floor(x)), y0 = static_cast<int>(std::floor(y));
  double const tx = x - x0, ty = y - y0;
  if (interpolate_ == 3) {
    double along[4], up[4], sum = 0;
    catmull_rom(tx, along);
    catmull_rom(ty, up);
    for (int j = 0; j < 4; ++j)
      for (int i = 0; i < 4; ++i) sum += up[j] * along[i] * of(place_of(x0 + i - 1, y0 + j - 1));
    return sum; // it overshoots, as POV-Ray's does
  }
  double sum = 0, shares = 0;
  for (int j = 0; j < 2; ++j)
    for (int i = 0; i < 2; ++i) {
      double const dx = i != 0 ? 1 - tx : tx, dy = j != 0 ? 1 - ty : ty;
      double share = (1 - dx) * (1 - dy);
      if (interpolate_ == 4) {
        double const square = dx * dx + dy * dy;
        if (square == 0) return of(place_of(x0 + i, y0 + j));
        share = 1 / square;
      }
      sum += share * of(place_of(x0 + i, y0 + j));
      shares += share;
    }
  return sum / shares;
}

double ImagePattern::value(Place const& place) const {
  if (use_index_ && use_ == Use::Bumps && !picture_->index.empty())
    return std::floor(mixed(place, [&](std::size_t k) { return double(picture_->index[k]); }));
  return mixed(place, [&](std::size_t k) -> double {
    Picture::Texel const& t = picture_->texels[k];
    if (use_alpha_) return static_cast<double>(t.transmit);
    return 0.297 * static_cast<double>(t.r) + 0.589 * static_cast<double>(t.g)
           + 0.114 * static_cast<double>(t.b);
  });
}

double ImagePattern::raw(Vec3 const& point, PatternModifiers const&) const {
  auto const here = place(point);
  if (use_ == Use::Numbers) {
    if (!here) return 0;
    std::size_t const k = place_of(static_cast<int>(here->x), static_cast<int>(here->y));
    if (!picture_->index.empty()) return picture_->index[k];
    return std::floor(static_cast<double>(picture_->texels[k].r) * 255);
  }
  return here ? std::clamp(value(*here), 0.0, 1.0) : 0;
}

PatternColour ImagePattern::colour_at(Vec3 const& point) const {
  auto const here = place(point);
  if (!here) return {Vec3(1), 0, 1};
  auto const& texels = picture_->texels;
  auto const part = [&](float Picture::Texel::*of) {
    return mixed(*here, [&](std::size_t k) { return static_cast<double>(texels[k].*of); });
  };
  using Texel = Picture::Texel;
  return {Vec3(part(&Texel::r), part(&Texel::g), part(&Texel::b)), part(&Texel::filter),
          part(&Texel::transmit)};
}

bool ImagePattern::lets_light_pass() const {
  if (use_ != Use::Colours) return false;
  auto const& texels = picture_->texels;
  return once_ || std::any_of(texels.begin(), texels.end(), [](Picture::Texel const& t) {
           return t.filter != 0 || t.transmit != 0;
         });
}

bool ImagePattern::tilt(Vec3 const& point, PatternModifiers const&, double amount,
                        Vec3& normal) const {
  if (use_ != Use::Bumps) return false;
  auto const here = place(point);
  if (!here) return true;
  // Heights of the pixel and of two of its neighbours, one row further down, make a triangle.
  auto const height = [&](double dx, double dy) {
    double const w = picture_->width, h = picture_->height;
    double const x = here->x + dx, y = here->y + dy;
    return bump_size_.value_or(amount)
           * value({x - w * std::floor(x / w), y - h * std::floor(y / h)});
  };
  double const middle = height(0, 0), left = height(-1, -1), right = height(1, -1);
  Vec3 const a(-1, left - middle, 1), b(1, right - middle, 1);
  Vec3 const bump = glm::normalize(glm::cross(a, b));
  // It stands for `up` in a frame whose up is the normal.
  Vec3 across(-normal.z, 0, normal.x);
  double const length = glm::length(across);
  across = length > 1e-10 ? across / length : Vec3(1, 0, 0);
  Vec3 const along = glm::normalize(glm::cross(normal, across));
  normal = bump.x * across + bump.y * normal + bump.z * along;
  return true;
}

std::shared_ptr<Pattern const> ImagePattern::read_item(Parameters& in) const {
  auto changed = std::make_shared<ImagePattern>(*this);
  Span const at = in.next_span();
  if (in.accept("once")) {
    changed->once_ = true;
  } else if (in.accept("interpolate")) {
    changed->interpolate_ = in.integer("interpolation", 0, 4);
    if (changed->interpolate_ == 1) changed->interpolate_ = 0;
  } else if (in.accept("map_type")) {
    changed->map_type_ = in.integer("map type", 0, 5);
    if (changed->map_type_ == 3 || changed->map_type_ == 4)
      in.report(Severity::Error, "E0386", "map_type is 0, 1, 2 or 5", at);
  } else if (in.accept("use_index")) {
    changed->use_index_ = true;
  } else if (in.accept("use_color") || in.accept("use_colour")) {
    changed->use_index_ = changed->use_alpha_ = false;
  } else if (use_ == Use::Bumps && in.accept("bump_size")) {
    changed->bump_size_ = in.number("bump_size");
  } else if (in.accept("use_alpha")) {
    changed->use_alpha_ = true;
  } else {
    return nullptr;
  }
  return changed;
}

} // namespace abbe::texture

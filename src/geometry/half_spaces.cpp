// SPDX-License-Identifier: MIT
#include "geometry/half_spaces.hpp"

#include "geometry/line.hpp"
#include "geometry/shapes/plane.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace abbe::geometry {

namespace {

using lane::Double4;
constexpr std::size_t width = 4;

Double4 load(std::vector<double> const& from, std::size_t i) {
  Double4 v;
  std::memcpy(&v, from.data() + i, sizeof v);
  return v;
}
void store(std::vector<double>& to, std::size_t i, Double4 const& v) {
  std::memcpy(to.data() + i, &v, sizeof v);
}

} // namespace

bool is_plane(Shape const& shape) {
  return dynamic_cast<Plane const*>(&shape) != nullptr;
}

HalfSpaces::Scaled HalfSpaces::scaled(Placed const& placed, bool outside_counts) {
  Vec3 const own = placed.shape().normal(Vec3(0), 0);
  Vec3 const bound = glm::transpose(placed.inverse_size()) * glm::abs(own);
  double const scale = std::max(bound.x, std::max(bound.y, bound.z));
  Vec3 const normal = placed.to_world_normal(own) / (outside_counts ? -scale : scale);
  return {normal, glm::dot(normal, placed.offset())};
}

void HalfSpaces::add(PrimitiveId primitive, Placed const& placed, bool outside_counts) {
  auto const [normal, level] = scaled(placed, outside_counts);
  primitives_.push_back(primitive);
  outside_counts_.push_back(outside_counts ? 1 : 0);
  normal_x_.push_back(normal.x);
  normal_y_.push_back(normal.y);
  normal_z_.push_back(normal.z);
  level_.push_back(level);
  offset_size_ = std::max(offset_size_, sum_of_sizes(placed.offset_size()));
}

void HalfSpaces::finish() {
  while (normal_x_.size() % width != 0) {
    for (std::vector<double>* const v : {&normal_x_, &normal_y_, &normal_z_, &level_}) {
      v->push_back(v->back());
    }
  }
}

HalfSpaces::Verdict HalfSpaces::apply_departure(Departure const& from, double steep,
                                                HalfSpaceScratch& scratch) const {
  for (std::size_t i = 0; i < from.on.size(); ++i) {
    Departure::On const& on = from.on[i];
    auto const found = std::lower_bound(primitives_.begin(), primitives_.end(), on.primitive);
    if (found == primitives_.end() || *found != on.primitive) continue;
    for (std::size_t j = 0; j < i; ++j) {
      if (from.on[j].primitive == on.primitive) return Verdict::Unclear;
    }
    auto const k = static_cast<std::size_t>(found - primitives_.begin());
    bool const to_inside = (on.was_entering == from.through) != (outside_counts_[k] != 0);
    double const speed = scratch.speed[k];
    if (!(to_inside ? speed < -steep : speed > steep)) return Verdict::Unclear;
    if (!to_inside) return Verdict::Nothing;
    // Inside from the start on: as if entered infinitely far behind.
    std::size_t const last = k + 1 == primitives_.size() ? scratch.height.size() : k + 1;
    for (std::size_t same = k; same < last; ++same) scratch.height[same] = -infinity;
  }
  return Verdict::Something;
}

HalfSpaces::Verdict HalfSpaces::common(Ray const& ray, Departure const* from,
                                       HalfSpaceScratch& scratch, Common& out) const {
  std::size_t const size = normal_x_.size();
  scratch.resize(size);
  out.at_rest = at_rest(ray.origin, from != nullptr ? ray.origin_error : Vec3(0), offset_size_);
  out.per_t = per_t(ray.direction);
  double const steep = clear_factor * out.per_t;
  Double4 const ox(ray.origin.x), oy(ray.origin.y), oz(ray.origin.z);
  Double4 const dx(ray.direction.x), dy(ray.direction.y), dz(ray.direction.z);
  Double4 const zero(0.0), far(infinity), at_rest(out.at_rest), slow(steep);
  for (std::size_t i = 0; i < size; i += width) {
    Double4 const nx = load(normal_x_, i), ny = load(normal_y_, i), nz = load(normal_z_, i);
    Double4 const height = (nx * ox + ny * oy + nz * oz) - load(level_, i);
    Double4 const speed = nx * dx + ny * dy + nz * dz;
    // Outside of one, and going away from it.
    if (!lane::none(lane::both(at_rest < height, slow < speed))) return Verdict::Nothing;
    store(scratch.height, i, height);
    store(scratch.speed, i, speed);
  }
  if (from != nullptr) {
    Verdict const verdict = apply_departure(*from, steep, scratch);
    if (verdict != Verdict::Something) return verdict;
  }
  Double4 nearest_out = far, farthest_in = far; // of -t
  lane::Mask4 unclear{};
  for (std::size_t i = 0; i < size; i += width) {
    Double4 const height = load(scratch.height, i), speed = load(scratch.speed, i);
    unclear =
        lane::either(unclear, lane::either(lane::abs(height) <= at_rest, lane::abs(speed) <= slow));
    Double4 const minus_t = height / speed, t = -minus_t;
    auto const leaving = zero < speed, above = zero < height;
    Double4 const out_t = lane::select(leaving, t, far);
    Double4 const minus_in = lane::select(lane::both(lane::negate(leaving), above), minus_t, far);
    store(scratch.out, i, out_t);
    store(scratch.minus_in, i, minus_in);
    nearest_out = lane::min(nearest_out, out_t);
    farthest_in = lane::min(farthest_in, minus_in);
  }
  if (!lane::none(unclear)) return Verdict::Unclear;
  double const minus_in = lane::least(farthest_in), out_t = lane::least(nearest_out);
  out.in = end(out, scratch.minus_in, minus_in, scratch);
  out.in.t = -out.in.t;
  out.out = end(out, scratch.out, out_t, scratch);
  return Verdict::Something;
}

HalfSpaces::End HalfSpaces::end(Common const& common, std::vector<double> const& ts, double t,
                                HalfSpaceScratch const& scratch) const {
  End result{t, 0, 0};
  if (!(t < infinity)) return result;
  while (ts[result.plane] != t) ++result.plane;
  result.error =
      (common.at_rest + std::fabs(t) * common.per_t) / std::fabs(scratch.speed[result.plane]);
  return result;
}

int HalfSpaces::entering_near(Common const& common, double t, double error,
                              HalfSpaceScratch const& scratch) const {
  int near = 0;
  for (std::size_t k = 0; k < primitives_.size(); ++k) {
    double const own = -scratch.minus_in[k], speed = std::fabs(scratch.speed[k]);
    near += (t - own - error) * speed <= common.at_rest + own * common.per_t ? 1 : 0;
  }
  return near;
}

int HalfSpaces::leaving_near(Common const& common, double t, double error,
                             HalfSpaceScratch const& scratch) const {
  int near = 0;
  for (std::size_t k = 0; k < primitives_.size(); ++k) {
    double const own = scratch.out[k], speed = std::fabs(scratch.speed[k]);
    bool const within = (own - t - error) * speed <= common.at_rest + own * common.per_t;
    near += within && own < infinity ? 1 : 0;
  }
  return near;
}

} // namespace abbe::geometry

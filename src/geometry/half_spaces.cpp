// SPDX-License-Identifier: MIT
#include "geometry/half_spaces.hpp"

#include "geometry/line.hpp"
#include "geometry/shapes/plane.hpp"
#include "simd/native.hpp"

#include <algorithm>
#include <cmath>

namespace abbe::geometry {

namespace {

constexpr std::size_t width = 4;

/// Planes as HalfSpaces keeps them, whole lanes.
struct Planes {
  double const *x, *y, *z, *level;
  std::size_t size;
};
struct Bound {
  double at_rest, per_t;
};

/// Heights over the planes and speeds towards them. @return false where the line is outside of one
/// and goes away from it
struct Measure {
  template <class L>
  static bool run(Planes const& planes, Ray const& ray, double at_rest, double steep,
                  HalfSpaceScratch& scratch) {
    L const ox(ray.origin.x), oy(ray.origin.y), oz(ray.origin.z);
    L const dx(ray.direction.x), dy(ray.direction.y), dz(ray.direction.z);
    L const clear(at_rest), slow(steep);
    Planes const p = planes;
    double *const heights = scratch.height.data(), *const speeds = scratch.speed.data();
    for (std::size_t i = 0; i < p.size; i += width) {
      L const nx = lane::load<L>(p.x + i), ny = lane::load<L>(p.y + i), nz = lane::load<L>(p.z + i);
      L const height = (nx * ox + ny * oy + nz * oz) - lane::load<L>(p.level + i);
      L const speed = nx * dx + ny * dy + nz * dz;
      if (!lane::none(lane::both(clear < height, slow < speed))) return false;
      lane::store(heights + i, height);
      lane::store(speeds + i, speed);
    }
    return true;
  }
};

/// Place of the first that is `value`, which is there.
template <class L>
std::size_t place_of(double value, double const* values) {
  std::size_t i = 0;
  while (lane::none(lane::load<L>(values + i) == L(value))) i += width;
  while (values[i] != value) ++i;
  return i;
}

/// The last entry or the first exit: t with its sign as stored, and whose it is.
struct Extreme {
  double t;
  std::size_t plane;
};

/// Where the line enters and leaves each, and the last and first of that. @return false where a
/// plane is too near the start, or nearly parallel
struct FindEnds {
  template <class L>
  static bool run(std::size_t size, double at_rest, double steep, HalfSpaceScratch& scratch,
                  Extreme& in, Extreme& out) {
    L const zero(0.0), far(infinity), clear(at_rest), slow(steep);
    L nearest_out = far, farthest_in = far; // of -t
    auto unclear = zero < zero;
    double const *const heights = scratch.height.data(), *const speeds = scratch.speed.data();
    double *const outs = scratch.out.data(), *const minus_ins = scratch.minus_in.data();
    for (std::size_t i = 0; i < size; i += width) {
      L const height = lane::load<L>(heights + i), speed = lane::load<L>(speeds + i);
      unclear =
          lane::either(unclear, lane::either(lane::abs(height) <= clear, lane::abs(speed) <= slow));
      L const minus_t = height / speed, t = -minus_t;
      auto const leaving = zero < speed, above = zero < height;
      L const out_t = lane::select(leaving, t, far);
      L const minus_in = lane::select(lane::both(lane::negate(leaving), above), minus_t, far);
      lane::store(outs + i, out_t);
      lane::store(minus_ins + i, minus_in);
      nearest_out = lane::min(nearest_out, out_t);
      farthest_in = lane::min(farthest_in, minus_in);
    }
    if (!lane::none(unclear)) return false;
    in = {lane::least(farthest_in), 0};
    out = {lane::least(nearest_out), 0};
    if (in.t < infinity) in.plane = place_of<L>(in.t, minus_ins);
    if (out.t < infinity) out.plane = place_of<L>(out.t, outs);
    return true;
  }
};

/// How many planes' ends may be within their errors of t +- error. @tparam Entering those where the
/// line enters, else where it leaves
template <bool Entering>
struct CountNear {
  template <class L>
  static int run(HalfSpaceScratch const& scratch, Bound const& bound, double t, double error) {
    L const zero(0.0), one(1.0), far(infinity), here(t), about(error), at_rest(bound.at_rest),
        per_t(bound.per_t);
    L near = zero;
    std::size_t const size = scratch.speed.size();
    double const* const speeds = scratch.speed.data();
    double const* const ends = (Entering ? scratch.minus_in : scratch.out).data();
    for (std::size_t i = 0; i < size; i += width) {
      L const speed = lane::abs(lane::load<L>(speeds + i)), end = lane::load<L>(ends + i);
      L const own = Entering ? -end : end;
      L const apart = Entering ? here - own : own - here;
      auto const within = (apart - about) * speed <= at_rest + own * per_t;
      near = near + lane::select(lane::both(within, lane::abs(own) < far), one, zero);
    }
    return static_cast<int>(lane::get(near, 0) + lane::get(near, 1) + lane::get(near, 2)
                            + lane::get(near, 3));
  }
};

simd::Native<Measure, width> const measure;
simd::Native<FindEnds, width> const find_ends;
simd::Native<CountNear<true>, width> const near_entries;
simd::Native<CountNear<false>, width> const near_exits;

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
  narrow_.push_back({static_cast<float>(normal.x), static_cast<float>(normal.y),
                     static_cast<float>(normal.z), static_cast<float>(level)});
  widest_level_ = std::max(widest_level_, std::fabs(level));
  offset_size_ = std::max(offset_size_, sum_of_sizes(placed.offset_size()));
}

void HalfSpaces::finish() {
  while (normal_x_.size() % width != 0) {
    for (std::vector<double>* const v : {&normal_x_, &normal_y_, &normal_z_, &level_}) {
      v->push_back(v->back());
    }
  }
}

std::size_t HalfSpaces::place_of(PrimitiveId primitive) const {
  auto const found = std::lower_bound(primitives_.begin(), primitives_.end(), primitive);
  bool const here = found != primitives_.end() && *found == primitive;
  return here ? static_cast<std::size_t>(found - primitives_.begin())
              : static_cast<std::size_t>(-1);
}

HalfSpaces::Verdict HalfSpaces::apply_departure(Departure const& from, double steep,
                                                HalfSpaceScratch& scratch) const {
  for (std::size_t i = 0; i < from.on.size(); ++i) {
    Departure::On const& on = from.on[i];
    std::size_t const k = place_of(on.primitive);
    if (k == static_cast<std::size_t>(-1)) continue;
    for (std::size_t j = 0; j < i; ++j) {
      if (from.on[j].primitive == on.primitive) return Verdict::Unclear;
    }
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
  Planes const planes{normal_x_.data(), normal_y_.data(), normal_z_.data(), level_.data(), size};
  if (!measure(planes, ray, out.at_rest, steep, scratch)) return Verdict::Nothing;
  if (from != nullptr) {
    Verdict const verdict = apply_departure(*from, steep, scratch);
    if (verdict != Verdict::Something) return verdict;
  }
  Extreme first_out{}, last_in{};
  if (!find_ends(size, out.at_rest, steep, scratch, last_in, first_out)) return Verdict::Unclear;
  // What fills up the lanes is not to be counted.
  for (std::size_t i = primitives_.size(); i < size; ++i)
    scratch.out[i] = scratch.minus_in[i] = infinity;
  auto const end = [&](Extreme const& extreme) {
    End result{extreme.t, 0, extreme.plane};
    if (extreme.t < infinity)
      result.error = (out.at_rest + std::fabs(extreme.t) * out.per_t)
                     / std::fabs(scratch.speed[extreme.plane]);
    return result;
  };
  out.in = end(last_in);
  out.in.t = -out.in.t;
  out.out = end(first_out);
  return Verdict::Something;
}

int HalfSpaces::entering_near(Common const& common, double t, double error,
                              HalfSpaceScratch const& scratch) const {
  return empty() ? 0 : near_entries(scratch, {common.at_rest, common.per_t}, t, error);
}

int HalfSpaces::leaving_near(Common const& common, double t, double error,
                             HalfSpaceScratch const& scratch) const {
  return empty() ? 0 : near_exits(scratch, {common.at_rest, common.per_t}, t, error);
}

} // namespace abbe::geometry

// SPDX-License-Identifier: MIT
#include "geometry/shapes/instances.hpp"

#include "base/random.hpp"
#include "geometry/bounds.hpp"
#include "geometry/line_query.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <mutex>
#include <numeric>
#include <unordered_map>

namespace abbe::geometry {
namespace {

constexpr double nowhere = std::numeric_limits<double>::infinity();

} // namespace

Definition::Definition(std::vector<Leaf> leaves, std::vector<Part> parts)
    : leaves_(std::move(leaves)), parts_(std::move(parts)) {
  auto const smooth = [](ShapePtr const& shape) { return shape->smoothed(); };
  smoothed_ = std::ranges::any_of(leaves_, smooth, &Leaf::shape)
              || std::ranges::any_of(parts_, smooth, &Part::definition);
  std::vector<Bounds> boxes;
  for (Leaf const& leaf : leaves_) boxes.push_back(Placed(leaf.shape, leaf.placement).bounds());
  for (Part const& part : parts_) boxes.push_back(Placed(part.definition, part.placement).bounds());
  std::vector<Item> items(boxes.size());
  std::iota(items.begin(), items.end(), Item{0});
  std::erase_if(items, [&](Item item) { return boxes[item].empty(); });
  if (items.empty()) return;
  nodes_.reserve(2 * items.size());
  build(items, boxes, 0, items.size());
  bounds_ = nodes_.front().box;
}

void Definition::build(std::vector<Item>& items, std::vector<Bounds> const& boxes,
                       std::size_t first, std::size_t end) {
  std::size_t const own = nodes_.size();
  nodes_.push_back({boxes[items[first]], items[first], 0});
  for (std::size_t i = first + 1; i < end; ++i)
    nodes_[own].box = hull(nodes_[own].box, boxes[items[i]]);
  if (end - first == 1) return;
  Vec3 const size = nodes_[own].box.high - nodes_[own].box.low;
  int axis = size.y > size.x ? 1 : 0;
  if (size.z > size[axis]) axis = 2;
  auto const middle = [&](Item item) { return boxes[item].low[axis] + boxes[item].high[axis]; };
  auto const at = items.begin();
  std::size_t const half = (first + end) / 2;
  std::nth_element(at + static_cast<std::ptrdiff_t>(first), at + static_cast<std::ptrdiff_t>(half),
                   at + static_cast<std::ptrdiff_t>(end), [&](Item a, Item b) {
                     return middle(a) != middle(b) ? middle(a) < middle(b) : a < b;
                   });
  build(items, boxes, first, half);
  nodes_[own].other = static_cast<std::uint32_t>(nodes_.size());
  build(items, boxes, half, end);
}

/// A tree of numbers: what has one is an item of what has another; items of leaves are their faces.
/// Any thread may add to it and read it.
class Instances::Numbers {
public:
  struct Known {
    std::uint32_t above = 0, item = 0;
    std::unique_ptr<Placed const> placed; ///< of a leaf
    int texture = 0;
  };
  static constexpr std::uint32_t root = 0;

  Numbers() { add(); }
  ~Numbers() {
    for (auto& block : blocks_) delete[] block.load();
  }
  Numbers(Numbers const&) = delete;

  Known const& operator[](std::uint32_t number) const { return at(number); }
  /// The number of an item; where it has none yet, make(Known&) says what is to be known of it.
  template <class Make>
  std::uint32_t number_of(std::uint32_t above, std::uint32_t item, Make const& make) {
    std::uint64_t const key = std::uint64_t{above} << 32 | item;
    Shard& shard = shards_[mix_bits(key) % shards_.size()];
    std::lock_guard const lock(shard.mutex);
    auto const known = shard.numbers.find(key);
    if (known != shard.numbers.end()) return known->second;
    std::uint32_t const number = add();
    Known& fresh = at(number);
    fresh.above = above;
    fresh.item = item;
    make(fresh);
    shard.numbers.emplace(key, number);
    return number;
  }

private:
  /// Block k holds 2^k of them and never moves.
  Known& at(std::uint32_t number) const {
    auto const k = static_cast<unsigned>(std::bit_width(std::uint64_t{number} + 1)) - 1;
    return blocks_[k].load(std::memory_order_acquire)[std::uint64_t{number} + 1 - (1ULL << k)];
  }
  std::uint32_t add() {
    std::lock_guard const lock(adding_);
    std::uint32_t const number = count_++;
    auto const k = static_cast<unsigned>(std::bit_width(std::uint64_t{number} + 1)) - 1;
    if (blocks_[k].load(std::memory_order_relaxed) == nullptr)
      blocks_[k].store(new Known[std::size_t{1} << k], std::memory_order_release);
    return number;
  }
  struct Shard {
    std::mutex mutex;
    std::unordered_map<std::uint64_t, std::uint32_t> numbers;
  };
  std::array<Shard, 64> shards_;
  std::mutex adding_;
  std::uint32_t count_ = 0;
  std::array<std::atomic<Known*>, 33> blocks_{};
};

/// One line on its way through the definitions.
struct Instances::Walk {
  Ray ray;
  Start const* start;
  bool all; ///< every crossing of the whole line
  double until;
  std::vector<std::uint32_t> start_path{}; ///< items down to the leaf that the ray starts on
  std::uint32_t start_face = 0;
  std::vector<std::uint32_t> path{}; ///< items down to where it is
  bool on_start_path = true;         ///< so far

  struct Found {
    Crossing crossing;
    std::vector<std::uint32_t> path;
    Definition::Leaf const* leaf;
  };
  std::vector<Found> found{};
  Crossings crossings{};
};

Instances::Instances(std::shared_ptr<Definition const> definition, Transform const& placement,
                     Transform const& outer)
    : definition_(std::move(definition)),
      placement_(placement),
      outer_(outer),
      bounds_(Placed(definition_, placement.then(outer)).bounds()) {}
Instances::~Instances() {
  delete numbers_.load();
}

Instances::Numbers& Instances::numbers() const {
  Numbers* known = numbers_.load(std::memory_order_acquire);
  if (known != nullptr) return *known;
  auto fresh = std::make_unique<Numbers>();
  if (numbers_.compare_exchange_strong(known, fresh.get(), std::memory_order_acq_rel))
    return *fresh.release();
  return *known;
}

void Instances::meet(Walk& walk, Definition::Leaf const& leaf, Transform const& at) const {
  Placed const placed(leaf.shape, leaf.placement.then(at).then(outer_));
  bool const starts =
      walk.start != nullptr && walk.on_start_path && walk.path.size() == walk.start_path.size();
  if (!walk.all && !starts && placed.misses(walk.ray, walk.until)) return;
  Ray const ray = placed.to_object(walk.ray);
  Start const start{walk.start_face, starts && walk.start->to_inside};
  walk.crossings.clear();
  if (walk.all)
    leaf.shape->crossings(ray, starts ? &start : nullptr, walk.crossings);
  else
    leaf.shape->crossings_ahead(ray, starts ? &start : nullptr, walk.until, walk.crossings);
  for (Crossing const& c : walk.crossings) {
    if (!walk.all) {
      // What belongs to the group that the ray departs from is not ahead.
      bool const at_start = starts ? c.t == 0 : walk.start != nullptr && std::fabs(c.t) <= c.error;
      if (!(c.t > 0) || at_start || c.t - group_margin * c.error > walk.until) continue;
      if (c.visible) walk.until = std::min(walk.until, c.t + group_margin * c.error);
    }
    walk.found.push_back({c, walk.path, &leaf});
  }
}

namespace {

/// Where a line is in a box, widened by more than its errors. @return false: nowhere within
/// [low, high]
bool enters(Bounds const& box, Ray const& line, double low, double high, double& entry) {
  constexpr double wide = 0x1p-40, few = 0x1p-48;
  for (int axis = 0; axis < 3; ++axis) {
    double const o = line.origin[axis], d = line.direction[axis], e = line.direction_rounding[axis];
    double const margin =
        line.origin_rounding[axis] + line.origin_error[axis]
        + wide * (std::fabs(o) + std::max(std::fabs(box.low[axis]), std::fabs(box.high[axis])));
    double const a = box.low[axis] - margin - o, b = box.high[axis] + margin - o;
    if (d == 0 && e == 0) {
      if (a > 0 || b < 0) return false;
      continue;
    }
    if (std::fabs(d) <= 2 * e) continue; // its sign is not known
    double from = a / d, to = b / d;
    if (from > to) std::swap(from, to);
    double const off = 2 * e / std::fabs(d) + few;
    low = std::max(low, from - std::fabs(from) * off);
    high = std::min(high, to + std::fabs(to) * off);
    if (low > high) return false;
  }
  entry = low;
  return true;
}

} // namespace

void Instances::go(Walk& walk, std::shared_ptr<Definition const> const& definition,
                   Transform const& at) const {
  auto const& nodes = definition->nodes();
  if (nodes.empty()) return;
  Ray const line = Placed(definition, at.then(outer_)).to_object(walk.ray);
  double const low = walk.all ? -nowhere : 0;
  struct Waiting {
    double entry;
    std::uint32_t node;
  };
  std::vector<Waiting> waiting;
  double entry = 0;
  if (enters(nodes[0].box, line, low, walk.until, entry)) waiting.push_back({entry, 0});
  std::size_t const depth = walk.path.size();
  bool const on_path = walk.on_start_path;
  while (!waiting.empty()) {
    auto const [begin, number] = waiting.back();
    waiting.pop_back();
    if (begin > walk.until) continue;
    Definition::Node const& node = nodes[number];
    if (node.other != 0) {
      Waiting below[2]{{0, number + 1}, {0, node.other}};
      bool met[2];
      for (int i = 0; i < 2; ++i)
        met[i] = enters(nodes[below[i].node].box, line, low, walk.until, below[i].entry);
      int const far = below[1].entry < below[0].entry ? 0 : 1;
      if (met[far]) waiting.push_back(below[far]);
      if (met[1 - far]) waiting.push_back(below[1 - far]);
      continue;
    }
    walk.path.push_back(node.item);
    walk.on_start_path =
        on_path && depth < walk.start_path.size() && walk.start_path[depth] == node.item;
    auto const& leaves = definition->leaves();
    if (node.item < leaves.size()) {
      meet(walk, leaves[node.item], at);
    } else {
      Definition::Part const& part = definition->parts()[node.item - leaves.size()];
      go(walk, part.definition, part.placement.then(at));
    }
    walk.path.pop_back();
  }
  walk.on_start_path = on_path;
}

void Instances::collect(Walk& walk, Crossings& out) const {
  if (walk.start != nullptr) {
    Numbers::Known const* known = &numbers()[walk.start->face];
    walk.start_face = known->item;
    for (std::uint32_t number = known->above; number != Numbers::root; number = known->above) {
      known = &numbers()[number];
      walk.start_path.push_back(known->item);
    }
    std::ranges::reverse(walk.start_path);
  }
  // What is known where the ray comes from: the shape's own space is the world's.
  walk.ray.origin_rounding = walk.ray.direction_rounding = Vec3(0);
  go(walk, definition_, placement_);
  for (Walk::Found const& found : walk.found) {
    if (!walk.all && found.crossing.t - group_margin * found.crossing.error > walk.until) continue;
    std::uint32_t number = Numbers::root;
    for (std::size_t i = 0; i < found.path.size(); ++i)
      number = numbers().number_of(number, found.path[i], [&](Numbers::Known& fresh) {
        if (i + 1 < found.path.size()) return;
        Transform at = placement_.transform();
        Definition const* in = definition_.get();
        for (std::size_t k = 0; k < i; ++k) {
          auto const& part = in->parts()[found.path[k] - in->leaves().size()];
          at = part.placement.then(at);
          in = part.definition.get();
        }
        fresh.placed = std::make_unique<Placed const>(found.leaf->shape,
                                                      found.leaf->placement.then(at).then(outer_));
        fresh.texture = found.leaf->texture;
      });
    Crossing crossing = found.crossing;
    crossing.face = numbers().number_of(number, found.crossing.face, [](Numbers::Known&) {});
    out.push_back(crossing);
  }
}

void Instances::crossings(Ray const& ray, Start const* start, Crossings& out) const {
  Walk walk{ray, start, true, nowhere};
  collect(walk, out);
}

void Instances::crossings_ahead(Ray const& ray, Start const* start, double until,
                                Crossings& out) const {
  Walk walk{ray, start, false, until};
  collect(walk, out);
}

bool Instances::inside(Vec3 const&) const {
  return false;
}

Vec3 Instances::normal(Vec3 const& point, std::uint32_t face) const {
  Numbers::Known const& known = numbers()[face];
  return numbers()[known.above].placed->normal(known.item, point, false);
}
Vec3 Instances::geometric_normal(Vec3 const& point, std::uint32_t face) const {
  Numbers::Known const& known = numbers()[face];
  return numbers()[known.above].placed->normal(known.item, point, true);
}
std::optional<Vec2> Instances::uv(Vec3 const& point, std::uint32_t face) const {
  Numbers::Known const& known = numbers()[face];
  Placed const& placed = *numbers()[known.above].placed;
  Vec3 const inner = placed.to_object(point);
  return placed.shape().uv(inner, known.item).value_or(Vec2(inner.x, inner.y));
}
int Instances::face_texture(std::uint32_t face) const {
  return numbers()[numbers()[face].above].texture;
}

} // namespace abbe::geometry

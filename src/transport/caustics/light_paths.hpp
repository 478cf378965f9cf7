// SPDX-License-Identifier: MIT
#pragma once

#include "transport/buckets.hpp"
#include "transport/caustics/chain.hpp"
#include "transport/caustics/waves.hpp"
#include "transport/insides.hpp"
#include "transport/shares.hpp"
#include "transport/way.hpp"

#include <span>
#include <vector>

namespace abbe::transport::caustics {

/// How deep light from lamps goes, and what it must carry.
struct Limits {
  int max_trace_level = 16;
  double adc_bailout = 1.0 / 4096; ///< share of what the lamp sent
};

/// Rays of light on their way from lamps, in batches: the same surfaces, media and textures as for
/// rays of the camera, with the same Fresnel and Snell. They carry the flux of a pencil of light,
/// not radiance, so there is no factor of the index.
class LightPaths {
public:
  /// Rays that begin, values a ray; `each` lanes of light.
  struct Starts {
    std::size_t each = 1;
    std::size_t lamp = 0;
    bool in_order = false; ///< each has all channels, from the first to the last
    std::vector<Vec3> origin, direction;
    std::vector<int> wave;
    std::vector<std::uint16_t> channels; ///< a lane
    std::vector<int> target;             ///< chain that is wanted, by ray; empty: all branches
    std::size_t count() const { return origin.size(); }
    void clear() {
      origin.clear();
      direction.clear();
      wave.clear();
      channels.clear();
      target.clear();
    }
  };
  /// A ray behind the last step of its chain.
  struct Segment {
    std::uint32_t ray = 0; ///< of Starts
    int chain = 0;
    Vec3 origin{0}, direction{0};
    double length = 0; ///< of the way so far
    double power = 0;  ///< of its brightest lane
    /// How far it goes to the next surface; infinite: to none. Of branches only.
    double far = 0;
    bool receives = false; ///< that surface shows light that falls on it
  };

  LightPaths(Stage const& stage, Waves const& waves, Limits const& limits);

  /// All branches of each ray: a segment behind every step, in order of generations. New chains are
  /// added.
  void branches(Starts const& starts, ChainTable& chains, std::vector<Segment>& out);
  /// Each ray along the chain that it is to take; none where the real surfaces do not make it.
  /// @param light a value a lane of each ray of Starts; 0 where there is no segment
  void along_targets(Starts const& starts, ChainTable const& chains, std::vector<Segment>& out,
                     std::vector<double>& light);
  /// What light was given up for being too little or too deep, of all branches so far: in units
  /// of one ray's.
  double cut() const { return cut_; }
  std::uint64_t rays() const { return rays_; }

private:
  static constexpr std::uint32_t no_segment = 0xffffffff;
  struct Front {
    geometry::VectorArrays origin, direction, error;
    std::vector<double> vectors[9];
    std::vector<geometry::RayStart> start;
    std::vector<MediaStacks::Id> stack;
    std::vector<std::uint32_t> ray, segment;
    std::vector<int> chain, level;
    std::vector<std::uint8_t> bent; ///< some step was a caster's
    std::vector<double> length, light;
    std::size_t count = 0;
    void clear();
    std::size_t add();
    geometry::RayLines lines(geometry::Groups const& groups) const {
      return {count, origin, direction, error, start.data(), &groups};
    }
  };
  void run(Starts const& starts, std::vector<Segment>& out);
  void start(Starts const& starts);
  void arrive(Front& now, std::vector<Segment>& out);
  void meet(Starts const& starts, Front const& now, BucketKey const& key,
            std::span<std::uint32_t const> places, std::vector<Segment>& out);
  void gather(Starts const& starts, Front const& now, BucketKey const& key,
              std::span<std::uint32_t const> places);
  void send(Starts const& starts, Front const& now, std::span<std::uint32_t const> places,
            std::size_t r, bool mirror, double const* light, std::vector<Segment>& out);
  bool receives(geometry::RayHit const& hit) const;

  Stage const& stage_;
  Waves const& waves_;
  Limits limits_;
  Arena arena_;
  geometry::ScratchPtr scratch_;
  MediaStacks stacks_;
  Insides insides_;
  Buckets buckets_;
  geometry::Hits hits_;
  geometry::Groups groups_[2];
  Front fronts_[2];
  std::size_t turn_ = 0;
  std::vector<BucketKey> keys_;
  std::vector<MediaStacks::Id> before_, after_;
  std::vector<Aim> aims_;
  Chunk chunk_;
  Values chunk_way_;
  ChainTable* grows_ = nullptr;
  ChainTable const* chains_ = nullptr;
  std::vector<double>* arrived_ = nullptr;
  double cut_ = 0;
  std::uint64_t rays_ = 0;
};

/// Turns chunk directions into those behind a surface: normals, angles, Fresnel and Snell.
/// @pre count, direction, point, hit, n1 and n2 are set
void bend(Stage const& stage, Arena& arena, Chunk& chunk);

} // namespace abbe::transport::caustics

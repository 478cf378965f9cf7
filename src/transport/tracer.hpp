// SPDX-License-Identifier: MIT
#pragma once

#include "transport/buckets.hpp"
#include "transport/captures.hpp"
#include "transport/caustics/caustic_lights.hpp"
#include "transport/comb_light.hpp"
#include "transport/emitter.hpp"
#include "transport/insides.hpp"
#include "transport/interface.hpp"
#include "transport/shader.hpp"
#include "transport/shadows.hpp"
#include "transport/shares.hpp"
#include "transport/wavelengths/adaptive.hpp"
#include "transport/way.hpp"

#include <atomic>
#include <optional>
#include <span>
#include <vector>

namespace abbe::transport {

/// Traces camera samples, one batch at a time; one tracer per thread. All rays of a generation meet
/// what they meet together, are sorted by it, and are worked on bucket by bucket; what comes of
/// them is the next generation. Throughput is carried from the camera on, so that a path that can
/// add nothing more is dropped, and light is added to the sample's film where it is met.
///
/// What is made of a sample depends on nothing but the sample: sums are in the order of
/// generations, of queues, of buckets and of rays, and none of these depends on which other samples
/// there are.
class Tracer {
public:
  /// @param footprint of a pixel of the picture @param record is told of every ray; or null
  explicit Tracer(Stage const& stage, Footprint footprint = {}, PathRecord* record = nullptr);

  /// Samples that are best traced together.
  std::size_t batch() const { return batch_; }
  /// The light arriving at points of the picture, which light_of() tells then.
  /// @pre as many as batch() at most, a key each
  void trace(PicturePoints const& points, std::span<SampleKey const> keys);
  /// @param bands one value a channel of the spectral film, or empty
  Vec3 light_of(std::size_t sample, std::span<double> bands) {
    return film_.resolve(sample, waves_, bands);
  }
  /// What was cut of its light.
  double lost_of(std::size_t sample) const { return emitter_.lost_of(sample); }
  /// Is the light of one of the last samples finite, and not negative where that is wrong?
  std::optional<BadSample::Kind> wrong(std::size_t sample, Vec3 const& rgb,
                                       bool negative_is_wrong) const {
    return what_is_wrong(film_.light(sample), rgb, negative_is_wrong);
  }
  /// Leaves soon when it is set, without a picture. @param stop may be null
  void stop_when(std::atomic<bool> const* stop) { stop_ = stop; }
  /// Counts each sample's rays from now on.
  void count_rays() { emitter_.count_rays(); }
  bool counts_rays() const { return !emitter_.rays_of_sample.empty(); }
  std::uint32_t rays_of(std::size_t sample) const { return emitter_.rays_of_sample[sample]; }

  RayCounts const& counts() const { return emitter_.counts; }
  CutLight const& cut_light() const { return emitter_.cut_light; }

private:
  /// How media meet at a surface.
  struct Face {
    bool fresnel = false; ///< a real dielectric: reflects by Fresnel unasked
    bool splits = false;  ///< each lane goes its own way
    bool picks = false;   ///< one tooth goes on alone, or would if this were not its control light
    bool doubles = false; ///< by the published scheme
    int split_wave = 0;   ///< wave table of the split
    int comb = no_comb;   ///< that draws its wavelengths
    Medium const* governing = nullptr; ///< the medium whose mode it is
  };

  void start_camera(PicturePoints const& points, std::span<SampleKey const> keys);
  /// Until no ray is left.
  void drain();
  /// Half of the samples whose rays are next are to wait.
  void set_aside();
  void take_back();
  void step(QueueKey const& key, Rays& rays);
  /// What each ray met, and what it is inside of before and after.
  void arrive(Rays& rays);
  BucketKey meeting_of(Rays& rays, std::size_t place);
  /// The same where media neither displace each other nor leak, of one surface.
  BucketKey plain_meeting(MediaStacks::Id before, geometry::RayHit const& hit, std::size_t place);
  /// Puts rays of a bucket side by side.
  void gather(QueueKey const& key, Rays const& rays, std::span<std::uint32_t const> places);
  void find_normals();

  // tracer_meet.cpp
  void meet(BucketKey const& key);
  void escape();
  void pass_on();
  Face face_of(LightKind const& kind) const;
  /// @param left medium whose light fades at the end of the way; 0: none
  void travel(int left);
  void pass_air();
  void find_indices();
  Shares split_lanes(Face const& face);
  /// The surface's own light, what lamps add to it, and what it lets pass and mirrors.
  SurfaceLight shade_chunk(Face const& face, Shares const& shares, bool lit);
  /// @param surface null: clear
  void find_shares(Face const& face, SurfaceLight const* surface, Shares& shares) {
    transport::find_shares(arena_, chunk_, face.fresnel, face.splits, surface, shares);
  }
  void mirror(Face const& face, SurfaceLight const* surface, Shares const& shares);
  /// Light that comes back in one direction a ray.
  struct Mirrored {
    std::uint32_t number;  ///< QueueKey::mirrored
    double* light;         ///< a lane
    RaySet rays, bent = 0; ///< `bent`: those of them whose light is raised to a power
    Vectors const* way;
    Values const* exponent = nullptr; ///< of those in `bent`
  };
  void send_back(Face const& face, Mirrored const& mirrored);
  void mirror_bent(Face const& face, Mirrored const& mirrored);
  /// @param light of the chunk's rays, as it is parted
  void capture(ChunkLight const& light, std::size_t r, Mirrored const& mirrored);
  void go_on(Face const& face, Shares const& shares);
  void share(Face const& face);
  void meet_comb(Face const& face);

  Stage const& stage_;
  Arena arena_;
  geometry::ScratchPtr scratch_;
  std::size_t batch_;
  WaveTables waves_;
  SampleFilm film_;
  MediaStacks stacks_;
  Paths paths_;
  Emitter emitter_;
  Shadows shadows_;
  Captures captures_;
  std::unique_ptr<caustics::CausticLights> caustic_lights_; ///< null: there are none
  AdaptiveSplits adaptive_;
  CombLight comb_light_;
  Way way_;
  std::atomic<bool> const* stop_ = nullptr;
  Insides insides_;
  std::optional<MediaStacks::Id> camera_stack_; ///< where all start at one point
  bool first_rays_ = false; ///< the next step is that of the rays of the camera itself

  // Of the rays in work.
  geometry::Hits hits_;
  Buckets buckets_;
  geometry::Groups starts_; ///< groups that rays of this batch start from
  std::vector<BucketKey> keys_;
  std::vector<MediaStacks::Id> before_, after_;
  std::vector<double> rest_; ///< how far in the last medium
  std::vector<std::uint32_t> path_;
  std::vector<std::uint16_t> channels_;
  std::vector<Aim> aims_;
  std::vector<RandomKey> jitter_; ///< by sample
  /// Rays of samples that are followed later, the latest first.
  std::vector<std::vector<std::pair<QueueKey, Rays>>> waiting_;
  Chunk chunk_;
  Values chunk_rest_, chunk_way_;
  /// Where the chunk's rays come through open air; where there is something in it.
  struct {
    RaySet rays = 0;
    Vectors origin;
    Values distance;
  } air_;
};

} // namespace abbe::transport

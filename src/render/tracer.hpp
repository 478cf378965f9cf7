// SPDX-License-Identifier: MIT
#pragma once

#include "base/arena.hpp"
#include "geometry/fan.hpp"
#include "render/beam.hpp"
#include "render/camera.hpp"
#include "render/cut_light.hpp"
#include "render/interface.hpp"
#include "render/path_ray.hpp"
#include "render/path_record.hpp"
#include "render/route.hpp"
#include "render/sample_film.hpp"
#include "render/stage.hpp"
#include "render/wave_tables.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <deque>

namespace abbe::render {

struct FanInterface;
struct Meeting;
class FanShadows;

/// Counts of one thread, added up for the report.
struct RayCounts {
  std::uint64_t camera = 0, reflected = 0, refracted = 0, monochromatic = 0, shadow = 0;
  std::uint64_t splits = 0; ///< refractions of a polychromatic ray into monochromatic ones
  void add(RayCounts const& other);
  void subtract(RayCounts const& other);
  std::uint64_t total() const { return camera + reflected + refracted + monochromatic + shadow; }
};

/// Traces the paths of camera samples; one per thread. Throughput is carried from the camera on, so
/// that a path that can add nothing more is dropped, and light is added to the sample's film where
/// it is met.
class Tracer {
public:
  /// @param footprint of a pixel of the picture
  explicit Tracer(Stage const& stage, Footprint footprint = {});

  /// Light arriving along a camera ray. @param bands one value a channel, or empty
  Vec3 sample(geometry::Ray const& ray, SampleKey key, std::span<double> bands);
  /// Can samples be traced together? Not where solids displace each other or are not closed.
  bool together() const { return together_; }
  /// sample() for neighbouring camera rays, with the same bits: at most fan_width of them, filled
  /// up, a key each. The light is asked for by light_of(). @pre together()
  void samples(geometry::FanLines const& rays, std::span<SampleKey const> keys);
  Vec3 light_of(std::size_t sample, std::span<double> bands) {
    return film_.resolve(sample, waves_, bands);
  }
  /// What was cut of its light.
  double lost_of(std::size_t sample) const {
    Vec3 const& lost = cut_here_[sample];
    return std::max({lost.x, lost.y, lost.z});
  }
  /// Is the light of one of the last samples finite, and not negative where that is wrong?
  std::optional<BadSample::Kind> wrong(std::size_t sample, Vec3 const& rgb,
                                       bool negative_is_wrong) const {
    return what_is_wrong(film_.light(sample), rgb, negative_is_wrong);
  }

  RayCounts const& counts() const { return counts_; }
  CutLight const& cut_light() const { return cut_; }

  /// Tells this recorder of every ray from now on. @pre no sample was traced yet
  void record(PathRecorder& recorder) {
    recorder_ = &recorder;
    together_ = false;
  }

private:
  friend class PathRecorder;
  friend class Route;
  template <int Lanes>
  friend class Shader;
  friend class FanShadows;
  struct Frame {
    geometry::HitGroup hit;
    geometry::Departure through, back, shadow;
    std::deque<geometry::HitGroup> groups; ///< of a fan's rays that meet several surfaces at once
  };
  /// By ray of a fan; null: it meets one surface, or nothing.
  using FanGroups = std::array<geometry::HitGroup const*, geometry::fan_width>;

  // tracer.cpp
  /// The light of some samples as it leaves the camera.
  Beam start_samples(std::span<SampleKey const> keys);
  void trace(PathRay const& ray, Beam const& beam);
  /// Notes a beam that is not followed.
  void cut(Beam const& beam, int lanes);
  /// The throughput of a beam is lost, or may be. @return false: nothing that can be seen
  bool cut_light_of(Beam const& beam, int lanes);
  /// Ends a sample: the light that it lost.
  void count_cut(double lost);
  void add_background(Vec3 const& direction, Beam const& beam);
  void absorb(Beam& beam, Medium const& medium, double distance);
  /// The same for the rays of a fan, each over its own distance.
  void absorb_fan(Beam& beam, Medium const& medium, double const* distances, int lanes_each);
  /// Absorbs along the ray up to `distance` (infinite: it escapes). Solids that leak end at their
  /// bounds, and a ray that escapes has left all that are bounded. @return what it is inside of
  /// then
  InsideNode const* travel(PathRay const& ray, double distance, Beam& beam);
  InsideNode const* without(InsideNode const* inside, geometry::SolidId solid);
  /// The solid whose medium counts: of the highest priority, the last entered.
  InsideNode const* ruling(InsideNode const* inside) const;
  /// Takes out of the hit the surfaces that lie where a medium of higher priority displaces theirs.
  void drop_displaced(InsideNode const* before, InsideNode const* after,
                      geometry::HitGroup& hit) const;
  InsideNode const* entered(InsideNode const* inside, geometry::SolidId solid);
  InsideNode const* after_crossings(InsideNode const* inside, geometry::HitGroup const& hit);
  /// Of the solids that their surface does not enclose (CompiledSolid::open).
  InsideNode const* after_open_crossings(InsideNode const* inside, geometry::HitGroup const& hit);
  InsideNode const* inside_at(Vec3 const& point);
  int medium_of(InsideNode const* inside) const;
  double index_of(int medium, Beam const& beam);

  /// The rest of trace(): what the ray met is in `frame`, or it `found` nothing.
  void arrive(PathRay const& ray, Beam const& incoming, Frame& frame, bool found);

  // tracer_fan.cpp
  /// What trace() does for each ray of a fan, with the same bits, and most of the work once for
  /// all.
  void trace_fan(FanRay const& fan, Beam const& beam);
  /// Traces those rays whose throughput is not to be cut, counted as `kind`.
  /// @param lines the fan's, to be filled up
  void trace_lanes(FanRay const& fan, geometry::FanLines& lines, Beam const& beam,
                   std::uint64_t& kind);
  /// Rays of a fan, next to each other, that met the same surfaces.
  void interact_run(FanRay const& fan, Beam const& beam, geometry::FanHits const& hits,
                    FanGroups const* groups, std::size_t first, std::size_t count, Frame& frame);
  /// The same where fan_normals() knows the normals, which are in `met`. @return false, with
  /// nothing done, where each ray has to go alone
  /// @param group of the first, or null
  bool interact_fan(FanRay const& fan, Beam const& beam, geometry::FanHits const& hits,
                    geometry::HitGroup const* group, FanInterface& met, Frame& frame);
  /// The media beyond a surface, and how the light is to be split there.
  void find_split(FanRay const& fan, Beam const& incoming, InsideNode const* after,
                  LaneInterface& face);
  /// Where a fan met a surface: what the rest of its way needs.
  struct FanMet {
    FanRay const& fan;
    geometry::FanHits const& hits;
    FanInterface const& met;
    InsideNode const* after;
    Frame& here;
  };
  /// What the surface returns and what goes on of the light, and its way from there.
  void share_and_go_on(FanMet const& at, Beam& through, LaneInterface& face);
  /// What a surface returns of the light, and leaves of it. @return what its textures let pass,
  /// a lane; null: all
  double* share(FanMet const& at, Beam& light, LaneInterface& face, double* returns);
  /// The same where it has textures. @param face its arrays have the lanes of all
  double* share_textured(FanMet const& at, Beam& light, LaneInterface& face, double* returns);
  void go_on(FanMet const& at, Beam const& back, Beam const& through, LaneInterface& face,
             SplitWays const& ways);

  // tracer_fan_split.cpp
  /// Fresnel and Snell of each lane of rays that are split: LaneInterface's arrays.
  SplitWays meet_split(FanMet const& at, Beam const& beam, LaneInterface& face);
  /// split() for the rays of a fan: what `passed` goes on a ray a lane.
  void split_fan(FanMet const& at, Beam const& passed, LaneInterface const& face,
                 SplitWays const& ways);
  /// meet_comb() for the rays of a fan. @pre the surface does not mirror by `reflection`
  void meet_comb_fan(FanMet const& at, Beam const& light, LaneInterface& face);

  // tracer_fan_groups.cpp
  /// Where rays meet several surfaces at once: their hits become that of the surface shown.
  /// @param t_max by ray; null: infinite @param here keeps the groups
  /// @return false where nothing is: then nothing is written
  bool find_groups(FanRay const& fan, double const* t_max, geometry::FanHits& hits, Frame& here,
                   FanGroups& groups);
  /// Do two rays meet the same surfaces? @param groups null: there are none
  static bool same_hit(geometry::FanHits const& hits, FanGroups const* groups, std::size_t a,
                       std::size_t b) {
    return hits.hit[a] == hits.hit[b]
           && (groups == nullptr || same_group((*groups)[a], (*groups)[b]));
  }
  static bool same_group(geometry::HitGroup const* a, geometry::HitGroup const* b);

  /// The surface's normals at the hits; false where they are not the geometric ones.
  bool fan_normals(geometry::FanHits const& hits, std::size_t count, geometry::FanVectors& out);
  /// Of a medium, for each ray of a fan; whole lanes.
  void find_indices(Medium const& medium, int number, Beam const& beam, std::size_t rays,
                    double* out);

  // tracer_interface.cpp
  void interact(PathRay const& ray, Beam& beam, Frame& frame);
  /// The textures at the hit (shader.hpp).
  LaneSurface shade(PathRay const& ray, Beam const& beam, Frame& frame, LaneInterface const& face,
                    InsideNode const* after);
  /// The same for all rays of a fan. @param shadows null for a ray alone
  FanSurface shade_met(Meeting const& met, Beam const& beam, Frame& frame, InsideNode const* inside,
                       InsideNode const* after, FanShadows* shadows);
  /// Goes straight on where all surfaces of the hit are displaced.
  void pass(PathRay const& ray, Beam const& beam, Frame& frame, InsideNode const* after);
  void find_normals(PathRay const& ray, Frame& frame, LaneInterface& face);
  void find_interface(Beam const& beam, Vec3 const& direction, LaneInterface& face);
  void reflect(PathRay const& ray, Beam const& beam, Frame& frame, LaneInterface const& face,
               LaneSurface const& surface);
  static Vec3 mirrored_direction(Vec3 const& direction, LaneInterface const& face);
  void transmit(PathRay const& ray, Beam const& beam, Frame& frame, LaneInterface const& face,
                LaneSurface const& surface, InsideNode const* after);

  // tracer_bend.cpp
  /// Traces a mirrored beam whose light is raised to a power.
  void reflect_bent(PathRay const& next, Beam const& mirrored, double exponent);
  void bend(PathRay const& next, Beam const& mirrored, double exponent);
  /// Where light of a lane of a picking comb goes once it is picked.
  struct Picked {
    std::uint32_t slot = 0;
    double weight = 1;  ///< 1 / probability
    bool counts = true; ///< this tooth was picked, or all are (control light)
  };
  std::optional<Picked> pick_of(Beam const& beam, int lane);

  // tracer_split.cpp
  void split(PathRay const& ray, Beam const& beam, Frame& frame, LaneInterface const& face,
             InsideNode const* after);
  /// Each lane of a split beam on its own way.
  void send_apart(SplitStart const& start, Beam const& beam, SplitWays const& ways);
  /// A split in the published scheme: lane by lane, as each becomes two.
  void split_doubled(PathRay const& ray, Beam const& beam, Frame& frame, LaneInterface const& face,
                     InsideNode const* after);
  /// The same where one tooth of a comb goes on for all of a ray.
  void send_picked(SplitStart const& start, Beam const& beam, SplitWays const& ways);
  /// Lanes go together where their neighbours' routes agree within the tolerance.
  void split_adaptively(SplitStart const& start, Beam const& beam, SplitWays const& ways,
                        double tolerance_px);
  struct AdaptiveSplit;
  /// Has a route told of every ray, as long as it lives.
  struct Watch {
    Watch(Tracer& tracer, Route& route) : tracer_(tracer) {
      tracer_.route_ = &route;
      tracer_.ready_frames_ = 0;
    }
    ~Watch() {
      tracer_.route_->end(tracer_);
      tracer_.route_ = nullptr;
    }
    Watch(Watch const&) = delete;
    Watch& operator=(Watch const&) = delete;
    Tracer& tracer_;
  };
  /// A beam that no comb has split meets its first stochastic material: its teeth, and the control
  /// light that goes with them, on slots of their own.
  void meet_comb(PathRay const& ray, Beam const& beam, Frame& frame, LaneInterface const& face,
                 InsideNode const* after);
  /// The beam of so many rays with a lane a tooth.
  Beam combed(Beam const& beam, int comb, int rays);
  /// The published scheme: every lane becomes two, of the bands that its wavelength falls between.
  Beam doubled(Beam const& beam, int comb);
  std::uint32_t const* control_slots(Beam const& control);
  std::uint32_t const* picked_control_slots(Beam const& control);
  /// Of whose light a beam is: of its first lane.
  std::size_t sample_of(Beam const& beam) const { return film_.sample_of(beam.slot[0]); }
  /// The beam, its light to be lost.
  Beam unlit(Beam const& beam);

  /// Where a ray of this depth keeps what it meets.
  Frame& frame(int depth, PathRay const& ray, Beam const& beam) {
    if (depth >= ready_frames_) prepare_frame(depth, ray, beam);
    return frames_[static_cast<std::size_t>(depth)];
  }
  /// Makes frames as they are needed; with a recorder or a route, none is ever ready without its
  /// knowing.
  void prepare_frame(int depth, PathRay const& ray, Beam const& beam);

  Stage const& stage_;
  Footprint footprint_;
  Arena arena_;
  geometry::ScratchPtr scratch_;
  std::deque<Frame> frames_;
  int ready_frames_ = 0;
  PathRecorder* recorder_ = nullptr;
  Route* route_ = nullptr;
  std::deque<Route> routes_;
  int depth_ = 0;
  WaveTables waves_;
  SampleFilm film_;
  double* out_ =
      nullptr; ///< where light is added: the film, or a capture for `reflection exponent`
  std::size_t out_size_ = 0;
  bool together_ = false;
  // Of polychromatic beams: a lane a channel of the first sample, then of the next.
  std::vector<std::uint16_t> all_channels_;
  std::vector<std::uint32_t> all_slots_;
  InsideNode const* camera_inside_ = nullptr;
  Arena camera_arena_;
  RayCounts counts_;
  CutLight cut_;
  Vec3 cut_here_[geometry::fan_width]{}; ///< of the current samples
  double* cut_slots_ = nullptr;          ///< in a capture: by slot instead
};

} // namespace abbe::render

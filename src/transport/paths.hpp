// SPDX-License-Identifier: MIT
#pragma once

#include "transport/cameras/camera.hpp"
#include "transport/path_record.hpp"
#include "transport/rays.hpp"
#include "transport/stage.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace abbe::transport {

/// Where a monochromatic ray and all that came of it went: two wavelengths whose routes agree can
/// share one.
struct Route {
  struct Visit {
    std::uint64_t code = 0; ///< of the place in the tree of rays
    bool met = false;
    double share = 1; ///< of the light that started
    geometry::PrimitiveId primitive{};
    Vec3 direction{0};
    Vec3 point{0};
  };
  double light = 0; ///< throughput of the ray that started
  std::vector<Visit> visits;

  /// How far apart both went, at most, in pixels: of rays with a share of the light, times that
  /// share, for so much a displacement changes what is seen. Infinite where they met different
  /// surfaces. @param sky rays that met nothing count by their directions
  double apart_px(Route const& other, Footprint const& footprint, bool sky) const;
};

/// Knows of rays where they came from: of those whose route is asked for, and of all while a sample
/// is recorded.
class Paths {
public:
  using Id = std::uint32_t;
  static constexpr Id none = static_cast<Id>(-1);

  /// @param record is told of every ray; or null
  explicit Paths(Stage const& stage, PathRecord* record = nullptr)
      : stage_(stage), record_(record) {}
  /// Forgets all.
  void start() {
    paths_.clear();
    routes_.clear();
  }
  bool records() const { return record_ != nullptr; }

  /// The route of a ray that is to start with so much light, which carries the path from then on.
  /// @param from path of what it comes of
  struct Started {
    Id path;
    std::uint32_t route;
  };
  Started start_route(Id from, double light);
  /// The visits in an order that does not depend on how they came.
  Route const& finished(std::uint32_t route);

  /// A ray meets something, or nothing. @param from path that it carries @return the one that goes
  /// on from there
  struct Arrival {
    bool met;
    Vec3 direction, point;           ///< relative to the camera
    geometry::PrimitiveId primitive; ///< shown
    geometry::PrimitiveId member;    ///< the first of the hit's
  };
  Id arrive(Id from, bool through, LightKind const& kind, double const* light, double lambda_nm,
            Arrival const& arrival);
  /// Light is added to the film by what the path met.
  /// @pre records()
  void add(Id path, double light, bool to_sample) {
    record_->add(paths_[path].record, light, to_sample);
  }

private:
  struct Path {
    std::uint32_t route = none;
    std::uint64_t code = 0;
    std::uint32_t record = PathRecord::none; ///< number there
  };
  Stage const& stage_;
  PathRecord* record_;
  std::vector<Path> paths_;
  std::vector<Route> routes_;
};

} // namespace abbe::transport

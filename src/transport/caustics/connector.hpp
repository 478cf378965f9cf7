// SPDX-License-Identifier: MIT
#pragma once

#include "transport/caustics/caustics.hpp"
#include "transport/caustics/forced.hpp"

#include <span>

namespace abbe::transport::caustics {

/// A place that light is wanted at.
struct LitPlace {
  Vec3 point{0};
  Vec3 point_error{0};
  Vec3 geometric{0};        ///< normal of its surface, on the side of `start` that is not through
  geometry::RayStart start; ///< that rays from it have, but for RayStart::through
};

/// One wavelength that is asked for at a place.
struct Ask {
  std::uint32_t place = 0;
  int wave = Waves::whole;
  double weight = 0;                 ///< Caustics::place_of
  std::uint32_t first = 0, last = 0; ///< among the lists of sheets
};

/// A ray of the lamp that comes there.
struct Root {
  std::uint32_t ask = 0, sheet = 0;
  int chain = 0;
  bool turned = false; ///< the map turns the picture round
  /// The real ray makes this chain and comes there; false: something is in its way, or a surface
  /// ends before it.
  bool real = false;
  double spread = 0;            ///< |J|: area across the ray a unit of the emission
  double flux = 0;              ///< of the lamp, a unit of the emission; but for what surfaces took
  double way = 0, distance = 0; ///< to the last surface, and from it
  double share = 0;             ///< that surfaces left of the light; of sheets that are certain
  std::array<double, most_absorbing> inside{}; ///< and its ways in Chain::absorbing
  Vec3 direction{0};                           ///< unit, of the light
  Vec3 name{0};                                ///< Emission::name
};

/// Finds all rays of a lamp that come to places, of the chains of its sheets: guesses from the
/// nodes of sheets, Newton's iteration on rays along the chain, and at last the real ray, which has
/// to make the same chain, and the sight from its last surface.
class Connector {
public:
  Connector(Stage const& stage, Caustics const& caustics, Waves const& waves);

  /// Asks with the lanes that each wants light in.
  struct Asks {
    std::vector<Ask> asks;
    std::vector<SheetIndex::Over> sheets; ///< lists
    std::size_t each = 1;
    bool in_order = false;
    std::vector<std::uint16_t> channels; ///< a lane
    void clear() {
      asks.clear();
      sheets.clear();
      channels.clear();
    }
  };
  /// @param roots by ask, then by sheet and guess
  /// @param light what surfaces and media left, a value a lane of each root
  void find(std::size_t lamp, std::vector<LitPlace> const& places, geometry::Groups const& groups,
            Asks const& asks, std::vector<Root>& roots, std::vector<double>& light);

private:
  struct Task {
    std::uint32_t ask, sheet;
    Vec2 u{0}, step{0};
    double rest = 0; ///< how far the ray passes by
    int turns = 0, slow = 0, halved = 0;
    /// Measured: found, with its root.
    enum class State : std::uint8_t { Going, Found, Measured, Lost } state = State::Going;
    Root root;
  };
  void guess(Sheet const& sheet, std::uint32_t ask, std::uint32_t number, Vec3 const& point,
             double weight);
  /// Newton's iteration on the polynomials of a sheet, for tasks that were last added.
  void solve(Sheet const& sheet, BeamMap const& map, std::size_t first, Vec3 const& point,
             double weight);
  void iterate();
  void advance(Task& task, std::size_t first, std::array<double, 2> const& h);
  void own();
  void measure();
  void drop_twins();
  void verify(Asks const& asks, std::vector<Root>& roots, std::vector<double>& light);
  /// The real rays from the lamp to the last surface, where sheets are not certain.
  /// @param light a value a lane of each that makes its chain
  void follow_real(Asks const& asks, std::vector<std::uint32_t> const& of,
                   std::vector<std::uint8_t>& real, double* light);
  /// Takes those out of the real ones that are not seen from their place.
  /// @param of numbers of tasks
  void look_back(Asks const& asks, std::vector<std::uint32_t> const& of,
                 std::vector<std::uint8_t>& real);
  void strengths(std::vector<Root>& roots) const;
  std::array<double, 2> steps_of(Task const& task, double scale) const;
  void put(Task const& task, Vec2 const& u, std::size_t at);
  Sheet const& sheet_of(Task const& task) const { return of_->index.sheets()[task.sheet]; }
  Vec3 const& point_of(Task const& task) const {
    return (*places_)[asks_->asks[task.ask].place].point;
  }
  /// visit(first task, count) of those in a state, of one chain at a time, so many at most.
  template <class Visit>
  void by_chain(Task::State state, std::size_t most, Visit const& visit);

  Stage const& stage_;
  Caustics const& caustics_;
  Waves const& waves_;
  ForcedPaths forced_;
  LightPaths paths_;
  geometry::ScratchPtr scratch_;
  geometry::Hits hits_;
  ForcedRays rays_;
  std::vector<Task> tasks_;
  std::vector<std::uint32_t> order_;
  std::vector<LightPaths::Segment> segments_;
  std::vector<double> arrived_;
  // Of the question in work.
  std::size_t lamp_ = 0;
  Caustics::OfLamp const* of_ = nullptr;
  std::vector<LitPlace> const* places_ = nullptr;
  geometry::Groups const* groups_ = nullptr;
  Asks const* asks_ = nullptr;
};

} // namespace abbe::transport::caustics

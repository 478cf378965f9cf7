// SPDX-License-Identifier: MIT
#pragma once

#include "transport/caustics/connector.hpp"

#include <map>
#include <span>
#include <vector>

namespace abbe::transport::caustics {

/// Light that a lamp throws on a surface by way of glass and mirrors: as of a lamp that stands in
/// the direction that it comes from.
struct CausticLight {
  std::uint32_t lamp = 0;
  std::uint8_t ray = 0;      ///< of the chunk
  std::uint32_t turn = 0;    ///< number among the lights of its ray
  std::int32_t channel = -1; ///< in which it is; -1: a value for each lane of the ray
  Vec3 toward{0};            ///< unit
  double distance = 0;       ///< to the last surface
  double value = 0;          ///< of a channel
  std::uint32_t values = 0;  ///< place of the first lane's
  // What tells it from others, and what it is made of.
  int chain = 0;
  bool turned = false;
  Vec3 name{0};                                ///< Emission::name
  std::array<double, most_absorbing> inside{}; ///< its ways in Chain::absorbing
};

/// The caustic light on the surfaces of a chunk; one for each thread.
class CausticLights {
public:
  CausticLights(Stage const& stage, Caustics const& caustics);

  /// From now on, lights() are those on the surfaces of this chunk. @pre it stays as it is
  void look_at(Chunk const& chunk, geometry::Groups const& groups) {
    chunk_ = &chunk;
    groups_ = &groups;
    known_ = false;
  }
  /// By lamp; found when they are asked for first, and in an order that has the lights of different
  /// rays beside each other.
  std::vector<CausticLight> const& lights();
  double const* values(CausticLight const& light) const { return values_.data() + light.values; }

private:
  /// A piece of a band at a place, of one chain, between two wavelengths whose roots are known.
  struct Piece {
    std::uint32_t place;
    int chain;
    std::uint16_t channel;
    double share; ///< of the band
    int depth;
    double low_nm, high_nm;
    std::vector<Root> low, high; ///< with the light of both lanes in `flux` of this channel
  };
  void find();
  /// Of the lamp in work, on some of the chunk's rays.
  void find_on(std::span<std::uint8_t const> rays);
  /// Rays of one wavelength each from one ray of all, in the order of the spectrum: their light
  /// changes evenly from one to the next, where their places do.
  struct Tour {
    std::vector<std::uint8_t> rays;
    std::size_t step = 1; ///< every so many are known
    bool known(std::size_t k) const { return k % step == 0 || k + 1 == rays.size(); }
  };
  void find_tours();
  /// Lights on the rays of a tour that are not known, by those of the others. @return false: they
  /// are not even
  bool fill_in(Tour const& tour, std::span<std::vector<std::uint32_t> const> lights_of);
  /// What media leave of a light in a channel.
  double absorbed(CausticLight const& light, std::uint16_t channel) const;
  /// What of the spectrum the lanes of a ray stand for: Caustics::place_of.
  std::pair<double, double> spectrum_of(std::size_t ray) const;
  /// A wavelength that a place is asked at, with the channels below and above it.
  struct Stop {
    double nm;
    int wave;
    std::uint16_t below, above;
    bool later; ///< only where it is not even between its neighbours
  };
  /// Roots at a stop, with the light of the channel below it and of that above.
  struct Ends {
    std::vector<Root> below, above;
  };
  void find_whole();
  void find_bands();
  void find_stops(std::uint32_t place, std::vector<std::uint16_t> const& wanted);
  void ask_stop(std::uint32_t place, std::size_t stop, std::uint32_t first, std::uint32_t last);
  /// Asks, and puts the answers into found_.
  void take_roots();
  /// Roots at the stops that were left for later, by those of the others. @return false: they are
  /// not even
  bool fill_in(std::uint32_t place, std::vector<Ends>& found) const;
  void settle_all();
  /// Pairs roots at both ends. @return false: it has to be parted
  bool settle(Piece const& piece);
  void add(Piece const& piece, double value, Root const& root);
  /// Adds sheets over a place to the lists: of one chain, or of all (-1). @return the list's end
  std::uint32_t list_of(std::uint32_t place, int chain, bool disperses, bool coloured_only,
                        bool clear_only);
  Ask ask_of(std::uint32_t place, int wave, std::uint32_t first, std::uint32_t last) const;

  Stage const& stage_;
  Caustics const& caustics_;
  Waves waves_;
  Connector connector_;
  Connector::Asks asks_;
  std::vector<SheetIndex::Want> wants_;
  std::vector<LitPlace> places_;
  std::vector<std::uint8_t> ray_of_; ///< by place
  Chunk const* chunk_ = nullptr;
  geometry::Groups const* groups_ = nullptr;
  bool known_ = false;
  std::vector<std::vector<SheetIndex::Over>> over_; ///< by place: sheets whose beams may hold it
  std::size_t lamp_ = 0;
  std::vector<Tour> tours_;
  RaySet blocked_ = 0;                   ///< rays of the chunk that something keeps light from
  std::vector<std::vector<Stop>> stops_; ///< by place
  std::map<std::pair<std::uint32_t, int>, std::vector<Ends>> found_; ///< by place and chain
  std::vector<std::uint32_t> stop_of_ask_;
  std::vector<Root> roots_;
  std::vector<double> light_;
  std::vector<CausticLight> lights_;
  std::vector<double> values_;
};

} // namespace abbe::transport::caustics

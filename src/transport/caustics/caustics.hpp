// SPDX-License-Identifier: MIT
#pragma once

#include "transport/caustics/beam_map.hpp"
#include "transport/caustics/chain.hpp"
#include "transport/caustics/emission.hpp"
#include "transport/caustics/light_paths.hpp"
#include "transport/caustics/sheet_builder.hpp"
#include "transport/caustics/sheet_index.hpp"
#include "transport/caustics/waves.hpp"

#include <optional>
#include <vector>

/// The light that glass and mirrors throw: chains of refraction and reflection are found from the
/// lamp, and each shading point is connected to the lamp by Newton's iteration, on real rays or on
/// polynomials through them (docs/caustics.md).
namespace abbe::transport::caustics {

struct Settings {
  Limits limits;
  double error = 0.01;     ///< share of the flux that may be missing
  bool exact = false;      ///< each place is led to by real rays alone, without polynomials
  std::vector<bool> lamps; ///< by lamp: those whose light is followed
};

/// All that is known of a scene's caustics before the first point is shaded. Immutable.
class Caustics {
public:
  /// @pre stage.casts and stage.receives are set
  Caustics(Stage const& stage, Settings const& settings);

  struct OfLamp {
    std::optional<Emission> emission; ///< nullopt: its light is not followed
    SheetIndex index;
    std::vector<BeamMap> maps; ///< of its sheets
    Found found;
    int root_level = 0;
  };
  std::vector<OfLamp> const& lamps() const { return lamps_; }
  bool follows(std::size_t lamp) const { return lamps_[lamp].emission.has_value(); }
  ChainTable const& chains() const { return chains_; }
  Waves const& waves() const { return waves_; }
  Limits const& limits() const { return limits_; }

  /// What of the spectrum a channel of light is: from one wave to another, or one wave.
  struct Band {
    int low = Waves::whole, high = Waves::whole;
    double low_nm = 0, high_nm = 0;
  };
  /// By channel; empty where nothing disperses.
  std::vector<Band> const& bands() const { return bands_; }
  /// Where a wavelength is between the ends of the spectrum, as glass bends it: 0 .. 1.
  double place_of(double lambda_nm) const;
  double lambda_at(double place) const;
  /// Share of the flux onto casters that no sheet has, at most, of any lamp.
  double missing() const;

private:
  void add_waves(Stage const& stage);
  /// Sheets cut into pieces with maps.
  std::vector<Sheet> interpolated(Stage const& stage, std::vector<Sheet> const& sheets,
                                  OfLamp& own) const;
  Limits limits_;
  Waves waves_;
  ChainTable chains_;
  std::vector<Band> bands_;
  std::vector<int> spectrum_{Waves::whole}; ///< waves from one of its ends to the other, evenly
  std::vector<OfLamp> lamps_;
};

} // namespace abbe::transport::caustics

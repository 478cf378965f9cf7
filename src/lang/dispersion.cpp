// SPDX-License-Identifier: MIT
#include "lang/blocks.hpp"
#include "optics/bands.hpp"

#include <fmt/format.h>

#include <optional>

namespace abbe::lang {

namespace {

using optics::Comb;
using scene::DispersionMode;
using Follow = Comb::Follow;
using Jitter = Comb::Jitter;

/// The words of one `dispersion { }`, in any order after the mode's own.
class ModeReader {
public:
  explicit ModeReader(Reader& in) : in_(in) { mode_.span = in.block_span(); }

  DispersionMode read() {
    while (!in_.at_end()) {
      at_ = in_.next_span();
      if (!mode_word() && !option()) {
        reject(in_, "a dispersion mode");
        rejected_ = true;
      }
    }
    if (mode_.kind == DispersionMode::Kind::Inherit && !rejected_)
      error(
          "E0250",
          "dispersion {} needs a mode: none, deterministic, adaptive, stochastic, clusters or hero",
          mode_.span);
    if (mode_.comb.jitter == Jitter::Triangular && mode_.comb.teeth > 0)
      error("E0252",
            "triangular jitter draws from the hat functions of the bands: it goes with one ray a "
            "band",
            jitter_at_);
    return mode_;
  }

private:
  bool mode_word() {
    using Kind = DispersionMode::Kind;
    if (in_.accept("none")) return set("none", Kind::None);
    if (in_.accept("deterministic")) return set("deterministic", Kind::Deterministic);
    if (in_.accept("adaptive")) return set("adaptive", Kind::Adaptive);
    if (in_.accept("stochastic")) return set("stochastic", Kind::Stochastic);
    if (in_.accept("clusters")) {
      mode_.comb.teeth = teeth("wavelengths of a cluster");
      return set("clusters", Kind::Stochastic);
    }
    if (in_.accept("hero")) {
      mode_.comb.teeth = in_.has_value() ? teeth("wavelengths of a hero's company") : 4;
      mode_.comb.follow = Follow::Hero;
      return set("hero", Kind::Stochastic);
    }
    return false;
  }

  bool option() {
    if (in_.accept("faithful")) {
      if (mode_.kind == DispersionMode::Kind::Inherit)
        set("stochastic", DispersionMode::Kind::Stochastic);
      belongs("faithful", "stochastic");
      mode_.comb.follow = Follow::Doubled;
    } else if (in_.accept("fanout")) {
      belongs("fanout", "stochastic");
      mode_.comb.follow = in_.integer("fan-out", 1, 2) == 2 ? Follow::Doubled : Follow::Every;
    } else if (in_.accept("rays")) {
      belongs("rays", "stochastic");
      mode_.comb.teeth = teeth("rays of a split");
    } else if (in_.accept("split")) {
      belongs("split", "clusters");
    } else if (in_.accept("degrade")) {
      belongs("degrade", "clusters");
      mode_.comb.follow = Follow::Importance;
    } else if (in_.accept("tolerance")) {
      belongs("tolerance", "adaptive");
      tolerance();
    } else if (in_.accept("jitter")) {
      jitter();
    } else {
      return false;
    }
    if (mode_.comb.follow == Follow::Doubled && mode_.comb.teeth > 0)
      error(
          "E0252",
          "'rays' has no meaning with a fan-out of 2: each ray becomes two, of neighbouring bands",
          at_);
    return true;
  }

  bool set(std::string_view word, DispersionMode::Kind kind) {
    if (!word_.empty())
      error("E0252",
            fmt::format("'{}' after '{}': a material has one dispersion mode", word, word_), at_);
    word_ = word;
    mode_.kind = kind;
    return true;
  }

  int teeth(std::string_view what) { return in_.integer(what, 1, optics::Bands::max_count); }

  void belongs(std::string_view option, std::string_view owner) {
    if (word_ != owner) error("E0252", fmt::format("'{}' belongs to '{}'", option, owner), at_);
  }

  void tolerance() {
    double const pixels = in_.number("tolerance in pixels");
    if (pixels >= 0)
      mode_.tolerance_px = pixels;
    else
      error("E0353", fmt::format("the tolerance must not be negative: {} pixels", pixels), at_);
  }

  /// `jitter uniform 1.0`: distribution and width in strata.
  void jitter() {
    jitter_at_ = at_;
    if (mode_.kind != DispersionMode::Kind::Stochastic)
      error("E0252", "'jitter' belongs to 'stochastic', 'clusters' and 'hero'", at_);
    for (std::size_t i = 0; i < optics::jitter_words.size(); ++i)
      if (in_.accept(optics::jitter_words[i])) {
        mode_.comb.jitter = static_cast<Jitter>(i);
        break;
      }
    Span const at = in_.next_span();
    auto const width = in_.optional_number("jitter width in bands");
    if (!width) {
      // The hat reaches over two bands.
      if (mode_.comb.jitter == Jitter::Triangular) mode_.comb.width = 2;
      return;
    }
    if (*width >= 0 && *width <= 1000)
      mode_.comb.width = *width;
    else
      error("E0353", fmt::format("the jitter's width must be 0 to 1000 bands, not {}", *width), at);
  }

  void error(std::string_view code, std::string_view message, Span at) {
    in_.report(Severity::Error, code, message, at);
  }

  Reader& in_;
  DispersionMode mode_;
  std::string_view word_;
  Span at_, jitter_at_;
  bool rejected_ = false;
};

} // namespace

scene::DispersionMode read_dispersion_mode(Reader& in) {
  return ModeReader(in).read();
}

} // namespace abbe::lang

// SPDX-License-Identifier: MIT
#include "transport/segments/absorption.hpp"
#include "transport/segments/fade.hpp"

namespace abbe::transport {

Segments make_segments(scene::Interior const& interior, surface::Channels absorption,
                       surface::Channels fade_colour, bool fades) {
  Segments out;
  if (!absorption.empty()) out.push_back(std::make_unique<Absorption>(std::move(absorption)));
  if (fades && interior.fade_distance != 0)
    out.push_back(std::make_unique<Fade>(interior.fade_distance, interior.fade_power,
                                         std::move(fade_colour)));
  return out;
}

} // namespace abbe::transport

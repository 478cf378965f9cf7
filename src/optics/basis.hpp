// SPDX-License-Identifier: MIT
#pragma once

#include "optics/channel_set.hpp"

namespace abbe::optics {

/// Which few bands of a grid, with which weights, give the colours of a family of lights.
///
/// The k strongest directions of the family (singular vectors, weighted by what the eye sees; the
/// flat light of white first, which stays exact) are a basis in Peercy's sense. Light in it is told
/// by its values at k wavelengths, chosen so that this is well conditioned (pivoted QR), and the
/// colour of light in its span is a weighted sum of those values. Products stay products of
/// numbers, so a product of light and reflectances costs k multiplications where coefficients would
/// need a matrix, and each channel has a wavelength that a prism can refract.
///
/// Where light is dispersed, each wavelength goes another way, and what reaches a pixel is no light
/// of the family but the part of one on one side of an edge, or between two. Their own directions
/// do not span these: so `parted` adds the parts of white that lie below each band's edge, with as
/// much weight as the whole family. They span all bands, so that a basis of as many channels as
/// there are bands is those bands.
/// @param family values of lights on all bands, relative to D65
/// @param size at most the number of bands; fewer channels come back when the family has no more
///        directions
/// @source M. S. Peercy, Linear color representations for full spectral rendering, SIGGRAPH 1993
ChannelSet choose_basis(Bands const& grid, std::vector<std::vector<double>> const& family, int size,
                        bool parted);

} // namespace abbe::optics

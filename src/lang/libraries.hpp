// SPDX-License-Identifier: MIT
#pragma once

#include "lang/blocks.hpp"
#include "optics/data_library.hpp"

/// The data that comes with abbe, opened when a scene first names something out of it.
namespace abbe::lang {

/// stdlib/glass or stdlib/spectra; null (reported at `at`) when it cannot be read.
optics::DataLibrary const* glass_library(Reader&, Span at);
optics::DataLibrary const* spectra_library(Reader&, Span at);

/// `"Au"` out of stdlib/spectra; null after an error, which is reported.
std::shared_ptr<optics::Conductor const> read_metal(Reader&);

} // namespace abbe::lang

// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>

namespace abbe::job {

/// From now on SIGINT (Ctrl-C) and SIGTERM set interrupted(), which a job's `stop` may point to.
/// The second of them ends the process at once, with status 130; files that are being written
/// (image/atomic_file.hpp) are removed.
void catch_interrupts();

/// Was there one? It stays set.
std::atomic<bool> const& interrupted();

} // namespace abbe::job

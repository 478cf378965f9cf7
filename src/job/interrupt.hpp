// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>

namespace abbe::job {

/// From now on SIGINT (Ctrl-C) and SIGTERM set interrupted(), which a job's `stop` may point to.
/// What does not look at it is not waited for: the process ends by itself within a second, wherever
/// it is, and at once when it is told a second time. Files that are being written
/// (image/atomic_file.hpp) are then removed; a checkpoint keeps its finished tiles.
void catch_interrupts();

/// The process is interrupted so many seconds from now. @pre catch_interrupts()
void limit_time(double seconds);

/// Was there one? It stays set.
std::atomic<bool> const& interrupted();

/// The exit status of a process that was: 130 by SIGINT, 143 by SIGTERM, 124 by limit_time().
int interrupted_status();

} // namespace abbe::job

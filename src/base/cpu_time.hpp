// SPDX-License-Identifier: MIT
#pragma once

namespace abbe {

/// Processor seconds that this process took so far, of all threads, in user and system mode.
double process_cpu_s();

} // namespace abbe

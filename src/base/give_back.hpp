// SPDX-License-Identifier: MIT
#pragma once

namespace abbe {

/// Lets the system have whole pages of freed memory that lie between others in use. Changes nothing
/// but how much memory the process holds; for where very much was freed and more of another kind is
/// to come. (glibc; elsewhere it does nothing.)
void give_back_memory();

} // namespace abbe

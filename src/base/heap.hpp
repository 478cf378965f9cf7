// SPDX-License-Identifier: MIT
#pragma once

/// What changes how much memory the process holds and what that costs, and nothing else. (glibc;
/// elsewhere these do nothing.)
namespace abbe {

/// One heap for all threads: to be said before the first is started. A heap of a thread's own grows
/// page by page, a system call each, which is a twentieth of the time of a scene with a million
/// objects; and no thread allocates so often that it would wait for another.
void use_one_heap();

/// Lets the system have whole pages of freed memory that lie between others in use; for where very
/// much was freed and more of another kind is to come.
void give_back_memory();

} // namespace abbe

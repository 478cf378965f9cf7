// SPDX-License-Identifier: MIT
#pragma once

#include <string>

/// What bounds a run from outside its scene.
namespace abbe::cli {

/// What does not fit in memory would page without end, or be killed without a word: a failed
/// allocation can be reported with its place. An eighth is left for the rest of the machine.
void limit_memory_to_machine();

/// "512M", "2G" or a number of bytes; K, M, G and T are powers of 1024. From now on allocations
/// fail beyond it. @return what is wrong, empty: nothing
std::string limit_memory(std::string const& text);

/// Descriptors 0, 1 and 2 are never those of a file: where one is closed, what is written to it is
/// refused as before.
void occupy_standard_files();

} // namespace abbe::cli

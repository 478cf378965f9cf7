// SPDX-License-Identifier: MIT
#pragma once

#include <string>

/// These functions bound a run from outside its scene.
namespace abbe::cli {

/// Makes allocations fail beyond seven eighths of the machine's memory: a failed one can be
/// reported with its place, while a run that does not fit would page without end or be killed
/// without a word.
void limit_memory_to_machine();

/// "512M", "2G" or a number of bytes; K, M, G and T are powers of 1024. From now on allocations
/// fail beyond it. @return what is wrong, empty: nothing
std::string limit_memory(std::string const& text);

/// Descriptors 0, 1 and 2 are never those of a file: where one is closed, what is written to it is
/// refused as before.
void occupy_standard_files();

} // namespace abbe::cli

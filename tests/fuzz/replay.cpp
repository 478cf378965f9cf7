// SPDX-License-Identifier: MIT
// Runs a fuzzer's entry without libFuzzer: `replay_X FILE-OR-FOLDER... [--mutants N]` on each file,
// and on N mutants of each from a fixed seed. $ABBE_FUZZ_KEEP names a file for the input at hand.
#include "base/random.hpp"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size);
extern "C" __attribute__((weak)) std::size_t
LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most, unsigned seed);

namespace {

namespace fs = std::filesystem;
using Bytes = std::vector<std::uint8_t>;

abbe::RandomKey key;
std::uint64_t drawn = 0;
std::size_t below(std::size_t n) {
  return n == 0 ? 0 : static_cast<std::size_t>(key.child(drawn++).bits() % n);
}

Bytes read(fs::path const& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

void run(Bytes const& input) {
  if (char const* const keep = std::getenv("ABBE_FUZZ_KEEP"))
    std::ofstream(keep, std::ios::binary)
        .write(reinterpret_cast<char const*>(input.data()),
               static_cast<std::streamsize>(input.size()));
  LLVMFuzzerTestOneInput(input.data(), input.size());
}

} // namespace

/// One small change: a bit, a byte, a number of four bytes, a piece left out, moved or doubled.
extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most) {
  if (size == 0) return 0;
  std::size_t const at = below(size), length = std::min(below(64) + 1, size - at);
  switch (below(6)) {
  case 0:
    data[at] = static_cast<std::uint8_t>(data[at] ^ (1 << below(8)));
    return size;
  case 1:
    data[at] = static_cast<std::uint8_t>(below(256));
    return size;
  case 2: {
    constexpr std::uint32_t strange[] = {0, 1, 0x7f, 0xff, 0x7fff, 0xffff, 0x7fffffff, 0xffffffff};
    std::uint32_t const number = strange[below(std::size(strange))];
    std::memcpy(data + at, &number, std::min<std::size_t>(4, size - at));
    return size;
  }
  case 3:
    std::memmove(data + at, data + at + length, size - at - length);
    return size - length;
  case 4:
    std::memmove(data + below(size - length + 1), data + at, length);
    return size;
  default:
    if (size + length > most) return at; // cut off instead
    std::memmove(data + at + length, data + at, size - at);
    return size + length;
  }
}

int main(int count, char** words) {
  std::vector<fs::path> files;
  std::size_t mutants = 0, runs = 0;
  for (int i = 1; i < count; ++i) {
    if (std::strcmp(words[i], "--mutants") == 0 && i + 1 < count)
      mutants = std::strtoul(words[++i], nullptr, 10);
    else if (fs::is_directory(words[i]))
      for (auto const& entry : fs::directory_iterator(words[i])) files.push_back(entry.path());
    else
      files.emplace_back(words[i]);
  }
  std::sort(files.begin(), files.end());
  if (files.empty()) {
    std::fprintf(stderr, "replay: no files\n");
    return 2;
  }
  for (auto const& file : files) {
    Bytes const original = read(file);
    key = abbe::RandomKey(runs);
    for (std::size_t round = 0; round <= mutants; ++round, ++runs) {
      Bytes input = original;
      std::size_t size = input.size();
      input.resize(2 * size + 64);
      for (std::size_t n = round == 0 ? 0 : below(4) + 1; n > 0; --n)
        size = LLVMFuzzerCustomMutator ? LLVMFuzzerCustomMutator(input.data(), size, input.size(),
                                                                 static_cast<unsigned>(below(8)))
                                       : LLVMFuzzerMutate(input.data(), size, input.size());
      input.resize(size);
      run(input);
    }
  }
  std::printf("%zu inputs from %zu files\n", runs, files.size());
  return 0;
}

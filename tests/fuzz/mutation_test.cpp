// SPDX-License-Identifier: MIT
// Mutates scenes with a fixed seed and evaluates them: `mutations [--seed S] [--rounds N]
// [--seconds T]`. A crash ends the program; its last line names the scene, seed and round, and
// $ABBE_FUZZ_KEEP names a file in which the mutant is kept. Status 1: a message without a place, or
// a scene that cannot be stopped.
#include "base/random.hpp"
#include "evaluate_limited.hpp"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <sstream>

namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

struct Scene {
  fs::path path;
  std::string text;
};

std::vector<Scene> corpus() {
  std::vector<Scene> scenes;
  for (char const* folder : {"examples", "tests/golden/parse", "tests/golden/error",
                             "tests/golden/eval", "tests/cli/bad"}) {
    fs::path const whole = fs::path(ABBE_SOURCE_DIR) / folder;
    if (!fs::is_directory(whole)) continue;
    for (auto const& entry : fs::directory_iterator(whole)) {
      if (entry.path().extension() != ".scn" || entry.file_size() > 20000) continue;
      std::ifstream in(entry.path(), std::ios::binary);
      std::ostringstream text;
      text << in.rdbuf();
      scenes.push_back({entry.path(), std::move(text).str()});
    }
  }
  std::sort(scenes.begin(), scenes.end(),
            [](Scene const& a, Scene const& b) { return a.path < b.path; });
  return scenes;
}

/// The random choices of one mutant.
class Choice {
public:
  explicit Choice(abbe::RandomKey key) : key_(key) {}
  std::size_t below(std::size_t n) {
    return n == 0 ? 0 : static_cast<std::size_t>(key_.child(count_++).bits() % n);
  }

private:
  abbe::RandomKey key_;
  std::uint64_t count_ = 0;
};

/// What breaks readers: brackets, ends, huge and strange numbers, words out of place.
constexpr std::string_view tokens[] = {
    "{",          "}",          "(",          ")",        "<",          ">",         ",",
    ";",          "[",          "]",          "\"",       "#end",       "#if (1)",   "#else",
    "#declare",   "#while (0)", "#macro M()", "#break",   "#local",     "/*",        "*/",
    "//",         "-",          "1e308",      "1e308*10", "1e-320",     "0",         "-1",
    "1000000000", "0.5",        "x",          "rgb",      "sphere",     "union",     "difference",
    "interior",   "glass",      "spectrum",   "texture",  "pigment",    "transform", "array[2]",
    "function",   "inverse",    "\0",         "\xff",     "image_width"};

void mutate(std::string& text, std::string const& other, Choice& choose) {
  std::size_t const at = choose.below(text.size() + 1);
  std::size_t const length = choose.below(choose.below(2) ? 8 : 200);
  switch (choose.below(8)) {
  case 0: // a bit
    if (at < text.size()) text[at] = static_cast<char>(text[at] ^ (1 << choose.below(8)));
    break;
  case 1: // a byte
    if (at < text.size()) text[at] = static_cast<char>(choose.below(256));
    break;
  case 2:
    text.erase(at, length);
    break;
  case 3: // truncation
    text.resize(at);
    break;
  case 4: { // splice: a piece of another scene
    std::size_t const from = choose.below(other.size() + 1);
    text.insert(at, other, from, length);
    break;
  }
  case 5: // a piece again
    text.insert(at, std::string(text, choose.below(text.size() + 1), length));
    break;
  default: { // a token, with blanks or in the middle of a word
    std::string_view const token = tokens[choose.below(std::size(tokens))];
    text.insert(at, choose.below(2) ? fmt::format(" {} ", token) : std::string(token));
  }
  }
}

void keep(std::string const& text) {
  if (char const* path = std::getenv("ABBE_FUZZ_KEEP"))
    std::ofstream(path, std::ios::binary)
        .write(text.data(), static_cast<std::streamsize>(text.size()));
}

} // namespace

int main(int argc, char** argv) {
  std::uint64_t seed = 1;
  std::uint64_t rounds = 1500;
  double seconds = 60;
  for (int i = 1; i + 1 < argc; i += 2) {
    if (!std::strcmp(argv[i], "--seed")) seed = std::strtoull(argv[i + 1], nullptr, 10);
    if (!std::strcmp(argv[i], "--rounds")) rounds = std::strtoull(argv[i + 1], nullptr, 10);
    if (!std::strcmp(argv[i], "--seconds")) seconds = std::strtod(argv[i + 1], nullptr);
  }
  auto const scenes = corpus();
  if (scenes.empty()) {
    std::fprintf(stderr, "mutations: no scenes below %s\n", ABBE_SOURCE_DIR);
    return 1;
  }
  auto const started = Clock::now();
  std::uint64_t round = 0, wrong = 0, stopped = 0;
  for (; round < rounds; ++round) {
    if (std::chrono::duration<double>(Clock::now() - started).count() > seconds) break;
    Choice choose(abbe::RandomKey(seed).child(round));
    Scene const& scene = scenes[choose.below(scenes.size())];
    std::string text = scene.text;
    for (std::size_t n = 1 + choose.below(4); n > 0; --n)
      mutate(text, scenes[choose.below(scenes.size())].text, choose);
    std::printf("\r%s --seed %llu round %llu \033[K", scene.path.filename().c_str(),
                static_cast<unsigned long long>(seed), static_cast<unsigned long long>(round));
    std::fflush(stdout);
    keep(text);
    auto const evaluated = abbe::fuzz::evaluate_limited(scene.path.string(), text);
    stopped += evaluated.interrupted;
    std::string const complaint = abbe::fuzz::complaint(evaluated);
    if (complaint.empty()) continue;
    std::printf("\n%s\n", complaint.c_str());
    ++wrong;
  }
  std::printf("\n%llu mutants of %zu scenes, %llu stopped, %llu with wrong messages\n",
              static_cast<unsigned long long>(round), scenes.size(),
              static_cast<unsigned long long>(stopped), static_cast<unsigned long long>(wrong));
  return wrong == 0 ? 0 : 1;
}

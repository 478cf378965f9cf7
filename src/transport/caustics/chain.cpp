// SPDX-License-Identifier: MIT
#include "transport/caustics/chain.hpp"

#include "base/word_hash.hpp"

#include <algorithm>

namespace abbe::transport::caustics {

std::uint64_t ChainTable::key(int chain, Step const& step) {
  WordHash hash;
  hash.add(static_cast<std::uint64_t>(static_cast<std::uint32_t>(chain)) << 32 | step.primitive);
  hash.add(static_cast<std::uint64_t>(step.face) << 3 | static_cast<std::uint64_t>(step.entering)
           | static_cast<std::uint64_t>(step.mirror) << 1);
  return hash.value();
}

int ChainTable::extended(int chain, Step const& step, Colours const& colours) {
  std::uint64_t const at = key(chain, step);
  auto const [begin, end] = known_.equal_range(at);
  for (auto known = begin; known != end; ++known) {
    Chain const& other = (*this)[known->second];
    if (other.parent == chain && other.steps.back().same(step)) return known->second;
  }
  Chain fresh = (*this)[chain];
  fresh.parent = chain;
  fresh.steps.push_back(step);
  fresh.bends = fresh.bends || step.bends;
  fresh.disperses = fresh.disperses || colours.disperses;
  fresh.coloured = fresh.coloured || colours.coloured;
  fresh.plain = fresh.plain && colours.plain;
  if (colours.absorbing >= 0
      && std::ranges::find(fresh.absorbing, colours.absorbing) == fresh.absorbing.end()) {
    fresh.plain = fresh.plain && fresh.absorbing.size() < most_absorbing;
    fresh.absorbing.push_back(colours.absorbing);
  }
  chains_.push_back(std::move(fresh));
  known_.emplace(at, count() - 1);
  return count() - 1;
}

} // namespace abbe::transport::caustics

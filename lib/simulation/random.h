#pragma once

#include <cstdint>
#include <random>

namespace lcmslam {

using Rng = std::mt19937_64;

// Independent streams of one seed, so that switching one effect on or off leaves the others as they were.
enum class RandomStream : uint32_t { kStart, kMotion, kRange, kOdometry, kObjects, kPeople, kDropout, kImu };

// A generator for item `index` of a stream. The same bits on every platform; draw with Boost.Random, whose
// distributions are portable where those of <random> are not.
inline Rng MakeRng(uint64_t seed, RandomStream stream, uint64_t index = 0) {
  std::seed_seq words{static_cast<uint32_t>(seed), static_cast<uint32_t>(seed >> 32), static_cast<uint32_t>(stream),
                      static_cast<uint32_t>(index), static_cast<uint32_t>(index >> 32)};
  return Rng(words);
}

}  // namespace lcmslam

#pragma once

#include <cstdint>
#include <random>
#include <vector>

namespace lcmslam {

// A well-formed message with random contents; arrays and strings of random length. Specialized for every type of
// lcmtypes.
template <class M>
M RandomMessage(std::mt19937_64& random);

// A few bytes flipped, overwritten, inserted, removed or cut off; the fingerprint is spared three times out of four.
std::vector<uint8_t> Mutate(std::vector<uint8_t> bytes, std::mt19937_64& random);

}  // namespace lcmslam

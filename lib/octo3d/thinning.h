#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace lcmslam::octo3d {

// Leaves about `max_size` elements (to within 1 %), the first among them. Element i stays when the fractional part of i
// times the golden ratio is small: that spreads them evenly, and no rhythm of the elements, as that of a lidar's rings,
// coincides with it.
template <class T>
void Thin(std::vector<T>& elements, size_t max_size) {
  const size_t size = elements.size();
  if (size <= max_size) return;
  const auto limit = static_cast<uint64_t>(0x1p64 * static_cast<double>(max_size) / static_cast<double>(size));
  size_t kept = 0;
  for (size_t i = 0; i < size; ++i) {
    if (i * 0x9E3779B97F4A7C15ULL < limit) elements[kept++] = elements[i];
  }
  elements.resize(kept);
}

}  // namespace lcmslam::octo3d

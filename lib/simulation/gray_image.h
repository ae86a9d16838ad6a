#pragma once

#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <vector>

namespace lcmslam {

// Thrown by the readers of images and maps. what() is one line that names the file.
struct BadMap : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// Brightness from 0 (black) to 255, row by row from the top.
struct GrayImage {
  int width = 0;
  int height = 0;
  std::vector<uint8_t> pixels;
};

// A PGM (P2 or P5) or PNG file with 8 bits a channel, told apart by content. Colours are averaged, alpha is ignored.
// At most 100 million pixels. Throws BadMap.
[[nodiscard]] GrayImage ReadGrayImage(const std::filesystem::path& path);

}  // namespace lcmslam

#include "evaluator/report/map_image.h"

#include <algorithm>
#include <regex>
#include <sstream>
#include <vector>

#include <png.h>

#include "evaluator/files.h"
#include "evaluator/report/table.h"

namespace lcmslam::report {
namespace {

struct Pixels {
  int width = 0, height = 0;
  std::string grey;  // row by row from the top
};

// None (no pixels) unless "P5 width height 255" and as many bytes; # comments are allowed between.
Pixels DecodePgm(const std::string& bytes) {
  static const std::regex header("P5(?:\\s|#[^\n]*\n)+(\\d{1,5})(?:\\s|#[^\n]*\n)+(\\d{1,5})(?:\\s|#[^\n]*\n)+255\\s");
  std::smatch match;
  if (!std::regex_search(bytes.begin(),
                         bytes.begin() + static_cast<std::ptrdiff_t>(std::min<size_t>(bytes.size(), 1000)), match,
                         header, std::regex_constants::match_continuous)) {
    return {};
  }
  Pixels pixels{std::stoi(match[1]), std::stoi(match[2]), bytes.substr(static_cast<size_t>(match.length()))};
  const auto expected = static_cast<size_t>(pixels.width) * static_cast<size_t>(pixels.height);
  return pixels.grey.size() == expected ? pixels : Pixels{};
}

// Without the margins of one colour, that of the first pixel (unknown).
Pixels Cut(const Pixels& whole) {
  const char unknown = whole.grey.front();
  int left = whole.width, right = -1, top = whole.height, bottom = -1;
  for (int y = 0; y < whole.height; ++y) {
    for (int x = 0; x < whole.width; ++x) {
      if (whole.grey[static_cast<size_t>(y) * static_cast<size_t>(whole.width) + static_cast<size_t>(x)] == unknown)
        continue;
      left = std::min(left, x);
      right = std::max(right, x);
      top = std::min(top, y);
      bottom = std::max(bottom, y);
    }
  }
  if (right < 0) return whole;
  Pixels cut{right - left + 1, bottom - top + 1, ""};
  for (int y = top; y <= bottom; ++y) {
    cut.grey += whole.grey.substr(static_cast<size_t>(y) * static_cast<size_t>(whole.width) + static_cast<size_t>(left),
                                  static_cast<size_t>(cut.width));
  }
  return cut;
}

std::string EncodePng(const Pixels& pixels) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(pixels.width);
  image.height = static_cast<png_uint_32>(pixels.height);
  image.format = PNG_FORMAT_GRAY;
  png_alloc_size_t size = 0;
  if (png_image_write_to_memory(&image, nullptr, &size, 0, pixels.grey.data(), 0, nullptr) == 0) return "";
  std::string png(size, '\0');
  if (png_image_write_to_memory(&image, png.data(), &size, 0, pixels.grey.data(), 0, nullptr) == 0) return "";
  png.resize(size);
  return png;
}

double ReadResolution(const std::filesystem::path& yaml) {
  if (!std::filesystem::is_regular_file(yaml)) return 0.0;
  static const std::regex resolution("(?:^|\n)resolution:\\s*([0-9.eE+-]+)");
  const std::string text = ReadFile(yaml);
  std::smatch match;
  return std::regex_search(text, match, resolution) ? std::strtod(match[1].str().c_str(), nullptr) : 0.0;
}

}  // namespace

MapImage LoadMapImage(const std::filesystem::path& pgm) {
  const Pixels whole = DecodePgm(ReadFile(pgm));
  if (whole.grey.empty()) return {};
  const Pixels cut = Cut(whole);
  return {EncodePng(cut), cut.width, cut.height, ReadResolution(std::filesystem::path(pgm).replace_extension(".yaml"))};
}

}  // namespace lcmslam::report

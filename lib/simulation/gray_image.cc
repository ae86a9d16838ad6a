#include "simulation/gray_image.h"

#include <algorithm>
#include <fstream>
#include <istream>
#include <limits>
#include <string>

#include <fmt/format.h>
#include <png.h>

namespace lcmslam {
namespace {

constexpr int64_t kMaxPixels = 100'000'000;

[[noreturn]] void Fail(const std::filesystem::path& path, const std::string& reason) {
  throw BadMap(fmt::format("{}: {}", path.string(), reason));
}

GrayImage MakeImage(const std::filesystem::path& path, int64_t width, int64_t height) {
  if (width < 1 || height < 1 || width > kMaxPixels || width * height > kMaxPixels) {
    Fail(path, fmt::format("{} x {} pixels are not in 1..{}", width, height, kMaxPixels));
  }
  return {static_cast<int>(width), static_cast<int>(height), std::vector<uint8_t>(static_cast<size_t>(width * height))};
}

// A number of a PGM header or of plain PGM pixels; comments run from # to the end of the line. -1 where there is none.
int32_t ReadNumber(std::istream& file) {
  while ((file >> std::ws).peek() == '#') file.ignore(std::numeric_limits<std::streamsize>::max(), '\n');
  int32_t number = -1;
  file >> number;
  return number;
}

GrayImage ReadPgm(const std::filesystem::path& path, std::istream& file) {
  const bool plain = file.get() == 'P' && file.get() == '2';
  const int32_t width = ReadNumber(file);
  const int32_t height = ReadNumber(file);
  GrayImage image = MakeImage(path, width, height);
  const int32_t white = ReadNumber(file);
  if (white < 1 || white > 255) Fail(path, "not a PGM of 8 bits");
  file.ignore(1);  // the one white space after the header
  if (!plain)
    file.read(reinterpret_cast<char*>(image.pixels.data()), static_cast<std::streamsize>(image.pixels.size()));
  for (uint8_t& pixel : image.pixels) {
    const int32_t value = plain ? ReadNumber(file) : pixel;
    if (value < 0 || value > white) Fail(path, file ? "a pixel is brighter than white" : "too short");
    pixel = static_cast<uint8_t>(value * 255 / white);
  }
  if (!file) Fail(path, "too short");
  return image;
}

GrayImage ReadPng(const std::filesystem::path& path) {
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  if (png_image_begin_read_from_file(&png, path.c_str()) == 0) Fail(path, png.message);
  constexpr size_t kChannels = 4;
  const bool wide = (png.format & PNG_FORMAT_FLAG_LINEAR) != 0;
  png.format = PNG_FORMAT_RGBA;
  std::vector<uint8_t> rgba;
  GrayImage image;
  try {
    if (wide) Fail(path, "not a PNG of 8 bits a channel");
    image = MakeImage(path, png.width, png.height);
    rgba.resize(kChannels * image.pixels.size());
  } catch (...) {
    png_image_free(&png);
    throw;
  }
  if (png_image_finish_read(&png, nullptr, rgba.data(), 0, nullptr) == 0) Fail(path, png.message);
  for (size_t i = 0; i < image.pixels.size(); ++i) {
    const uint8_t* pixel = &rgba[kChannels * i];
    image.pixels[i] = static_cast<uint8_t>((pixel[0] + pixel[1] + pixel[2]) / 3);
  }
  return image;
}

}  // namespace

GrayImage ReadGrayImage(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::string magic(2, '\0');
  if (!file.read(magic.data(), 2)) Fail(path, "cannot be read");
  file.seekg(0);
  if (magic == "P2" || magic == "P5") return ReadPgm(path, file);
  if (magic == "\x89P") return ReadPng(path);
  Fail(path, "neither PGM nor PNG");
}

}  // namespace lcmslam

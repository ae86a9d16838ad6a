#include "sdf2d/map_file.h"

#include <bit>
#include <cmath>
#include <cstring>
#include <fstream>
#include <string_view>

#include <boost/crc.hpp>

namespace lcmslam::sdf2d {
namespace {

static_assert(std::endian::native == std::endian::little, "map files are little-endian");

constexpr std::string_view kMagic = "LCMSDF2D";
constexpr uint32_t kVersion = 1;

uint32_t Crc32(std::string_view bytes) {
  boost::crc_32_type crc;
  crc.process_bytes(bytes.data(), bytes.size());
  return crc.checksum();
}

template <class T>
void Put(std::string& bytes, const T& value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof(T));
}

// Takes the next value off the front; false when too few bytes are left.
template <class T>
bool Take(std::string_view& bytes, T& value) {
  if (bytes.size() < sizeof(T)) return false;
  std::memcpy(&value, bytes.data(), sizeof(T));
  bytes.remove_prefix(sizeof(T));
  return true;
}

bool IsPlausible(const SdfSheet& sheet) {
  for (size_t i = 0; i < SdfSheet::kVertices; ++i) {
    if (!(sheet.information[i] >= 0.0F) || std::isinf(sheet.information[i])) return false;
    if (sheet.information[i] > 0.0F && !std::isfinite(sheet.distance_m[i])) return false;
  }
  return true;
}

// A byte that says whether anything is known, then the values if so.
void PutSheet(std::string& bytes, const SdfSheet& sheet) {
  const bool empty = sheet.IsEmpty();
  Put(bytes, static_cast<uint8_t>(empty ? 0 : 1));
  if (empty) return;
  Put(bytes, sheet.distance_m);
  Put(bytes, sheet.information);
}

bool TakeSheet(std::string_view& bytes, SdfSheet& sheet) {
  uint8_t known = 0;
  if (!Take(bytes, known)) return false;
  return known == 0 || (Take(bytes, sheet.distance_m) && Take(bytes, sheet.information));
}

// "" or the reason.
std::string Parse(std::string_view bytes, std::optional<SdfMap>& map) {
  if (!bytes.starts_with(kMagic)) return "not a map of sdf2d-slam";
  if (bytes.size() < kMagic.size() + sizeof(uint32_t)) return "cut off";
  std::string_view checksum = bytes.substr(bytes.size() - sizeof(uint32_t));
  bytes.remove_suffix(sizeof(uint32_t));
  uint32_t expected = 0, version = 0;
  Take(checksum, expected);
  if (Crc32(bytes) != expected) return "damaged or cut off: the checksum is wrong";
  bytes.remove_prefix(kMagic.size());

  double cell_m = 0.0;
  uint64_t num_tiles = 0;
  if (!Take(bytes, version) || version != kVersion) return "written by another version";
  if (!Take(bytes, cell_m) || !(cell_m > 0.0) || std::isinf(cell_m)) return "cell size is not a positive number";
  if (!Take(bytes, num_tiles)) return "cut off";
  map.emplace(cell_m);
  map->BeginRevision();
  for (uint64_t i = 0; i < num_tiles; ++i) {
    int32_t tile_x = 0, tile_y = 0;
    if (!Take(bytes, tile_x) || !Take(bytes, tile_y)) return "cut off";
    if (map->Find(tile_x, tile_y) != nullptr) return "holds a tile twice";
    SdfTile& tile = map->Touch(tile_x, tile_y);
    tile.revision = map->revision();
    for (SdfSheet& sheet : tile.sheets) {
      if (!TakeSheet(bytes, sheet)) return "cut off";
      if (!IsPlausible(sheet)) return "holds values that are no distances";
    }
    if (!Take(bytes, tile.seen_through)) return "cut off";
  }
  return bytes.empty() ? "" : "holds more than its tiles";
}

}  // namespace

std::string WriteMap(const SdfMap& map, const std::filesystem::path& path) {
  std::string bytes(kMagic);
  Put(bytes, kVersion);
  Put(bytes, map.cell_m());
  Put(bytes, uint64_t{map.tiles().size()});
  for (const SdfTile& tile : map.tiles()) {
    Put(bytes, tile.tile_x);
    Put(bytes, tile.tile_y);
    for (const SdfSheet& sheet : tile.sheets) PutSheet(bytes, sheet);
    Put(bytes, tile.seen_through);
  }
  Put(bytes, Crc32(bytes));
  std::ofstream file(path, std::ios::binary);
  file << bytes;
  file.close();
  return file ? "" : path.string() + ": cannot be written";
}

std::optional<SdfMap> ReadMap(const std::filesystem::path& path, std::string* error) {
  std::ifstream file(path, std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(file)), {});
  if (!file) {
    *error = path.string() + ": cannot be read";
    return {};
  }
  std::optional<SdfMap> map;
  const std::string reason = Parse(bytes, map);
  if (reason.empty()) return map;
  *error = path.string() + ": " + reason;
  return {};
}

}  // namespace lcmslam::sdf2d

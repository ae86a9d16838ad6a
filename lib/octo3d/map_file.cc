#include "octo3d/map_file.h"

#include <bit>
#include <cmath>
#include <cstring>
#include <istream>
#include <iterator>
#include <ostream>
#include <string_view>
#include <vector>

#include <boost/crc.hpp>

namespace lcmslam::octo3d {

namespace {

static_assert(std::endian::native == std::endian::little);
constexpr std::string_view kMagic = "LCMSURF1";
constexpr size_t kViewpointBytes = 3 * sizeof(float);
constexpr size_t kLeafBytes = 3 * sizeof(uint16_t) + sizeof(uint32_t) + 10 * sizeof(double);

class ByteWriter {
 public:
  template <typename T>
  void Put(T value) {
    static_assert(std::is_trivially_copyable_v<T>);
    const size_t size = bytes.size();
    bytes.resize(size + sizeof(T));
    std::memcpy(bytes.data() + size, &value, sizeof(T));
  }
  std::string bytes;
};

class ByteReader {
 public:
  explicit ByteReader(std::string_view data) : bytes(data) {}
  // Needs sizeof(T) bytes left.
  template <typename T>
  T Get() {
    T value;
    std::memcpy(&value, bytes.data(), sizeof(T));
    bytes.remove_prefix(sizeof(T));
    return value;
  }
  std::string_view bytes;
};

uint32_t Crc32(std::string_view bytes) {
  boost::crc_32_type crc;
  crc.process_bytes(bytes.data(), bytes.size());
  return crc.checksum();
}

void PutOptions(const MapOptions& o, ByteWriter& w) {
  for (const double v : {o.leaf_m, double(o.levels), o.range_noise_m, double(o.min_points), o.max_thickness,
                         o.min_flatness, o.curvature_per_m, o.refit_growth}) {
    w.Put(v);
  }
}

std::optional<MapOptions> GetOptions(ByteReader& r) {
  MapOptions o;
  o.leaf_m = r.Get<double>();
  const double levels = r.Get<double>();
  o.range_noise_m = r.Get<double>();
  const double min_points = r.Get<double>();
  o.max_thickness = r.Get<double>();
  o.min_flatness = r.Get<double>();
  o.curvature_per_m = r.Get<double>();
  o.refit_growth = r.Get<double>();
  if (!(levels >= 1.0 && levels <= 100.0 && min_points >= 1.0 && min_points <= 1e6)) return std::nullopt;
  o.levels = static_cast<int>(levels);
  o.min_points = static_cast<int>(min_points);
  if (!o.Validate().empty()) return std::nullopt;
  return o;
}

void PutStatistics(const PointStatistics& s, ByteWriter& w) {
  for (const double v : {s.count, s.sum.x(), s.sum.y(), s.sum.z(), s.xx, s.xy, s.xz, s.yy, s.yz, s.zz}) w.Put(v);
}

// Whether points of one leaf can have these statistics.
bool IsPlausible(const PointStatistics& s, double leaf_m) {
  const double reach = 0.5 * leaf_m * 1.001;
  const double most = s.count * reach * reach;
  if (!(s.count >= 1.0 && s.count <= 1e15)) return false;
  if (!(s.sum.cwiseAbs().maxCoeff() <= s.count * reach)) return false;
  for (const double v : {s.xx, s.yy, s.zz}) {
    if (!(v >= 0.0 && v <= most)) return false;
  }
  for (const double v : {s.xy, s.xz, s.yz}) {
    if (!(std::abs(v) <= most)) return false;
  }
  return true;
}

LeafRecord GetLeaf(ByteReader& r) {
  LeafRecord leaf;
  for (uint16_t& k : leaf.key) k = r.Get<uint16_t>();
  leaf.viewpoint = r.Get<uint32_t>();
  PointStatistics& s = leaf.statistics;
  for (double* v : {&s.count, &s.sum.x(), &s.sum.y(), &s.sum.z(), &s.xx, &s.xy, &s.xz, &s.yy, &s.yz, &s.zz}) {
    *v = r.Get<double>();
  }
  return leaf;
}

}  // namespace

void WriteMap(const SurfelMap& map, std::ostream& out) {
  const std::vector<LeafRecord> leaves = map.Leaves();
  ByteWriter w;
  w.bytes = kMagic;
  PutOptions(map.options(), w);
  w.Put(static_cast<uint32_t>(map.viewpoints().size()));
  w.Put(static_cast<uint32_t>(leaves.size()));
  for (const Eigen::Vector3f& v : map.viewpoints()) {
    for (const float c : {v.x(), v.y(), v.z()}) w.Put(c);
  }
  for (const LeafRecord& leaf : leaves) {
    for (const uint16_t k : leaf.key) w.Put(k);
    w.Put(leaf.viewpoint);
    PutStatistics(leaf.statistics, w);
  }
  w.Put(Crc32(w.bytes));
  out.write(w.bytes.data(), static_cast<std::streamsize>(w.bytes.size()));
}

ReadMapResult ReadMap(std::istream& in) {
  const std::string file((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  constexpr size_t kHeaderBytes = kMagic.size() + 8 * sizeof(double) + 2 * sizeof(uint32_t);
  if (file.size() < kHeaderBytes + sizeof(uint32_t)) return {{}, "too short"};
  if (!file.starts_with(kMagic)) return {{}, "not a surfel map, or another version"};
  const std::string_view content = std::string_view(file).substr(0, file.size() - sizeof(uint32_t));
  if (ByteReader(std::string_view(file).substr(content.size())).Get<uint32_t>() != Crc32(content)) {
    return {{}, "checksum does not match"};
  }

  ByteReader r(content.substr(kMagic.size()));
  const std::optional<MapOptions> options = GetOptions(r);
  if (!options) return {{}, "options out of range"};
  const size_t num_viewpoints = r.Get<uint32_t>(), num_leaves = r.Get<uint32_t>();
  if (r.bytes.size() != num_viewpoints * kViewpointBytes + num_leaves * kLeafBytes) return {{}, "wrong length"};

  std::vector<Eigen::Vector3f> viewpoints(num_viewpoints);
  for (Eigen::Vector3f& v : viewpoints) {
    for (int axis = 0; axis < 3; ++axis) v[axis] = r.Get<float>();
    if (!v.allFinite()) return {{}, "a viewpoint is not finite"};
  }
  std::vector<LeafRecord> leaves(num_leaves);
  for (size_t i = 0; i < leaves.size(); ++i) {
    leaves[i] = GetLeaf(r);
    if (i > 0 && leaves[i].key <= leaves[i - 1].key) return {{}, "leaves out of order"};
    if (leaves[i].viewpoint >= num_viewpoints) return {{}, "a leaf's viewpoint does not exist"};
    if (!IsPlausible(leaves[i].statistics, options->leaf_m)) return {{}, "a leaf's statistics are impossible"};
  }
  ReadMapResult result;
  result.map.emplace(*options);
  result.map->Restore(leaves, viewpoints);
  return result;
}

void WritePly(std::span<const Surfel> surfels, std::ostream& out) {
  out << "ply\nformat binary_little_endian 1.0\ncomment metres, map frame; normals towards the sensor\nelement vertex "
      << surfels.size() << '\n';
  for (const char* name : {"x", "y", "z", "nx", "ny", "nz", "radius"}) out << "property float " << name << '\n';
  out << "property uint count\nend_header\n";
  ByteWriter w;
  for (const Surfel& s : surfels) {
    for (const Eigen::Vector3f& v : {s.mean, s.normal}) {
      for (const float c : {v.x(), v.y(), v.z()}) w.Put(c);
    }
    w.Put(0.5F * s.cell_m);
    w.Put(s.count);
  }
  out.write(w.bytes.data(), static_cast<std::streamsize>(w.bytes.size()));
}

}  // namespace lcmslam::octo3d

#include "support/sample_messages.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <lcmslam/evaluation_t.hpp>
#include <lcmslam/imu_t.hpp>
#include <lcmslam/lidar_packet_t.hpp>
#include <lcmslam/occupancy_grid_t.hpp>
#include <lcmslam/planar_lidar_t.hpp>
#include <lcmslam/planar_scan_t.hpp>
#include <lcmslam/point_cloud_chunk_t.hpp>
#include <lcmslam/pose_t.hpp>
#include <lcmslam/pose_xyt_t.hpp>
#include <lcmslam/rigid_transform_t.hpp>
#include <lcmslam/sdf_tile_t.hpp>
#include <lcmslam/service_status_t.hpp>
#include <lcmslam/slam_command_t.hpp>
#include <lcmslam/slam_diagnostics_t.hpp>
#include <lcmslam/surfel_chunk_t.hpp>

namespace lcmslam {
namespace {

using Random = std::mt19937_64;

int Below(int limit, Random& random) { return static_cast<int>(random() % static_cast<uint64_t>(limit)); }
double Unit(Random& random) { return static_cast<double>(random() >> 11) * 0x1p-53; }

// A time within a day of the start of 2026.
int64_t RandomUtime(Random& random) { return 1'767'225'600'000'000 + Below(86'400, random) * int64_t{1'000'000}; }

template <class T>
std::vector<T> RandomArray(int count, double low, double high, Random& random) {
  std::vector<T> values(static_cast<size_t>(count));
  for (T& value : values) value = static_cast<T>(low + (high - low) * Unit(random));
  return values;
}

std::string RandomText(Random& random) {
  std::string text(static_cast<size_t>(Below(20, random)), ' ');
  for (char& c : text) c = static_cast<char>('a' + Below(26, random));
  return text;
}

void RandomPosition(double (&pos)[3], Random& random) {
  for (double& p : pos) p = 20.0 * Unit(random) - 10.0;
}

void RandomRotation(double (&wxyz)[4], Random& random) {
  double norm = 0.0;
  for (double& q : wxyz) q = 2.0 * Unit(random) - 1.0, norm += q * q;
  for (double& q : wxyz) q /= std::sqrt(norm);
}

}  // namespace

template <>
planar_scan_t RandomMessage(Random& random) {
  planar_scan_t m{};
  m.utime = RandomUtime(random);
  m.num_ranges = Below(700, random);
  m.ranges = RandomArray<float>(m.num_ranges, 0.0, 10.0, random);
  m.thetas = RandomArray<float>(m.num_ranges, -3.0, 3.0, random);
  for (int i = 0; i < m.num_ranges; ++i) m.times.push_back(m.utime - 100 * (m.num_ranges - 1 - i));
  m.intensities = RandomArray<float>(m.num_ranges, 0.0, 255.0, random);
  return m;
}

template <>
planar_lidar_t RandomMessage(Random& random) {
  planar_lidar_t m{};
  m.utime = RandomUtime(random);
  m.nranges = Below(700, random);
  m.ranges = RandomArray<float>(m.nranges, 0.0, 10.0, random);
  m.nintensities = Below(2, random) * m.nranges;
  m.intensities = RandomArray<float>(m.nintensities, 0.0, 255.0, random);
  m.rad0 = -2.0F;
  m.radstep = 0.006F;
  return m;
}

template <>
pose_t RandomMessage(Random& random) {
  pose_t m{};
  m.utime = RandomUtime(random);
  RandomPosition(m.pos, random);
  RandomRotation(m.orientation, random);
  return m;
}

template <>
pose_xyt_t RandomMessage(Random& random) {
  pose_xyt_t m{};
  m.utime = RandomUtime(random);
  m.x = static_cast<float>(Unit(random));
  m.y = static_cast<float>(Unit(random));
  m.theta = static_cast<float>(Unit(random));
  return m;
}

template <>
rigid_transform_t RandomMessage(Random& random) {
  rigid_transform_t m{};
  m.utime = RandomUtime(random);
  RandomPosition(m.trans, random);
  RandomRotation(m.quat, random);
  return m;
}

template <>
occupancy_grid_t RandomMessage(Random& random) {
  occupancy_grid_t m{};
  m.utime = RandomUtime(random);
  m.meters_per_cell = 0.05F;
  m.width = Below(30, random);
  m.height = Below(30, random);
  m.num_cells = m.width * m.height;
  m.cells = RandomArray<int8_t>(m.num_cells, -127, 127, random);
  return m;
}

template <>
point_cloud_chunk_t RandomMessage(Random& random) {
  point_cloud_chunk_t m{};
  m.utime = RandomUtime(random);
  m.num_points = Below(300, random);
  m.sweep = Below(1000, random);
  m.num_chunks = static_cast<int16_t>(1 + Below(12, random));
  m.chunk = static_cast<int16_t>(Below(m.num_chunks, random));
  m.x = RandomArray<float>(m.num_points, -10.0, 10.0, random);
  m.y = RandomArray<float>(m.num_points, -10.0, 10.0, random);
  m.z = RandomArray<float>(m.num_points, -2.0, 2.0, random);
  m.intensity = RandomArray<float>(m.num_points, 0.0, 255.0, random);
  m.ring = RandomArray<int16_t>(m.num_points, 0, 16, random);
  m.time_offset = RandomArray<int32_t>(m.num_points, -100'000, 0, random);
  return m;
}

template <>
lidar_packet_t RandomMessage(Random& random) {
  lidar_packet_t m{};
  m.utime = RandomUtime(random);
  m.num_bytes = Below(1300, random);
  m.port = 2368;
  m.payload = RandomArray<uint8_t>(m.num_bytes, 0, 255, random);
  return m;
}

template <>
imu_t RandomMessage(Random& random) {
  imu_t m{};
  m.utime = RandomUtime(random);
  RandomPosition(m.angular_velocity, random);
  RandomPosition(m.specific_force, random);
  return m;
}

template <>
surfel_chunk_t RandomMessage(Random& random) {
  surfel_chunk_t m{};
  m.utime = RandomUtime(random);
  m.num_surfels = Below(200, random);
  m.x = RandomArray<float>(m.num_surfels, -10.0, 10.0, random);
  m.y = RandomArray<float>(m.num_surfels, -10.0, 10.0, random);
  m.z = RandomArray<float>(m.num_surfels, -2.0, 2.0, random);
  m.normal_x = m.normal_y = std::vector<float>(m.x.size(), 0.0F);
  m.normal_z = std::vector<float>(m.x.size(), 1.0F);
  m.cell_size = RandomArray<float>(m.num_surfels, 0.1, 0.8, random);
  m.spread = RandomArray<float>(m.num_surfels, 0.0, 0.05, random);
  m.count = RandomArray<int32_t>(m.num_surfels, 5, 1000, random);
  return m;
}

template <>
sdf_tile_t RandomMessage(Random& random) {
  sdf_tile_t m{};
  m.utime = RandomUtime(random);
  m.cells_per_side = Below(32, random);
  m.num_cells = m.cells_per_side * m.cells_per_side;
  m.meters_per_cell = 0.05F;
  m.meters_per_unit = 1e-4F;
  m.distance = RandomArray<int16_t>(m.num_cells, -3000, 3000, random);
  m.weight = RandomArray<uint8_t>(m.num_cells, 0, 255, random);
  return m;
}

template <>
slam_diagnostics_t RandomMessage(Random& random) {
  slam_diagnostics_t m{};
  m.utime = m.input_utime = RandomUtime(random);
  m.dof = 3;
  m.num_covariance = 9;
  m.covariance = RandomArray<double>(9, 0.0, 1.0, random);
  m.num_stages = static_cast<int16_t>(Below(5, random));
  m.stage_ms = RandomArray<float>(m.num_stages, 0.0, 1.0, random);
  for (int i = 0; i < m.num_stages; ++i) m.stage_name.push_back(RandomText(random));
  return m;
}

template <>
slam_command_t RandomMessage(Random& random) {
  slam_command_t m{};
  m.utime = RandomUtime(random);
  m.command = slam_command_t::SET_POSE;  // the one command that neither ends nor writes anything
  RandomPosition(m.pos, random);
  RandomRotation(m.quat, random);
  m.path = RandomText(random);
  m.service = RandomText(random);
  return m;
}

template <>
service_status_t RandomMessage(Random& random) {
  service_status_t m{};
  m.utime = RandomUtime(random);
  m.name = RandomText(random);
  m.text = RandomText(random);
  return m;
}

template <>
evaluation_t RandomMessage(Random& random) {
  evaluation_t m{};
  m.utime = RandomUtime(random);
  RandomPosition(m.alignment_pos, random);
  RandomRotation(m.alignment_quat, random);
  m.alignment = m.estimate_channel = m.reference_channel = RandomText(random);
  m.text = RandomText(random);
  return m;
}

std::vector<uint8_t> Mutate(std::vector<uint8_t> bytes, Random& random) {
  const size_t spared = random() % 4 == 0 ? 0 : std::min<size_t>(8, bytes.size());
  const int changes = 1 + Below(4, random);
  for (int i = 0; i < changes && bytes.size() > spared; ++i) {
    // Half of the changes strike the first words behind the fingerprint, where the counts are.
    const size_t reach = random() % 2 == 0 ? bytes.size() - spared : std::min<size_t>(bytes.size() - spared, 40);
    const size_t at = spared + random() % reach;
    const auto here = bytes.begin() + static_cast<std::ptrdiff_t>(at);
    switch (Below(6, random)) {
      case 0:
        *here ^= static_cast<uint8_t>(1U << Below(8, random));
        break;
      case 1:
        *here = static_cast<uint8_t>(random());
        break;
      case 2:
        std::fill(here, std::min(here + 4, bytes.end()), random() % 2 == 0 ? 0xFF : 0x7F);
        break;
      case 3:
        bytes.insert(here, static_cast<uint8_t>(random()));
        break;
      case 4:
        bytes.erase(here);
        break;
      default:
        bytes.resize(at);
    }
  }
  return bytes;
}

}  // namespace lcmslam

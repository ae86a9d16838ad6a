#include "sensors/velodyne_packet.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "geometry/angles.h"
#include "lidar/multi_line_model.h"
#include "sensors/bad_input.h"
#include "sensors/byte_reader.h"

namespace lcmslam {
namespace {

constexpr int kBlocks = 12;
constexpr int kReturnsPerBlock = 32;
constexpr uint16_t kBlockFlag = 0xEEFF;
constexpr double kRangeUnit_m = 0.002;
constexpr double kAzimuthUnit_deg = 0.01;
constexpr uint16_t kAzimuthUnitsPerTurn = 36000;
constexpr uint32_t kHour_us = 3'600'000'000;
constexpr double kTurn_rad = 2.0 * std::numbers::pi;

enum ReturnMode : uint8_t { kStrongest = 0x37, kLast = 0x38, kDual = 0x39 };
enum Product : uint8_t { kHdl32e = 0x21, kVlp16 = 0x22 };

struct Return {
  uint16_t range = 0;  // in kRangeUnit_m
  uint8_t intensity = 0;
};

struct Block {
  uint16_t azimuth = 0;  // in kAzimuthUnit_deg, of the first laser
  std::array<Return, kReturnsPerBlock> returns;
};

Block ReadBlock(ByteReader& reader) {
  if (reader.Get<uint16_t>() != kBlockFlag) throw BadInput("Velodyne packet: no block flag");
  Block block;
  block.azimuth = reader.Get<uint16_t>();
  if (block.azimuth >= kAzimuthUnitsPerTurn) throw BadInput("Velodyne packet: azimuth beyond 360 degrees");
  for (Return& r : block.returns) {
    r.range = reader.Get<uint16_t>();
    r.intensity = reader.Get<uint8_t>();
  }
  return block;
}

// A laser with what its shots have in common.
struct Beam3 {
  Laser laser;
  double cos_elevation;
  double sin_elevation;
};

// The shots of one block: a cycle of the HDL-32E, two cycles of the VLP-16.
struct BlockPlan {
  std::vector<Beam3> beams;
  double duration_us;
};

BlockPlan PlanFor(const MultiLineModel& model) {
  const size_t cycles = kReturnsPerBlock / model.lasers.size();
  BlockPlan plan{.beams = {}, .duration_us = static_cast<double>(cycles) * model.firing_cycle_us};
  for (size_t cycle = 0; cycle < cycles; ++cycle) {
    for (Laser laser : model.lasers) {
      laser.fire_delay_us += static_cast<double>(cycle) * model.firing_cycle_us;
      plan.beams.push_back({laser, std::cos(laser.elevation_rad), std::sin(laser.elevation_rad)});
    }
  }
  return plan;
}

const BlockPlan& PlanOf(uint8_t product) {
  static const BlockPlan vlp16 = PlanFor(VelodyneVlp16());
  static const BlockPlan hdl32e = PlanFor(VelodyneHdl32e());
  if (product == kVlp16) return vlp16;
  if (product == kHdl32e) return hdl32e;
  throw BadInput(fmt::format("Velodyne packet: unknown product {:#04x}", product));
}

VelodynePoint Place(const Return& r, const Beam3& beam, double azimuth_rad, double delay_us) {
  const double range_m = kRangeUnit_m * r.range;
  const double across_m = range_m * beam.cos_elevation;
  return {.p_lidar = Eigen::Vector3d(across_m * std::cos(azimuth_rad), -across_m * std::sin(azimuth_rad),
                                     range_m * beam.sin_elevation + beam.laser.height_m)
                         .cast<float>(),
          .intensity = static_cast<float>(r.intensity),
          .ring = beam.laser.ring,
          .azimuth_rad = azimuth_rad,
          .delay_us = delay_us};
}

}  // namespace

VelodynePacket DecodeVelodynePacket(std::span<const uint8_t> payload) {
  if (payload.size() != kVelodynePacketBytes) {
    throw BadInput(
        fmt::format("Velodyne packet: {} bytes where {} are expected", payload.size(), kVelodynePacketBytes));
  }
  ByteReader reader(payload);
  std::array<Block, kBlocks> blocks;
  for (Block& block : blocks) block = ReadBlock(reader);
  VelodynePacket packet;
  packet.stamp_us = reader.Get<uint32_t>();
  if (packet.stamp_us >= kHour_us) throw BadInput("Velodyne packet: stamp beyond the hour");
  const auto mode = reader.Get<uint8_t>();
  if (mode != kStrongest && mode != kLast && mode != kDual) {
    throw BadInput(fmt::format("Velodyne packet: unknown return mode {:#04x}", mode));
  }
  const BlockPlan& plan = PlanOf(reader.Get<uint8_t>());

  // In dual mode two blocks show the same shots.
  const int blocks_per_firing = mode == kDual ? 2 : 1;
  const int last_firing = kBlocks / blocks_per_firing - 1;
  const double turned_rad = WrapAngle(DegToRad(kAzimuthUnit_deg * (blocks.back().azimuth - blocks.front().azimuth)));
  const double rate_rad_per_us = turned_rad / (last_firing * plan.duration_us);
  for (int b = 0; b < kBlocks; ++b) {
    const Block& block = blocks[static_cast<size_t>(b)];
    for (size_t i = 0; i < kReturnsPerBlock; ++i) {
      const Return& r = block.returns[i];
      const bool same_as_other =
          b % blocks_per_firing == 1 && r.range == blocks[static_cast<size_t>(b - 1)].returns[i].range;
      if (r.range == 0 || same_as_other) continue;
      const double into_block_us = plan.beams[i].laser.fire_delay_us;
      const double azimuth_rad = DegToRad(kAzimuthUnit_deg * block.azimuth) + rate_rad_per_us * into_block_us;
      const double delay_us = b / blocks_per_firing * plan.duration_us + into_block_us;
      packet.points.push_back(Place(r, plan.beams[i], std::fmod(azimuth_rad + kTurn_rad, kTurn_rad), delay_us));
    }
  }
  if (mode == kDual) std::ranges::stable_sort(packet.points, {}, &VelodynePoint::delay_us);
  return packet;
}

}  // namespace lcmslam

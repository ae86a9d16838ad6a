#include "sensors/velodyne_packet.h"

#include <cmath>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "geometry/angles.h"
#include "sensors/velodyne_assembler.h"
#include "support/error_of.h"
#include "support/velodyne_builder.h"

namespace lcmslam {
namespace {

using testing::HasSubstr;

// Turns 0.4 degrees from block to block, starting at `first`.
VelodyneBuilder Turning(int first = 1000) {
  VelodyneBuilder builder;
  for (size_t b = 0; b < 12; ++b)
    builder.azimuths[b] = static_cast<uint16_t>((first + 40 * static_cast<int>(b)) % 36000);
  return builder;
}

std::string RefusalOf(const std::vector<uint8_t>& bytes) {
  return ErrorOf([&] { (void)DecodeVelodynePacket(bytes); });
}

// One shot, placed with the manual's formulas.
TEST(VelodynePacket, PlacesAShotOfTheVlp16) {
  VelodyneBuilder builder = Turning();
  builder.stamp_us = 123'456'789;
  builder.ranges[3][16 + 2] = 2500;  // second cycle of block 3, laser 2: -13 degrees, 9.7 mm up, ring 1
  builder.intensities[3][16 + 2] = 77;
  const VelodynePacket packet = DecodeVelodynePacket(builder.Bytes());
  EXPECT_EQ(packet.stamp_us, 123'456'789u);
  ASSERT_EQ(packet.points.size(), 1u);
  const VelodynePoint& p = packet.points[0];
  const double azimuth_rad = DegToRad(10.0 + 3 * 0.4 + 0.4 * (55.296 + 2 * 2.304) / (2 * 55.296));
  EXPECT_NEAR(p.delay_us, 7 * 55.296 + 2 * 2.304, 1e-9);
  EXPECT_NEAR(p.azimuth_rad, azimuth_rad, 1e-9);
  EXPECT_NEAR(p.p_lidar.x(), 5.0 * std::cos(DegToRad(-13.0)) * std::cos(azimuth_rad), 1e-5);
  EXPECT_NEAR(p.p_lidar.y(), -5.0 * std::cos(DegToRad(-13.0)) * std::sin(azimuth_rad), 1e-5);
  EXPECT_NEAR(p.p_lidar.z(), 5.0 * std::sin(DegToRad(-13.0)) + 0.0097, 1e-5);
  EXPECT_EQ(p.intensity, 77.0F);
  EXPECT_EQ(p.ring, 1);
}

TEST(VelodynePacket, PlacesAShotOfTheHdl32e) {
  VelodyneBuilder builder = Turning();
  builder.product = VelodyneBuilder::kHdl32e;
  builder.ranges[11][31] = 1000;  // 10.67 degrees
  const VelodynePacket packet = DecodeVelodynePacket(builder.Bytes());
  ASSERT_EQ(packet.points.size(), 1u);
  EXPECT_NEAR(packet.points[0].delay_us, 11 * 46.08 + 31 * 1.152, 1e-9);
  EXPECT_NEAR(packet.points[0].p_lidar.z(), 2.0 * std::sin(DegToRad(32.0 / 3.0)), 1e-5);
  EXPECT_EQ(packet.points[0].ring, 31);
}

TEST(VelodynePacket, AzimuthPassesZero) {
  VelodyneBuilder builder = Turning(35'800);
  for (auto& block : builder.ranges) block.fill(500);
  const VelodynePacket packet = DecodeVelodynePacket(builder.Bytes());
  ASSERT_EQ(packet.points.size(), 384u);
  double last_rad = DegToRad(358.0) - 1e-9;
  for (const VelodynePoint& p : packet.points) {
    const double step_rad = WrapAngle(p.azimuth_rad - last_rad);
    ASSERT_GE(p.azimuth_rad, 0.0);
    ASSERT_LT(p.azimuth_rad, 2.0 * std::numbers::pi);
    ASSERT_GT(step_rad, 0.0);
    ASSERT_LT(step_rad, DegToRad(0.1));
    last_rad = p.azimuth_rad;
  }
}

// Its encoder may then count back a step, also across zero.
TEST(VelodynePacket, AHeadAtRestLooksOneWay) {
  for (const int at : {12'000, 0}) {
    SCOPED_TRACE(at);
    VelodyneBuilder builder;
    builder.azimuths.fill(static_cast<uint16_t>(at));
    builder.azimuths.back() = static_cast<uint16_t>((at + 35'999) % 36'000);
    for (auto& block : builder.ranges) block.fill(500);
    for (const VelodynePoint& p : DecodeVelodynePacket(builder.Bytes()).points) {
      ASSERT_LT(std::abs(WrapAngle(p.azimuth_rad - DegToRad(0.01 * at))), DegToRad(0.03));
      ASSERT_GE(p.azimuth_rad, 0.0);
      ASSERT_LT(p.azimuth_rad, 2.0 * std::numbers::pi);
    }
  }
}

// Blocks come in pairs of one time: last return, strongest return.
TEST(VelodynePacket, DualReturns) {
  VelodyneBuilder builder;
  builder.mode = VelodyneBuilder::kDual;
  for (size_t b = 0; b < 12; ++b) builder.azimuths[b] = static_cast<uint16_t>(1000 + 40 * (b / 2));
  builder.ranges[2][5] = 1500;
  builder.ranges[3][5] = 1000;
  builder.ranges[2][6] = 700;  // both the same: one point
  builder.ranges[3][6] = 700;
  const VelodynePacket packet = DecodeVelodynePacket(builder.Bytes());
  ASSERT_EQ(packet.points.size(), 3u);
  EXPECT_NEAR(packet.points[0].delay_us, 2 * 55.296 + 5 * 2.304, 1e-9);
  EXPECT_NEAR(packet.points[1].delay_us, packet.points[0].delay_us, 1e-9);
  EXPECT_NEAR(packet.points[0].p_lidar.norm(), 3.0, 1e-2);
  EXPECT_NEAR(packet.points[1].p_lidar.norm(), 2.0, 1e-2);
  EXPECT_NEAR(packet.points[0].azimuth_rad, DegToRad(10.4 + 0.4 * 5 * 2.304 / (2 * 55.296)), 1e-9);
}

TEST(VelodynePacket, RefusesWhatItIsNot) {
  EXPECT_EQ(RefusalOf(Turning().Bytes()), "");
  EXPECT_THAT(RefusalOf({}), HasSubstr("0 bytes where 1206"));
  VelodyneBuilder builder = Turning();
  builder.azimuths[7] = 36'000;
  EXPECT_THAT(RefusalOf(builder.Bytes()), HasSubstr("azimuth"));
  builder = Turning();
  builder.mode = 0x40;
  EXPECT_THAT(RefusalOf(builder.Bytes()), HasSubstr("return mode 0x40"));
  builder = Turning();
  builder.product = 0x28;
  EXPECT_THAT(RefusalOf(builder.Bytes()), HasSubstr("product 0x28"));
  builder = Turning();
  builder.stamp_us = 3'600'000'000;
  EXPECT_THAT(RefusalOf(builder.Bytes()), HasSubstr("hour"));
  std::vector<uint8_t> bytes = Turning().Bytes();
  bytes[100] = 0xDD;
  EXPECT_THAT(RefusalOf(bytes), HasSubstr("block flag"));
}

// Packets of a head at 10 Hz: 1327.104 us and 4.78 degrees each.
class Stream {
 public:
  explicit Stream(double azimuth_deg, double stamp_us = 1000.0) : azimuth_deg_(azimuth_deg), stamp_us_(stamp_us) {}
  VelodynePacket Next() {
    VelodyneBuilder builder;
    for (size_t b = 0; b < 12; ++b) {
      const double block_deg = azimuth_deg_ + 3.6e-3 * 110.592 * static_cast<double>(b);
      builder.azimuths[b] = static_cast<uint16_t>(std::lround(100.0 * block_deg) % 36000);
      builder.ranges[b].fill(500);
    }
    builder.stamp_us = static_cast<uint32_t>(std::fmod(std::round(stamp_us_), 3.6e9));
    Skip();
    return DecodeVelodynePacket(builder.Bytes());
  }
  void Skip() {
    azimuth_deg_ = std::fmod(azimuth_deg_ + 3.6e-3 * 1327.104, 360.0);
    stamp_us_ += 1327.104;
  }

 private:
  double azimuth_deg_;
  double stamp_us_;
};

TEST(VelodyneAssembler, CutsTurnsAhead) {
  Stream stream(100.0);
  VelodyneAssembler assembler;
  std::vector<Sweep> sweeps;
  for (int i = 0; i < 250; ++i) {
    for (Sweep& sweep : assembler.Add(stream.Next(), 5'000'000 + 2000 * i)) sweeps.push_back(std::move(sweep));
  }
  ASSERT_EQ(sweeps.size(), 2u) << "3.3 turns less 0.7 at the start, and the last is not complete";
  for (const Sweep& sweep : sweeps) {
    EXPECT_NEAR(static_cast<double>(sweep.points.size()), 16 * 1e5 / 55.296, 32.0);
    EXPECT_NEAR(sweep.points.front().dt_us, -1e5, 60.0);
    EXPECT_EQ(sweep.points.back().dt_us, 0);
    EXPECT_NEAR(std::atan2(sweep.points.front().y, sweep.points.front().x), 0.0, DegToRad(0.4));
    EXPECT_LE(std::atan2(sweep.points.front().y, sweep.points.front().x), 0.0) << "clockwise from x";
  }
  EXPECT_NEAR(static_cast<double>(sweeps[1].utime - sweeps[0].utime), 1e5, 60.0);
  const double first_cut_us = 260.0 / 360.0 * 1e5;
  EXPECT_NEAR(static_cast<double>(sweeps[0].utime), 5e6 + first_cut_us + 1e5, 120.0)
      << "the first packet gives the time";
  EXPECT_TRUE(assembler.Finish().has_value());
  EXPECT_FALSE(assembler.Finish().has_value());
}

TEST(VelodyneAssembler, LivesThroughTheEndOfTheHour) {
  Stream stream(350.0, 3.6e9 - 50'000.0);
  VelodyneAssembler assembler;
  std::vector<Sweep> sweeps;
  for (int i = 0; i < 200; ++i) {
    for (Sweep& sweep : assembler.Add(stream.Next(), 0)) sweeps.push_back(std::move(sweep));
  }
  ASSERT_EQ(sweeps.size(), 2u);
  EXPECT_NEAR(static_cast<double>(sweeps[0].utime), 1e5 * (1.0 + 10.0 / 360.0), 120.0);
  EXPECT_NEAR(static_cast<double>(sweeps[1].utime), 1e5 * (2.0 + 10.0 / 360.0), 120.0);
}

TEST(VelodyneAssembler, AClockThatFindsGpsMovesNoStamps) {
  for (const double set_to_us : {2.0e9, 100.0}) {
    SCOPED_TRACE(set_to_us);
    VelodyneAssembler assembler;
    Stream before(350.0, 1e9), after(350.0, set_to_us);
    int64_t received_utime = 5'000'000;
    for (int i = 0; i < 200; ++i, received_utime += 1327) {
      for (const Sweep& sweep : assembler.Add(i < 90 ? before.Next() : after.Next(), received_utime))
        EXPECT_NEAR(static_cast<double>(sweep.utime), static_cast<double>(received_utime), 3000.0);
    }
    EXPECT_NEAR(static_cast<double>(assembler.packet_utime()), static_cast<double>(received_utime), 3000.0);
  }
}

TEST(VelodyneAssembler, AReceiverThatStallsMovesNoStamps) {
  for (const int64_t stall_us : {9'000'000, -5'000'000}) {  // the second: the receiver's clock steps back
    SCOPED_TRACE(stall_us);
    VelodyneAssembler assembler;
    Stream stream(350.0);
    const int64_t begin_utime = 50'000'000;
    int64_t sent_utime = begin_utime;
    for (int i = 0; i < 200; ++i, sent_utime += 1327) {
      for (const Sweep& sweep : assembler.Add(stream.Next(), i < 90 ? sent_utime : begin_utime + 90 * 1327 + stall_us))
        EXPECT_NEAR(static_cast<double>(sweep.utime), static_cast<double>(sent_utime), 3000.0);
    }
    EXPECT_NEAR(static_cast<double>(assembler.packet_utime()), static_cast<double>(sent_utime), 3000.0);
  }
}

TEST(VelodyneAssembler, LostPacketsLeaveAGap) {
  Stream stream(350.0);
  VelodyneAssembler assembler;
  std::vector<Sweep> sweeps;
  for (int i = 0; i < 100; ++i) {
    if (i >= 20 && i < 30) {
      stream.Skip();
    } else {
      for (Sweep& sweep : assembler.Add(stream.Next(), 0)) sweeps.push_back(std::move(sweep));
    }
  }
  ASSERT_EQ(sweeps.size(), 1u);
  EXPECT_NEAR(static_cast<double>(sweeps[0].points.size()), 16 * 1e5 / 55.296 - 3840.0, 32.0);
}

TEST(VelodyneAssembler, AJumpInTimeEndsTheSweep) {
  for (const double jump_us : {-20'000.0, 5e6}) {
    SCOPED_TRACE(jump_us);
    VelodyneAssembler assembler;
    Stream before(350.0, 1e6);
    for (int i = 0; i < 30; ++i) EXPECT_TRUE(assembler.Add(before.Next(), 0).empty());
    Stream after(160.0, 1e6 + jump_us);
    const std::vector<Sweep> cut_off = assembler.Add(after.Next(), 0);
    ASSERT_EQ(cut_off.size(), 1u);
    EXPECT_NEAR(static_cast<double>(cut_off[0].points.size()), 384 * 28, 384.0);
    EXPECT_FALSE(assembler.Finish().has_value()) << "no new sweep before the next cut";
  }
}

}  // namespace
}  // namespace lcmslam

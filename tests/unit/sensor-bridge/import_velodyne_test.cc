// `sensor-bridge import velodyne` from the command line to the log it writes.

#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <lcmslam/lidar_packet_t.hpp>
#include <lcmslam/pose_t.hpp>

#include "bus/log_writer.h"
#include "sensors/velodyne_packet.h"
#include "support/real_data.h"
#include "support/velodyne_capture.h"
#include "unit/sensor-bridge/bridge_runs.h"

namespace lcmslam {
namespace {

constexpr int64_t kFirstUtime = 50'000'000;

Imported ImportBytes(const std::string& bytes, const std::vector<std::string>& options = {}) {
  const TemporaryFile file(bytes);
  return Imported("velodyne", file.path(), options);
}

TEST(ImportVelodyne, CaptureAndBarePayloads) {
  const std::vector<std::string> payloads = VelodyneTurns(4);
  const Imported captured = ImportBytes(VelodyneCapture(payloads, kFirstUtime));
  EXPECT_EQ(captured.exit_code, 0);
  const std::vector<Sweep> sweeps = captured.SweepsOn("LIDAR_3D");
  ASSERT_EQ(sweeps.size(), 2U) << "the first and the last turn are not known to be whole";
  EXPECT_NEAR(static_cast<double>(sweeps[1].utime - sweeps[0].utime), 1e5, 100.0);
  EXPECT_GT(sweeps[0].utime, kFirstUtime);
  EXPECT_GE(sweeps[0].points.back().ring, 0);
  EXPECT_TRUE(captured.On("LIDAR_3D_PACKET").empty());

  const std::vector<Sweep> bare = ImportBytes(Joined(payloads)).SweepsOn("LIDAR_3D");
  ASSERT_EQ(bare.size(), 2U);
  EXPECT_EQ(bare[0].points.size(), sweeps[0].points.size());
  EXPECT_LT(bare[0].utime, kFirstUtime) << "by the sensor's clock";
}

TEST(ImportVelodyne, KeepsPacketsFromWhichTheSweepsComeAgain) {
  const std::vector<std::string> payloads = VelodyneTurns(4);
  const TemporaryFile capture(VelodyneCapture(payloads, kFirstUtime));
  const Imported log("velodyne", capture.path(), {"--packets"});
  const std::vector<Event> packets = log.On("LIDAR_3D_PACKET");
  ASSERT_EQ(packets.size(), payloads.size());
  const lidar_packet_t packet = *Decode<lidar_packet_t>(packets[7].data);
  EXPECT_EQ(packet.utime, kFirstUtime + 7);
  EXPECT_EQ(packet.port, 2368);
  EXPECT_EQ(std::string(packet.payload.begin(), packet.payload.end()), payloads[7]);

  const TemporaryFile packet_log;
  LogWriter writer(packet_log.path());
  for (const Event& event : log.events) writer.Write(event.utime, event.channel, event.data);
  writer.Write(kFirstUtime, "ODOMETRY", pose_t{});
  writer.Flush();
  const Imported again("velodyne", packet_log.path());
  EXPECT_EQ(again.exit_code, 0);
  ASSERT_EQ(again.SweepsOn("LIDAR_3D").size(), 2U);
  EXPECT_EQ(again.SweepsOn("LIDAR_3D")[1].utime, log.SweepsOn("LIDAR_3D")[1].utime);
  EXPECT_EQ(again.On("ODOMETRY").size(), 1U) << "other messages go on as they are, but for old sweeps";
  EXPECT_EQ(Imported("velodyne", packet_log.path(), {"--port", "9"}).exit_code, 3);
}

TEST(ImportVelodyne, RefusesWhatHoldsNoSweep) {
  const std::string capture = VelodyneCapture(VelodyneTurns(4), kFirstUtime);
  EXPECT_EQ(ImportBytes(capture, {"--port", "2369"}).exit_code, 3);
  EXPECT_EQ(ImportBytes(VelodyneCapture(VelodyneTurns(1), kFirstUtime)).exit_code, 3);
  EXPECT_EQ(ImportBytes(std::string(kVelodynePacketBytes, '\0')).exit_code, 3);
  const Imported cut = ImportBytes(capture.substr(0, capture.size() - 10));
  EXPECT_EQ(cut.exit_code, 3);
  EXPECT_EQ(cut.SweepsOn("LIDAR_3D").size(), 2U) << "what came before is kept";
  EXPECT_EQ(ImportBytes(capture, {"--port", "70000"}).exit_code, 2);
}

// An LCM log without any packet or with a damaged one.
TEST(ImportVelodyne, RefusesLogsWithoutGoodPackets) {
  const TemporaryFile file;
  LogWriter writer(file.path());
  writer.Write(1, "ODOMETRY", pose_t{});
  writer.Flush();
  EXPECT_EQ(Imported("velodyne", file.path()).exit_code, 3);
  lidar_packet_t packet{};
  std::vector<uint8_t> bytes = Encode(packet);
  bytes.pop_back();
  writer.Write(2, "LIDAR_3D_PACKET", bytes);
  writer.Flush();
  EXPECT_EQ(Imported("velodyne", file.path()).exit_code, 3);
}

TEST(ImportVelodyne, RealCaptures) {
  for (const auto& [name, sweeps] : {std::pair("vlp16_gps.pcap", 3U), {"hdl32.pcap", 2U}, {"einride_vlp16.bin", 12U}}) {
    const auto path = RealData("packets") / name;
    if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not there";
    const Imported log("velodyne", path);
    EXPECT_EQ(log.exit_code, 0) << name;
    EXPECT_EQ(log.SweepsOn("LIDAR_3D").size(), sweeps) << name;
  }
}

}  // namespace
}  // namespace lcmslam

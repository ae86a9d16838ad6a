#include "sensors/velodyne_reader.h"

#include <random>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sensors/bad_input.h"
#include "support/temporary_file.h"
#include "support/velodyne_capture.h"

namespace lcmslam {
namespace {

using testing::HasSubstr;

struct Outcome {
  std::vector<Sweep> sweeps;
  int64_t packets = 0;
  int64_t refused = 0;
  std::string error;
};

Outcome Read(const std::string& bytes, uint16_t port = 0) {
  const TemporaryFile file(bytes);
  Outcome outcome;
  try {
    VelodyneReader reader(file.path(), port);
    while (std::optional<Sweep> sweep = reader.Next()) outcome.sweeps.push_back(*std::move(sweep));
    outcome.packets = reader.packets();
    outcome.refused = reader.refused();
  } catch (const BadInput& error) {
    outcome.error = error.what();
  }
  return outcome;
}

TEST(VelodyneReader, BareAndCapturedAreTheSame) {
  const std::vector<std::string> payloads = VelodyneTurns(3);
  const Outcome bare = Read(Joined(payloads));
  ASSERT_EQ(bare.sweeps.size(), 1u) << "the second of three turns: the first has no cut before, the last none behind";
  EXPECT_EQ(bare.packets, 216);
  for (const uint32_t link_type : {1U, 101U, 113U, 276U}) {
    SCOPED_TRACE(link_type);
    CaptureBuilder capture(link_type);
    for (size_t i = 0; i < payloads.size(); ++i) {
      const std::string ip = UdpOverIp(payloads[i], 2368);
      const std::string frame = link_type == 1     ? Ethernet(ip, i % 2 == 0)
                                : link_type == 113 ? std::string(14, 's') + std::string("\x08\0", 2) + ip
                                : link_type == 276 ? std::string("\x08\0", 2) + std::string(18, 's') + ip
                                                   : ip;
      capture.Frame(7'000'000 + static_cast<int64_t>(i), frame);
    }
    const Outcome captured = Read(capture.Bytes());
    ASSERT_EQ(captured.sweeps.size(), 1u);
    EXPECT_EQ(captured.sweeps[0].points.size(), bare.sweeps[0].points.size());
    EXPECT_EQ(captured.sweeps[0].utime - 7'000'000, bare.sweeps[0].utime - 1'000'000);
  }
}

TEST(VelodyneReader, PassesOverWhatIsNoDataPacket) {
  const std::vector<std::string> payloads = VelodyneTurns(3);
  CaptureBuilder capture(1);
  for (const std::string& payload : payloads) {
    capture.Frame(0, Ethernet(UdpOverIp(std::string(512, 'g'), 8308)));
    capture.Frame(0, Ethernet(UdpOverIp(payload, 2368, 0x2000)));  // a fragment
    capture.Frame(0, Ethernet(UdpOverIp(payload, 9999)));          // another lidar
    capture.Frame(0, "short");
    capture.Frame(0, Ethernet("E"));
    capture.Frame(0, Ethernet(UdpOverIp(payload, 2368)));
  }
  const Outcome outcome = Read(capture.Bytes(), 2368);
  EXPECT_EQ(outcome.packets, 216);
  EXPECT_EQ(outcome.refused, 0);
  EXPECT_EQ(outcome.sweeps.size(), 1u);
}

TEST(VelodyneReader, CountsDamagedPackets) {
  std::vector<std::string> payloads = VelodyneTurns(3);
  payloads[50][300] = 'X';
  payloads[51][1205] = 'X';
  const Outcome outcome = Read(Joined(payloads));
  EXPECT_EQ(outcome.packets, 214);
  EXPECT_EQ(outcome.refused, 2);
}

TEST(VelodyneReader, SaysWhatIsWrongWithAFile) {
  EXPECT_THAT(Read(Joined(VelodyneTurns(3)).substr(0, 5000)).error, HasSubstr("ends in the middle of a packet"));
  EXPECT_FALSE(Read("").error.empty());
  EXPECT_FALSE(Read("neither capture nor payload").error.empty());
  CaptureBuilder capture(1);
  capture.Frame(0, Ethernet(UdpOverIp(VelodyneTurns(3)[0], 2368)));
  EXPECT_THAT(Read(capture.Bytes().substr(0, 600)).error, HasSubstr("truncated"));
  EXPECT_THAT(Read(CaptureBuilder(105).Bytes()).error, HasSubstr("link type 105"));  // 802.11
  EXPECT_THROW(VelodyneReader("no/such/file"), BadInput);
}

TEST(VelodyneReader, SurvivesMutation) {
  CaptureBuilder capture(1);
  for (const std::string& payload : VelodyneTurns(3)) capture.Frame(0, Ethernet(UdpOverIp(payload, 2368)));
  for (unsigned seed = 0; seed < 100; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    std::string bytes = seed % 2 == 0 ? capture.Bytes() : Joined(VelodyneTurns(3));
    for (int i = 0; i < 40; ++i) bytes[random() % bytes.size()] = static_cast<char>(random());
    const Outcome outcome = Read(bytes);
    EXPECT_LE(outcome.sweeps.size(), 20u);
  }
}

}  // namespace
}  // namespace lcmslam

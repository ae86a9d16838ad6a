#include "sensors/velodyne_reader.h"

#include <random>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sensors/bad_input.h"
#include "support/temporary_file.h"
#include "support/velodyne_builder.h"

namespace lcmslam {
namespace {

using testing::HasSubstr;

// Three turns in packets of 5 degrees.
std::vector<std::string> Payloads() {
  std::vector<std::string> payloads;
  for (uint32_t i = 0; i < 216; ++i) {
    VelodyneBuilder builder;
    for (uint32_t b = 0; b < 12; ++b) builder.azimuths[b] = static_cast<uint16_t>((500 * i + 42 * b) % 36'000);
    for (auto& block : builder.ranges) block.fill(1000);
    builder.stamp_us = 1'000'000 + 1389 * i;
    const std::vector<uint8_t> bytes = builder.Bytes();
    payloads.emplace_back(bytes.begin(), bytes.end());
  }
  return payloads;
}

void Put(std::string& bytes, uint64_t value, int count, bool network_order) {
  for (int i = 0; i < count; ++i) {
    const int shift = 8 * (network_order ? count - 1 - i : i);
    bytes.push_back(static_cast<char>(value >> shift));
  }
}

std::string UdpOverIp(const std::string& payload, uint16_t port, uint16_t fragment = 0) {
  std::string ip = "\x45" + std::string(1, '\0');
  Put(ip, 28 + payload.size(), 2, true);
  Put(ip, 0, 2, true);
  Put(ip, fragment, 2, true);
  ip += "\x40\x11" + std::string(10, '\0');
  for (const uint64_t value : {uint64_t{2368}, uint64_t{port}, 8 + payload.size(), size_t{0}}) Put(ip, value, 2, true);
  return ip + payload;
}

std::string Ethernet(const std::string& ip, bool vlan = false) {
  return std::string(12, 'm') + (vlan ? std::string("\x81\0\0\x07", 4) : "") + std::string("\x08\0", 2) + ip;
}

class CaptureBuilder {
 public:
  explicit CaptureBuilder(uint32_t link_type) {
    for (const uint64_t value : {0xA1B2C3D4U, 0x00040002U, 0U, 0U, 65535U, link_type}) Put(bytes_, value, 4, false);
  }
  void Frame(int64_t utime, const std::string& frame) {
    const auto bytes = frame.size();
    for (const uint64_t value : {static_cast<uint64_t>(utime / 1'000'000), static_cast<uint64_t>(utime % 1'000'000),
                                 uint64_t{bytes}, uint64_t{bytes}}) {
      Put(bytes_, value, 4, false);
    }
    bytes_ += frame;
  }
  const std::string& Bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

struct Outcome {
  std::vector<Sweep> sweeps;
  int64_t packets = 0;
  int64_t refused = 0;
  std::string error;
};

Outcome Read(const std::string& bytes, const VelodyneReaderOptions& options = {}) {
  const TemporaryFile file(bytes);
  Outcome outcome;
  try {
    VelodyneReader reader(file.path(), options);
    while (std::optional<Sweep> sweep = reader.Next()) outcome.sweeps.push_back(*std::move(sweep));
    outcome.packets = reader.packets();
    outcome.refused = reader.refused();
  } catch (const BadInput& error) {
    outcome.error = error.what();
  }
  return outcome;
}

std::string Joined(const std::vector<std::string>& parts) {
  std::string all;
  for (const std::string& part : parts) all += part;
  return all;
}

TEST(VelodyneReader, BareAndCapturedAreTheSame) {
  const std::vector<std::string> payloads = Payloads();
  const Outcome bare = Read(Joined(payloads));
  ASSERT_EQ(bare.sweeps.size(), 1u) << "the second of three turns: the first has no cut before, the last none behind";
  EXPECT_EQ(bare.packets, 216);
  for (const uint32_t link_type : {1U, 101U, 113U}) {
    SCOPED_TRACE(link_type);
    CaptureBuilder capture(link_type);
    for (size_t i = 0; i < payloads.size(); ++i) {
      const std::string ip = UdpOverIp(payloads[i], 2368);
      const std::string frame = link_type == 1     ? Ethernet(ip, i % 2 == 0)
                                : link_type == 113 ? std::string(14, 's') + std::string("\x08\0", 2) + ip
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
  const std::vector<std::string> payloads = Payloads();
  CaptureBuilder capture(1);
  for (const std::string& payload : payloads) {
    capture.Frame(0, Ethernet(UdpOverIp(std::string(512, 'g'), 8308)));
    capture.Frame(0, Ethernet(UdpOverIp(payload, 2368, 0x2000)));  // a fragment
    capture.Frame(0, Ethernet(UdpOverIp(payload, 9999)));          // another lidar
    capture.Frame(0, "short");
    capture.Frame(0, Ethernet("E"));
    capture.Frame(0, Ethernet(UdpOverIp(payload, 2368)));
  }
  const Outcome outcome = Read(capture.Bytes(), {.port = 2368});
  EXPECT_EQ(outcome.packets, 216);
  EXPECT_EQ(outcome.refused, 0);
  EXPECT_EQ(outcome.sweeps.size(), 1u);
}

TEST(VelodyneReader, CountsDamagedPackets) {
  std::vector<std::string> payloads = Payloads();
  payloads[50][300] = 'X';
  payloads[51][1205] = 'X';
  const Outcome outcome = Read(Joined(payloads));
  EXPECT_EQ(outcome.packets, 214);
  EXPECT_EQ(outcome.refused, 2);
}

TEST(VelodyneReader, SaysWhatIsWrongWithAFile) {
  EXPECT_THAT(Read(Joined(Payloads()).substr(0, 5000)).error, HasSubstr("ends in the middle of a packet"));
  EXPECT_FALSE(Read("").error.empty());
  EXPECT_FALSE(Read("neither capture nor payload").error.empty());
  CaptureBuilder capture(1);
  capture.Frame(0, Ethernet(UdpOverIp(Payloads()[0], 2368)));
  EXPECT_THAT(Read(capture.Bytes().substr(0, 600)).error, HasSubstr("truncated"));
  EXPECT_THROW(VelodyneReader("no/such/file"), BadInput);
}

TEST(VelodyneReader, SurvivesMutation) {
  CaptureBuilder capture(1);
  for (const std::string& payload : Payloads()) capture.Frame(0, Ethernet(UdpOverIp(payload, 2368)));
  for (unsigned seed = 0; seed < 100; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    std::string bytes = seed % 2 == 0 ? capture.Bytes() : Joined(Payloads());
    for (int i = 0; i < 40; ++i) bytes[random() % bytes.size()] = static_cast<char>(random());
    const Outcome outcome = Read(bytes);
    EXPECT_LE(outcome.sweeps.size(), 20u);
  }
}

}  // namespace
}  // namespace lcmslam

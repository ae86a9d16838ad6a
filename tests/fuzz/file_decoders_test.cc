// Every reader of files against mutated files: it reads on or refuses with one line, and never dies.

#include <functional>
#include <random>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <lcmslam/pose_t.hpp>

#include "bus/errors.h"
#include "bus/log_reader.h"
#include "bus/log_writer.h"
#include "common/config.h"
#include "sdf2d-slam/sdf2d_slam.pb.h"
#include "sdf2d/map_file.h"
#include "sensors/bad_input.h"
#include "sensors/carmen_log.h"
#include "sensors/input_file.h"
#include "sensors/kitti.h"
#include "sensors/pcd.h"
#include "sensors/ply.h"
#include "sensors/ros_point_cloud.h"
#include "sensors/rosbag_reader.h"
#include "sensors/velodyne_reader.h"
#include "support/as_bytes.h"
#include "support/rosbag_builder.h"
#include "support/sample_messages.h"
#include "support/temporary_file.h"
#include "support/velodyne_capture.h"
#include "trajectory/read.h"
#include "trajectory/relations.h"

namespace lcmslam {
namespace {

namespace fs = std::filesystem;

constexpr int kMutations = 10'000;

// "" or the one line with which the file was refused.
using Read = std::function<std::string(const fs::path&)>;

struct Decoder {
  std::string name;
  std::function<std::string()> good;  // bytes of a file that it reads
  Read read;
};
void PrintTo(const Decoder& decoder, std::ostream* out) { *out << decoder.name; }

std::string BytesOf(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

template <class Reader>
Read ReadsToTheEnd() {
  return [](const fs::path& path) {
    for (Reader reader(path); reader.Next();) {
    }
    return std::string();
  };
}

std::string CarmenLog() {
  std::string log = "PARAM robot_front_laser_max 81.90 nohost 0\n";
  for (int i = 0; i < 5; ++i) {
    log += fmt::format("ODOM 0.{0} 0 0.1 0.2 0 0 1.{0} nohost 1.{0}\n", i);
    log += "FLASER 181";
    for (int beam = 0; beam < 181; ++beam) log += fmt::format(" {:.2f}", 1.0 + 0.01 * beam);
    log += fmt::format(" 0.{0} 0 0.1 0.{0} 0 0.1 1.{0} nohost 1.{0}\n", i);
  }
  return log;
}

std::string Bag() {
  RosbagBuilder builder;
  for (int i = 0; i < 9; ++i) builder.Message("/scan", "sensor_msgs/LaserScan", 1'000'000 + i, std::string(50, 'x'));
  return builder.Bytes();
}

std::string PointCloudBag() {
  const std::vector<RosField> fields{{"x", 0}, {"y", 4}, {"z", 8}, {"time", 12}};
  RosBytes points;
  for (int i = 0; i < 40; ++i)
    points.Put(5.0F).Put(0.1F * static_cast<float>(i)).Put(0.0F).Put(0.002F * static_cast<float>(i));
  RosbagBuilder builder;
  for (int64_t utime : {1'000'000, 1'100'000, 1'200'000})
    builder.Message("/points", "sensor_msgs/PointCloud2", utime,
                    RosPointCloudBytes(utime, "lidar", fields, 16, points.data()));
  return builder.Bytes();
}

std::string ReadPointCloudBag(const fs::path& path) {
  RosbagReader reader(path);
  while (const auto message = reader.Next()) {
    try {
      (void)ToSweep(DecodeRosPointCloud(message->data));
    } catch (const BadInput& error) {
      throw BadInput(path.string() + ": " + error.what());
    }
  }
  return "";
}

std::string KittiPoints() {
  const std::vector<float> numbers(400, 1.25F);
  return {reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(float)};
}

std::string KittiTimes() {
  std::string text;
  for (int i = 0; i < 20; ++i) text += fmt::format("{}.5\n2011-09-26 13:02:{}.25\n", i, 10 + i);
  return text;
}

std::string KittiPoses() {
  std::string text;
  for (int i = 0; i < 20; ++i) text += fmt::format("1 0 0 {} 0 1 0 0.5 0 0 1 0\n", i);
  return text;
}

std::vector<std::string> VelodynePackets() {
  std::vector<std::string> payloads = VelodyneTurns(1);
  payloads.resize(10);
  return payloads;
}

constexpr char kPcdHeader[] = "VERSION .7\nFIELDS x y z ring\nSIZE 4 4 4 2\nTYPE F F F U\nCOUNT 1 1 1 1\nPOINTS 20\n";

std::string PcdFile() {
  std::string text = std::string(kPcdHeader) + "DATA ascii\n";
  for (int i = 0; i < 20; ++i) text += fmt::format("{} 0.5 -1 {}\n", i, i % 16);
  return text;
}

std::string BinaryPcdFile() { return std::string(kPcdHeader) + "DATA binary\n" + std::string(20 * 14, '\0'); }

// LZF: a count less one, then as many bytes as they are.
std::string CompressedPcdFile() {
  constexpr uint32_t kBytes = 20 * 14, kRun = 28;
  std::string body;
  for (uint32_t i = 0; i < kBytes; i += kRun) body += static_cast<char>(kRun - 1) + std::string(kRun, '\0');
  const uint32_t sizes[] = {static_cast<uint32_t>(body.size()), kBytes};
  return std::string(kPcdHeader) + "DATA binary_compressed\n" +
         std::string(reinterpret_cast<const char*>(sizes), sizeof(sizes)) + body;
}

std::string PlyFile() {
  std::string text =
      "ply\nformat binary_little_endian 1.0\nelement vertex 20\nproperty float x\nproperty float y\n"
      "property float z\nend_header\n";
  return text + std::string(240, '\x3f');
}

std::string PlyMeshFile() { return BytesOf(fs::path(LCMSLAM_SOURCE_DIR) / "replay/episodes/ramp.ply"); }

std::string_view TextOf(std::span<const uint8_t> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

// A reader that knows bytes, not names.
template <class Parse>
Read ReadsBytes(const Parse& parse) {
  return [parse](const fs::path& path) {
    const std::string bytes = ReadInput(path);
    try {
      parse(AsBytes(bytes));
    } catch (const BadInput& error) {
      throw BadInput(path.string() + ": " + error.what());
    }
    return std::string();
  };
}

std::string LcmLog() {
  const TemporaryFile file;
  std::mt19937_64 random(7);
  LogWriter writer(file.path());
  for (int i = 0; i < 20; ++i) writer.Write(1000 * i, "GROUND_TRUTH", RandomMessage<pose_t>(random));
  writer.Flush();
  return BytesOf(file.path());
}

std::string ReadLcmLog(const fs::path& path) {
  LogReader reader(path);
  for (Event event; reader.Next(event);) {
  }
  return reader.DamageReport();
}

std::string TumFile() {
  std::string lines = "# timestamp tx ty tz qx qy qz qw\n";
  for (int i = 0; i < 20; ++i) lines += fmt::format("{}.5 {} 0.25 0 0 0 0.6 0.8\n", 100 + i, 0.1 * i);
  return lines;
}

std::string RelationFileText() {
  std::string lines;
  for (int i = 0; i < 20; ++i) lines += fmt::format("{}.5 {}.75 0.5 -0.25 0 0 0 0.125\n", 100 + i, 101 + i);
  return lines;
}

std::string SdfMapFile() {
  sdf2d::SdfMap map(0.05);
  map.BeginRevision();
  auto& sheet = map.Touch(0, 0).sheets[0];
  sheet.distance_m.fill(0.1F);
  sheet.information.fill(1.0F);
  map.Touch(-1, 2);
  const TemporaryFile file;
  EXPECT_EQ(sdf2d::WriteMap(map, file.path()), "");
  return BytesOf(file.path());
}

std::string ReadSdfMap(const fs::path& path) {
  std::string error;
  return sdf2d::ReadMap(path, &error) ? "" : error;
}

std::string ReadConfig(const fs::path& path) {
  config::Sdf2dSlam config;
  LoadConfig(path, config);
  return "";
}

std::vector<Decoder> Decoders() {
  const auto config = [] { return BytesOf(fs::path(LCMSLAM_SOURCE_DIR) / "services/sdf2d-slam/sdf2d-slam.pbtxt"); };
  return {
      {"Carmen", CarmenLog, ReadsToTheEnd<CarmenReader>()},
      {"Rosbag", Bag, ReadsToTheEnd<RosbagReader>()},
      {"PointCloudBag", PointCloudBag, ReadPointCloudBag},
      {"VelodyneCapture", [] { return VelodyneCapture(VelodynePackets(), 1'000'000); },
       ReadsToTheEnd<VelodyneReader>()},
      {"VelodynePayloads", [] { return Joined(VelodynePackets()); }, ReadsToTheEnd<VelodyneReader>()},
      {"KittiPoints", KittiPoints, ReadsBytes([](auto bytes) { (void)DecodeKittiPoints(bytes); })},
      {"KittiTimes", KittiTimes, ReadsBytes([](auto bytes) { (void)ParseKittiTimes(TextOf(bytes)); })},
      {"KittiPoses", KittiPoses, ReadsBytes([](auto bytes) { (void)ParseKittiPoses(TextOf(bytes)); })},
      {"KittiCalibration", [] { return std::string("P0: 1 0 0\nTr: 0 -1 0 0 0 0 -1 0 1 0 0 0.3\n"); },
       ReadsBytes([](auto bytes) { (void)ParseKittiCalibration(TextOf(bytes)); })},
      {"Pcd", PcdFile, ReadsBytes([](auto bytes) { (void)ToSweepPoints(ParsePcd(bytes)); })},
      {"BinaryPcd", BinaryPcdFile, ReadsBytes([](auto bytes) { (void)ToSweepPoints(ParsePcd(bytes)); })},
      {"CompressedPcd", CompressedPcdFile, ReadsBytes([](auto bytes) { (void)ToSweepPoints(ParsePcd(bytes)); })},
      {"PlyMesh", PlyMeshFile, ReadsBytes([](auto bytes) { (void)ParsePlyMesh(bytes); })},
      {"Ply", PlyFile, ReadsBytes([](auto bytes) { (void)ToSweepPoints(ParsePly(bytes)); })},
      {"LcmLog", LcmLog, ReadLcmLog},
      {"Tum", TumFile, [](const fs::path& path) { return ReadTrajectory(path).error; }},
      {"Relations", RelationFileText, [](const fs::path& path) { return ReadRelations(path).error; }},
      {"SdfMap", SdfMapFile, ReadSdfMap},
      {"Config", config, ReadConfig},
  };
}

std::string WhyRefused(const Decoder& decoder, const fs::path& path) {
  try {
    return decoder.read(path);
  } catch (const BadInput& error) {
    return error.what();
  } catch (const CommandError& error) {
    return error.what();
  }
}

class FileDecoder : public testing::TestWithParam<Decoder> {};

TEST_P(FileDecoder, ReadsOrRefusesWithOneLine) {
  std::mt19937_64 random(1);
  const std::string good = GetParam().good();
  {
    const TemporaryFile file(good);
    ASSERT_EQ(WhyRefused(GetParam(), file.path()), "");
  }
  int refused = 0;
  for (int i = 0; i < kMutations; ++i) {
    SCOPED_TRACE(i);
    const std::vector<uint8_t> bytes = Mutate({good.begin(), good.end()}, random);
    const TemporaryFile file(std::string(bytes.begin(), bytes.end()));
    const std::string line = WhyRefused(GetParam(), file.path());
    if (line.empty()) continue;
    ++refused;
    EXPECT_THAT(line, testing::HasSubstr(file.path().string()));
    EXPECT_THAT(line, testing::Not(testing::HasSubstr("\n")));
  }
  EXPECT_GT(refused, kMutations / 20);
}

INSTANTIATE_TEST_SUITE_P(Every, FileDecoder, testing::ValuesIn(Decoders()),
                         [](const auto& decoder) { return decoder.param.name; });

}  // namespace
}  // namespace lcmslam

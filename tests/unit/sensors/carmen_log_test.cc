#include "sensors/carmen_log.h"

#include <cmath>
#include <fstream>
#include <numbers>
#include <random>
#include <set>
#include <sstream>

#include <boost/iostreams/copy.hpp>
#include <boost/iostreams/filter/bzip2.hpp>
#include <boost/iostreams/filter/gzip.hpp>
#include <boost/iostreams/filtering_stream.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "geometry/angles.h"
#include "sensors/bad_input.h"
#include "support/error_of.h"
#include "support/real_data.h"
#include "support/temporary_file.h"

namespace lcmslam {
namespace {

using testing::HasSubstr;

constexpr const char* kTail = " 12.345678 robot 0.5\n";

// FLASER with n ranges of 1 m, laser pose (9 9 9), odometry (1 2 0.5).
std::string Flaser(int n, const std::string& name = "FLASER") {
  std::string line = name + " " + std::to_string(n);
  for (int i = 0; i < n; ++i) line += " 1.0";
  return line + " 9 9 9 1 2 0.5" + kTail;
}

std::vector<CarmenRecord> ReadAll(const std::filesystem::path& path, const CarmenOptions& options = {}) {
  CarmenReader reader(path, options);
  std::vector<CarmenRecord> records;
  while (auto record = reader.Next()) records.push_back(*record);
  return records;
}

CarmenScan ReadScan(const std::string& text, const CarmenOptions& options = {}) {
  const TemporaryFile file(text);
  const auto records = ReadAll(file.path(), options);
  EXPECT_EQ(records.size(), 1U);
  return std::get<CarmenScan>(records.at(0));
}

std::string RefusalOf(const std::string& bytes) {
  const TemporaryFile file(bytes, ".clf");
  return ErrorOf([&] { ReadAll(file.path()); });
}

template <class Compressor>
std::string Compress(const std::string& text, const Compressor& compressor) {
  std::istringstream in(text);
  std::ostringstream out;
  boost::iostreams::filtering_ostream stream;
  stream.push(compressor);
  stream.push(out);
  boost::iostreams::copy(in, stream);
  stream.reset();
  return out.str();
}

TEST(CarmenLog, FrontLaser) {
  const CarmenScan record = ReadScan("PARAM robot_frontlaser_offset 0.25 host 0\n" + Flaser(181));
  EXPECT_EQ(record.sensor, "FLASER");
  EXPECT_EQ(record.scan.utime, 12'345'678);
  EXPECT_EQ(record.T_robot_laser.x(), 0.25);
  EXPECT_EQ(record.T_odom_robot.y(), 2.0);
  EXPECT_EQ(record.T_odom_robot.yaw(), 0.5);
  EXPECT_EQ(record.scan.beams.size(), 181U);
}

TEST(CarmenLog, BeamCountTellsTheResolution) {
  for (const auto& [n, step_deg] : {std::pair{180, 1.0}, {181, 1.0}, {360, 0.5}, {361, 0.5}}) {
    const std::vector<Beam> beams = ReadScan(Flaser(n)).scan.beams;
    ASSERT_EQ(beams.size(), static_cast<size_t>(n));
    for (int i = 0; i < n; ++i) EXPECT_NEAR(beams[i].angle_rad, DegToRad(-90.0 + i * step_deg), 1e-6);
  }
}

TEST(CarmenLog, RearLaserLooksBack) {
  const CarmenScan record = ReadScan("PARAM robot_rearlaser_offset -0.3\n" + Flaser(180, "RLASER"));
  EXPECT_EQ(record.sensor, "RLASER");
  EXPECT_EQ(record.T_robot_laser.x(), -0.3);
  EXPECT_NEAR(std::abs(record.T_robot_laser.yaw()), std::numbers::pi, 1e-12);
}

TEST(CarmenLog, MaximumRangeIsNoReturn) {
  const std::string line = "FLASER 6 1.5 49.99 50.0 80.0 81.83 nan 0 0 0 0 0 0" + std::string(kTail);
  const auto returns = [](const CarmenScan& record) {
    std::string seen;
    for (const Beam& beam : record.scan.beams) seen += beam.HasReturn() ? '1' : '0';
    return seen;
  };
  EXPECT_EQ(returns(ReadScan(line)), "110000");
  EXPECT_EQ(returns(ReadScan("PARAM robot_front_laser_max 80.99\n" + line)), "111100");
  EXPECT_EQ(returns(ReadScan(line, {.max_range_m = 10.0})), "100000");
}

TEST(CarmenLog, RobotLaserHasItsOwnAnglesLimitAndMounting) {
  const CarmenScan record = ReadScan(
      "ROBOTLASER1 4 -2.0 4.0 0.5 30.0 0.01 0 3 1.0 2.0 30.0 2 7 8 1.0 1.0 1.5707963 1.0 0.8 1.5707963 "
      "0 0 0.1 0.1 0" +
      std::string(kTail));
  EXPECT_EQ(record.sensor, "ROBOTLASER1");
  ASSERT_EQ(record.scan.beams.size(), 3U);
  EXPECT_NEAR(record.scan.beams[2].angle_rad, -1.0, 1e-6);
  EXPECT_TRUE(record.scan.beams[1].HasReturn());
  EXPECT_FALSE(record.scan.beams[2].HasReturn());
  EXPECT_NEAR(record.T_robot_laser.x(), 0.2, 1e-7);
  EXPECT_NEAR(record.T_robot_laser.y(), 0.0, 1e-7);
  EXPECT_NEAR(record.T_odom_robot.y(), 0.8, 1e-12);
}

TEST(CarmenLog, OdometryAndTruthInTheOrderOfTheFile) {
  const TemporaryFile file(
      "# comment\n\nODOM 1 2 0.5 0.1 0 0 7.5 host 1\r\nTRUEPOS 3 4 -0.5 0 0 0 7.25 host 1\nSYNC tag 1 host 1\n");
  const auto records = ReadAll(file.path());
  ASSERT_EQ(records.size(), 2U);
  EXPECT_EQ(std::get<CarmenOdometry>(records[0]).utime, 7'500'000);
  EXPECT_EQ(std::get<CarmenOdometry>(records[0]).T_odom_robot.yaw(), 0.5);
  EXPECT_EQ(std::get<CarmenTruth>(records[1]).utime, 7'250'000);
  EXPECT_EQ(std::get<CarmenTruth>(records[1]).T_world_robot.x(), 3.0);
}

TEST(CarmenLog, CompressedOrNotIsTheSame) {
  std::string text;
  for (int i = 0; i < 50; ++i) text += Flaser(100 + i);
  for (const std::string& bytes : {text, Compress(text, boost::iostreams::gzip_compressor()),
                                   Compress(text, boost::iostreams::bzip2_compressor())}) {
    const TemporaryFile file(bytes);
    const auto records = ReadAll(file.path());
    ASSERT_EQ(records.size(), 50U);
    EXPECT_EQ(std::get<CarmenScan>(records[49]).scan.beams.size(), 149U);
  }
}

TEST(CarmenLog, MalformedLinesAreNamed) {
  const std::string ok = Flaser(3);
  EXPECT_THAT(RefusalOf(ok + "FLASER 5 1 2 3\n"), HasSubstr(".clf:2: FLASER announces 5 values, but only 3 follow"));
  EXPECT_THAT(RefusalOf(ok + ok + "FLASER 4 1 1 1 9 9 9 1 2 3 1.5 host 1\n"), HasSubstr(".clf:3: FLASER has"));
  EXPECT_THAT(RefusalOf("FLASER\n"), HasSubstr(".clf:1: FLASER ends early"));
  EXPECT_THAT(RefusalOf("\n#\nODOM 1 2 x 0 0 0 1 host 1\n"), HasSubstr(".clf:3: 'x' is not a number"));
  EXPECT_THAT(RefusalOf("ODOM 1 2 3 0 0 0 nan host 1\n"), HasSubstr("'nan' is no time"));
  EXPECT_THAT(RefusalOf("ODOM 1 2 3 0 0 0 1e300 host 1\n"), HasSubstr("'1e300' is no time"));
  EXPECT_THAT(RefusalOf("FLASER 4294967295 1" + std::string(kTail)), HasSubstr("announces 4294967295"));
  EXPECT_THAT(RefusalOf("FLASER -1 1" + std::string(kTail)), HasSubstr("'-1' is not a number"));
  EXPECT_THAT(RefusalOf("ROBOTLASER1 4 -2.0 4.0 0.5 30.0 0.01 0 3 1 2 3\n"), HasSubstr("ROBOTLASER1 ends early"));
  EXPECT_THAT(RefusalOf(std::string(5 << 20, 'x')), HasSubstr("longer than any line"));
  EXPECT_EQ(RefusalOf(""), "");
}

TEST(CarmenLog, MissingFilesAndDamagedCompression) {
  EXPECT_THROW(CarmenReader("/no/such/file.clf"), BadInput);
  EXPECT_THROW(CarmenReader(std::filesystem::temp_directory_path()), BadInput);
  std::string text;
  for (int i = 0; i < 3000; ++i) text += Flaser(1 + i % 180);
  for (std::string bytes :
       {Compress(text, boost::iostreams::gzip_compressor()), Compress(text, boost::iostreams::bzip2_compressor())}) {
    EXPECT_THAT(RefusalOf(bytes.substr(0, bytes.size() / 2)), HasSubstr("damaged compression"));
    bytes[bytes.size() / 2] = static_cast<char>(~bytes[bytes.size() / 2]);
    EXPECT_NE(RefusalOf(bytes), "");
  }
}

TEST(CarmenLog, SurvivesMutation) {
  const std::string text = "PARAM robot_frontlaser_offset 0.25 host 0\n" + Flaser(20) + "ODOM 1 2 3 0 0 0 1 host 1\n" +
                           "ROBOTLASER1 4 -2 4 0.5 30 0.01 0 3 1 2 30 2 7 8 1 1 1.5 1 0.8 1.5 0 0 0.1 0.1 0" + kTail;
  std::mt19937 random(1);
  int refused = 0;
  for (int i = 0; i < 2000; ++i) {
    std::string bytes = text;
    for (int k = 0; k < 3; ++k) bytes[random() % bytes.size()] = static_cast<char>(random());
    if (!RefusalOf(bytes).empty()) ++refused;
  }
  EXPECT_GT(refused, 1000);
}

// Every stamp of the relations is the stamp of a scan.
TEST(CarmenLog, RealRelationsMatchScans) {
  for (const auto& [name, num_scans, offset_m] : {std::tuple{"fr079", 4934, -0.04}, {"aces", 7374, 0.0}}) {
    SCOPED_TRACE(name);
    const auto log = RealData(std::string("radish/") + name + ".clf.bz2");
    if (!std::filesystem::exists(log)) GTEST_SKIP() << log << " is not there";
    std::set<int64_t> stamps;
    int scans = 0;
    for (CarmenReader reader(log); const auto record = reader.Next();) {
      if (const auto* scan = std::get_if<CarmenScan>(&*record)) {
        ++scans;
        stamps.insert(scan->scan.utime);
        ASSERT_EQ(scan->T_robot_laser.x(), offset_m);
      }
    }
    EXPECT_EQ(scans, num_scans);
    std::ifstream relations(RealData(std::string("radish/") + name + ".relations"));
    int matched = 0;
    for (std::string line; std::getline(relations, line); ++matched) {
      double t1 = 0.0, t2 = 0.0;
      ASSERT_TRUE(std::istringstream(line) >> t1 >> t2);
      EXPECT_TRUE(stamps.contains(std::llround(t1 * 1e6))) << line;
      EXPECT_TRUE(stamps.contains(std::llround(t2 * 1e6))) << line;
    }
    EXPECT_GT(matched, 1000);
  }
}

}  // namespace
}  // namespace lcmslam

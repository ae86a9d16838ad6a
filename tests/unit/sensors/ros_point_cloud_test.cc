#include "sensors/ros_point_cloud.h"

#include <limits>
#include <random>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sensors/bad_input.h"
#include "sensors/ros_messages.h"
#include "support/as_bytes.h"
#include "support/error_of.h"
#include "support/ros_bytes.h"

namespace lcmslam {
namespace {

using testing::HasSubstr;

constexpr int64_t kUtime = 1'600'000'000'000'000;

Sweep SweepOf(const std::string& bytes) { return ToSweep(DecodeRosPointCloud(AsBytes(bytes))); }

std::string RefusalOf(const std::string& bytes) {
  return ErrorOf([&] { (void)SweepOf(bytes); });
}

// As velodyne_pointcloud writes them: x, y, z, intensity, ring, time, with padding.
const std::vector<RosField> kVelodyneFields{
    {"x", 0}, {"y", 4}, {"z", 8}, {"intensity", 16}, {"ring", 20, RosField::kUint16}, {"time", 24}};
std::string VelodynePoint(float x, uint16_t ring, float time_s) {
  return RosBytes()
      .Put(x)
      .Put(2.0F)
      .Put(3.0F)
      .Put(uint32_t{7})
      .Put(50.0F)
      .Put(ring)
      .Put(uint16_t{7})
      .Put(time_s)
      .data();
}

TEST(RosPointCloud, VelodyneCountsTimesFromTheStamp) {
  const Sweep sweep = SweepOf(RosPointCloudBytes(kUtime, "/velodyne", kVelodyneFields, 28,
                                                 VelodynePoint(4, 3, 0.1F) + VelodynePoint(5, 0, 0.0F)));
  EXPECT_EQ(sweep.utime, kUtime + 100'000);
  ASSERT_EQ(sweep.points.size(), 2U);
  EXPECT_EQ(sweep.points[0].x, 5.0F) << "in the order of time";
  EXPECT_EQ(sweep.points[0].dt_us, -100'000);
  EXPECT_EQ(sweep.points[1].ring, 3);
  EXPECT_EQ(sweep.points[1].intensity, 50.0F);
  EXPECT_EQ(sweep.points[1].dt_us, 0);
}

TEST(RosPointCloud, VelodyneMayStampTheLastPoint) {
  const Sweep sweep = SweepOf(RosPointCloudBytes(kUtime, "velodyne", kVelodyneFields, 28,
                                                 VelodynePoint(4, 3, -0.1F) + VelodynePoint(5, 0, 0.0F)));
  EXPECT_EQ(sweep.utime, kUtime);
  EXPECT_EQ(sweep.points[0].dt_us, -100'000);
}

TEST(RosPointCloud, OusterCountsNanosecondsAndWritesZerosForNoReturn) {
  const std::vector<RosField> fields{{"x", 0},
                                     {"y", 4},
                                     {"z", 8},
                                     {"t", 12, RosField::kUint32},
                                     {"reflectivity", 16, RosField::kUint16},
                                     {"ring", 18, RosField::kUint8}};
  const auto point = [](float x, uint32_t t_ns) {
    return RosBytes().Put(x).Put(0.0F).Put(0.0F).Put(t_ns).Put(uint16_t{300}).Put(uint8_t{9}).Put(uint8_t{0}).data();
  };
  const Sweep sweep = SweepOf(
      RosPointCloudBytes(kUtime, "os_sensor", fields, 20, point(1, 0) + point(0, 50'000'000) + point(2, 99'000'000)));
  EXPECT_EQ(sweep.utime, kUtime + 99'000);
  ASSERT_EQ(sweep.points.size(), 2U);
  EXPECT_EQ(sweep.points[0].dt_us, -99'000);
  EXPECT_EQ(sweep.points[0].intensity, 300.0F);
  EXPECT_EQ(sweep.points[0].ring, 9);
}

TEST(RosPointCloud, HesaiCountsSecondsSince1970) {
  const std::vector<RosField> fields{{"x", 0}, {"y", 4}, {"z", 8}, {"timestamp", 12, RosField::kFloat64}};
  const auto points = [](double first_s) {
    std::string bytes;
    for (const double time_s : {first_s, first_s + 0.1})
      bytes += RosBytes().Put(1.0F).Put(2.0F).Put(3.0F).Put(time_s).data();
    return bytes;
  };
  const Sweep sweep = SweepOf(RosPointCloudBytes(kUtime, "hesai", fields, 20, points(1.6e9 - 0.05)));
  EXPECT_NEAR(static_cast<double>(sweep.utime - kUtime), 50'000, 1);
  EXPECT_NEAR(sweep.points[0].dt_us, -100'000, 1);
  const Sweep other_clock = SweepOf(RosPointCloudBytes(kUtime, "hesai", fields, 20, points(5e5)));
  EXPECT_EQ(other_clock.utime, kUtime) << "the sensor's clock was never set";
  EXPECT_NEAR(other_clock.points[0].dt_us, -100'000, 1);
}

TEST(RosPointCloud, TimesOfWhatIsNoReturnDoNotCount) {
  const std::vector<RosField> fields{{"x", 0}, {"y", 4}, {"z", 8}, {"timestamp", 12, RosField::kFloat64}};
  const auto point = [](float x, double time_s) { return RosBytes().Put(x).Put(x).Put(x).Put(time_s).data(); };
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const Sweep sweep = SweepOf(RosPointCloudBytes(
      kUtime, "organized", fields, 20,
      point(nan, 0.0) + point(1.0F, 1.6e9 - 0.1) + point(0.0F, 2e9) + point(nan, nan) + point(2.0F, 1.6e9)));
  ASSERT_EQ(sweep.points.size(), 2U);
  EXPECT_EQ(sweep.utime, kUtime);
  EXPECT_NEAR(sweep.points[0].dt_us, -100'000, 1);
  EXPECT_EQ(sweep.points[1].dt_us, 0);
}

TEST(RosPointCloud, PointsMayHaveNothingButCoordinates) {
  const std::vector<RosField> fields{
      {"x", 0, RosField::kFloat64}, {"y", 8, RosField::kFloat64}, {"z", 16, RosField::kFloat64}};
  const auto point = [](double x) { return RosBytes().Put(x).Put(2.0).Put(3.0).data(); };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Sweep sweep = SweepOf(RosPointCloudBytes(kUtime, "map", fields, 24, point(1) + point(nan)));
  EXPECT_EQ(sweep.utime, kUtime);
  ASSERT_EQ(sweep.points.size(), 1U);
  EXPECT_EQ(sweep.points[0].ring, -1);
  EXPECT_TRUE(SweepOf(RosPointCloudBytes(kUtime, "map", fields, 24, "")).points.empty());
}

TEST(RosPointCloud, RowsMayBePadded) {
  const std::string points =
      RosBytes().Put(1.0F).Put(0.0F).Put(0.0F).Put(7.0F).Put(2.0F).Put(0.0F).Put(0.0F).Put(7.0F).data();
  RosBytes bytes;
  bytes.PutHeader(kUtime, "rows").Put(uint32_t{2}).Put(uint32_t{1}).Put(uint32_t{3});
  for (uint32_t i = 0; i < 3; ++i)
    bytes.PutString(std::string(1, static_cast<char>('x' + i))).Put(4 * i).Put(uint8_t{7}).Put(uint32_t{1});
  bytes.Put(uint8_t{0}).Put(uint32_t{12}).Put(uint32_t{16}).PutString(points).Put(uint8_t{1});
  const Sweep sweep = SweepOf(bytes.data());
  ASSERT_EQ(sweep.points.size(), 2U);
  EXPECT_EQ(sweep.points[1].x, 2.0F);
}

TEST(RosPointCloud, SaysWhatIsWrong) {
  const std::string point = VelodynePoint(1, 0, 0);
  const std::string good = RosPointCloudBytes(kUtime, "v", kVelodyneFields, 28, point);
  EXPECT_EQ(RefusalOf(good), "");
  EXPECT_THAT(RefusalOf(good + "x"), HasSubstr("1 bytes more"));
  EXPECT_THAT(RefusalOf(good.substr(0, good.size() - 9)), HasSubstr("shorter"));
  EXPECT_THAT(RefusalOf(RosPointCloudBytes(kUtime, "v", {{"x", 25}}, 28, point)), HasSubstr("field x beyond"));
  EXPECT_THAT(RefusalOf(RosPointCloudBytes(kUtime, "v", {{"x", 0}, {"x", 4}}, 28, point)), HasSubstr("x twice"));
  EXPECT_THAT(RefusalOf(RosPointCloudBytes(kUtime, "v", {{"x", 0}, {"y", 4}}, 28, point)), HasSubstr("without z"));
  EXPECT_THAT(RefusalOf(RosPointCloudBytes(kUtime, "v", {{"x", 0, static_cast<RosField::Type>(9)}}, 28, point)),
              HasSubstr("unknown type 9"));
}

TEST(RosPointCloud, MutatedBytesAreRefusedOrRead) {
  std::string good;
  for (int i = 0; i < 20; ++i) good += VelodynePoint(static_cast<float>(i), 1, 0.005F * static_cast<float>(i));
  good = RosPointCloudBytes(kUtime, "v", kVelodyneFields, 28, good);
  std::mt19937 random(1);
  int refused = 0;
  for (int i = 0; i < 10'000; ++i) {
    std::string bytes = good;
    for (unsigned n = 1 + random() % 3; n > 0; --n) bytes[random() % bytes.size()] = static_cast<char>(random());
    if (random() % 10 == 0) bytes.resize(random() % bytes.size());
    const std::string error = RefusalOf(bytes);
    EXPECT_EQ(error.find('\n'), std::string::npos);
    refused += error.empty() ? 0 : 1;
  }
  EXPECT_GT(refused, 500);
  EXPECT_LT(refused, 9'500);
}

TEST(RosImu, ReadsRatesAndForces) {
  const std::string bytes = RosImuBytes(kUtime, "imu", {0.1, 0.2, 0.3}, {1, 2, 9.8});
  const ImuSample sample = DecodeRosImu(AsBytes(bytes));
  EXPECT_EQ(sample.utime, kUtime);
  EXPECT_EQ(sample.angular_velocity_radps, Eigen::Vector3d(0.1, 0.2, 0.3));
  EXPECT_EQ(sample.specific_force_mps2, Eigen::Vector3d(1, 2, 9.8));
  for (size_t size = 0; size < bytes.size(); size += 7)
    EXPECT_THROW((void)DecodeRosImu(AsBytes(bytes).first(size)), BadInput) << size;
}

}  // namespace
}  // namespace lcmslam

// The captures of ../shared/data. The VLP-16s stood still; the HDL-32E rode on a vehicle at about 3 m/s.

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <vector>

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include "geometry/angles.h"
#include "sensors/velodyne_reader.h"
#include "support/real_data.h"

namespace lcmslam {
namespace {

struct Capture {
  const char* name;
  int64_t packets;
  size_t sweeps;
  double turn_us;
  double shots_per_turn;
  int64_t first_second;  // in which the first packet came
};

class RealVelodyne : public testing::TestWithParam<Capture> {
 protected:
  void SetUp() override {
    const std::filesystem::path path = RealData("packets") / GetParam().name;
    if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not there";
    VelodyneReader reader(path);
    while (std::optional<Sweep> sweep = reader.Next()) sweeps_.push_back(*std::move(sweep));
    packets_ = reader.packets();
    refused_ = reader.refused();
  }

  std::vector<Sweep> sweeps_;
  int64_t packets_ = 0;
  int64_t refused_ = 0;
};

// Empty where the capture is not there.
std::vector<Sweep> ReadSweeps(const char* name) {
  std::vector<Sweep> sweeps;
  const std::filesystem::path path = RealData("packets") / name;
  if (!std::filesystem::exists(path)) return sweeps;
  VelodyneReader reader(path);
  while (std::optional<Sweep> sweep = reader.Next()) sweeps.push_back(*std::move(sweep));
  return sweeps;
}

double Median(std::vector<double> values) {
  std::ranges::sort(values);
  return values[values.size() / 2];
}

// Ranges by ring and azimuth, in steps of 0.2 degrees.
std::map<std::pair<int, int>, double> RangeImage(const Sweep& sweep) {
  std::map<std::pair<int, int>, double> image;
  for (const SweepPoint& p : sweep.points) {
    const int column = static_cast<int>(std::lround(RadToDeg(std::atan2(p.y, p.x)) / 0.2));
    image[{p.ring, column}] = std::hypot(p.x, p.y, p.z);
  }
  return image;
}

TEST_P(RealVelodyne, EveryPacketIsDecodedToWholeSweeps) {
  const Capture& c = GetParam();
  EXPECT_EQ(packets_, c.packets);
  EXPECT_EQ(refused_, 0);
  ASSERT_EQ(sweeps_.size(), c.sweeps);
  EXPECT_NEAR(1e-6 * static_cast<double>(sweeps_[0].utime) - static_cast<double>(c.first_second), 0.5, 0.5);
  for (size_t i = 0; i < sweeps_.size(); ++i) {
    const Sweep& sweep = sweeps_[i];
    EXPECT_LT(static_cast<double>(sweep.points.size()), c.shots_per_turn);
    EXPECT_GT(static_cast<double>(sweep.points.size()), 0.5 * c.shots_per_turn);
    EXPECT_NEAR(sweep.points.front().dt_us, -c.turn_us, 2e-3 * c.turn_us);
    EXPECT_EQ(sweep.points.back().dt_us, 0);
    EXPECT_TRUE(std::ranges::is_sorted(sweep.points, {}, &SweepPoint::dt_us));
    if (i > 0) {
      EXPECT_NEAR(static_cast<double>(sweep.utime - sweeps_[i - 1].utime), c.turn_us, 2e-3 * c.turn_us);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Captures, RealVelodyne,
                         testing::Values(Capture{"vlp16_gps.pcap", 293, 3, 1e5, 29'000, 1'453'364'282},
                                         Capture{"hdl32.pcap", 500, 2, 1.1064e5, 77'000, 1'319'768'048},
                                         Capture{"einride_vlp16.bin", 1000, 12, 1e5, 29'000, 2666}),
                         [](const auto& capture) {
                           std::string name = capture.param.name;
                           std::ranges::replace(name, '.', '_');
                           return name;
                         });

// The same ranges in every sweep, to the sensor's own noise.
TEST(StandingVelodyne, SeesTheSameInEverySweep) {
  for (const char* name : {"vlp16_gps.pcap", "einride_vlp16.bin"}) {
    const std::vector<Sweep> sweeps = ReadSweeps(name);
    if (sweeps.empty()) GTEST_SKIP() << name << " is not there";
    const auto first = RangeImage(sweeps.front());
    std::vector<double> difference_m, absolute_m;
    for (const auto& [pixel, range_m] : RangeImage(sweeps.back())) {
      const auto same = first.find(pixel);
      if (same == first.end()) continue;
      difference_m.push_back(range_m - same->second);
      absolute_m.push_back(std::abs(range_m - same->second));
    }
    ASSERT_GT(difference_m.size(), 10'000u) << name;
    EXPECT_LT(std::abs(Median(difference_m)), 1e-3) << name;
    EXPECT_LT(Median(absolute_m), 0.01) << name;
  }
}

// The root mean square distance of the chosen points from the plane that fits them best.
double Unevenness(const Sweep& sweep, const std::function<bool(const SweepPoint&)>& chosen) {
  std::vector<Eigen::Vector3d> points;
  for (const SweepPoint& p : sweep.points) {
    if (chosen(p)) points.emplace_back(p.x, p.y, p.z);
  }
  Eigen::MatrixXd centred(3, points.size());
  for (size_t i = 0; i < points.size(); ++i) centred.col(static_cast<Eigen::Index>(i)) = points[i];
  centred.colwise() -= centred.rowwise().mean().eval();
  const Eigen::Matrix3d scatter = centred * centred.transpose() / static_cast<double>(points.size());
  return std::sqrt(Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(scatter).eigenvalues()[0]);
}

// All lasers together see planes as planes: angles, heights and firing times fit.
TEST(RealSurfaces, ARoomsWallByTheVlp16) {
  const std::vector<Sweep> sweeps = ReadSweeps("vlp16_gps.pcap");
  if (sweeps.empty()) GTEST_SKIP() << "the capture is not there";
  EXPECT_LT(Unevenness(sweeps[0], [](const SweepPoint& p) { return p.x < -1.3F && p.y > -1.1F && p.y < 0.4F; }), 0.02);
}

TEST(RealSurfaces, AYardByTheHdl32e) {
  const std::vector<Sweep> sweeps = ReadSweeps("hdl32.pcap");
  if (sweeps.empty()) GTEST_SKIP() << "the capture is not there";
  const auto on_ground = [](const SweepPoint& p) {
    return p.x > 2.0F && p.x < 6.0F && p.y > -3.0F && p.y < 0.0F && p.ring <= 10;
  };
  EXPECT_LT(Unevenness(sweeps[0], on_ground), 0.04);
}

}  // namespace
}  // namespace lcmslam

#include "sensors/arrange_points.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace lcmslam {
namespace {

TEST(ArrangePoints, DropsWhatIsNoReturn) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN(), kInf = std::numeric_limits<float>::infinity();
  std::vector<SweepPoint> points{{.x = kNan}, {.x = 1.0F}, {.z = kInf}, {}, {.intensity = 9.0F}, {.z = -2.0F}};
  DropNoReturns(points);
  ASSERT_EQ(points.size(), 2U);
  EXPECT_EQ(points[0].x, 1.0F);
  EXPECT_EQ(points[1].z, -2.0F);
  points.clear();
  DropNoReturns(points);
  EXPECT_TRUE(points.empty());
}

// What a laser at rest sees at a range, off its axis by the laser's height.
SweepPoint Seen(const Laser& laser, double range_m, double azimuth_rad) {
  const double across_m = range_m * std::cos(laser.elevation_rad);
  return {.x = static_cast<float>(across_m * std::cos(azimuth_rad)),
          .y = static_cast<float>(across_m * std::sin(azimuth_rad)),
          .z = static_cast<float>(range_m * std::sin(laser.elevation_rad) + laser.height_m)};
}

TEST(ArrangePoints, RingsAreThoseOfTheLasers) {
  for (const char* name : {"vlp16", "hdl32e", "hdl64e", "os1-64"}) {
    SCOPED_TRACE(name);
    const MultiLineModel model = *NamedMultiLineModel(name);
    for (const double range_m : {0.5, 3.0, 80.0}) {
      std::vector<SweepPoint> points;
      for (const Laser& laser : model.lasers) points.push_back(Seen(laser, range_m, 0.1 * laser.ring));
      SetRingsByElevation(model, points);
      for (size_t i = 0; i < points.size(); ++i) EXPECT_EQ(points[i].ring, model.lasers[i].ring) << range_m;
    }
  }
}

TEST(ArrangePoints, RingsStayUnknownOffTheLasers) {
  std::vector<SweepPoint> points{{.x = 1.0F, .z = 1.0F},
                                 {.x = 1.0F, .z = -1.0F},
                                 {.x = std::numeric_limits<float>::quiet_NaN()},
                                 {.x = 1.0F, .z = 0.001F, .ring = 99}};
  SetRingsByElevation(VelodyneVlp16(), points);
  for (size_t i = 0; i < 3; ++i) EXPECT_EQ(points[i].ring, -1);
  EXPECT_EQ(points[3].ring, 99) << "the file knows better";
}

TEST(ArrangePoints, SortsByTimeAndKeepsEqualsInOrder) {
  std::vector<SweepPoint> points{{.x = 1.0F, .dt_us = 0}, {.x = 2.0F, .dt_us = -5}, {.x = 3.0F, .dt_us = -5}};
  SortByTime(points);
  EXPECT_EQ(points[0].x, 2.0F);
  EXPECT_EQ(points[1].x, 3.0F);
  EXPECT_EQ(points[2].x, 1.0F);
}

}  // namespace
}  // namespace lcmslam

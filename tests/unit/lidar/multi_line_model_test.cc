#include "lidar/multi_line_model.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "geometry/angles.h"

namespace lcmslam {
namespace {

TEST(MultiLineModel, BeamsAndRatesOfTheManuals) {
  const auto shots_per_turn = [](const MultiLineModel& m) {
    return static_cast<double>(m.lasers.size()) * 1e6 * m.turn_s / m.firing_cycle_us;
  };
  EXPECT_NEAR(shots_per_turn(VelodyneVlp16()), 28'900, 100);    // 300,000 shots a second less the idle cycle time
  EXPECT_NEAR(shots_per_turn(VelodyneHdl32e()), 69'450, 100);   // 700,000 a second
  EXPECT_NEAR(shots_per_turn(VelodyneHdl64e()), 133'333, 100);  // 1.333 million a second
  EXPECT_NEAR(shots_per_turn(OusterOs1_64()), 65'536, 1e-6);    // 1024 columns

  const MultiLineModel vlp16 = VelodyneVlp16();
  EXPECT_NEAR(RadToDeg(vlp16.lasers[0].elevation_rad), -15.0, 1e-9);
  EXPECT_NEAR(RadToDeg(vlp16.lasers[1].elevation_rad), 1.0, 1e-9);
  EXPECT_NEAR(RadToDeg(vlp16.lasers[15].elevation_rad), 15.0, 1e-9);
  EXPECT_NEAR(RadToDeg(VelodyneHdl32e().lasers[1].elevation_rad), -9.33, 0.01);
  EXPECT_NEAR(RadToDeg(VelodyneHdl32e().lasers[31].elevation_rad), 10.67, 0.01);
}

TEST(MultiLineModel, RingsCountUpwards) {
  for (const std::string_view name : {"vlp16", "hdl32e", "hdl64e", "os1-64"}) {
    SCOPED_TRACE(name);
    MultiLineModel model = *NamedMultiLineModel(name);
    EXPECT_EQ(model.Validate(), "");
    std::ranges::sort(model.lasers, {}, &Laser::ring);
    for (size_t i = 0; i < model.lasers.size(); ++i) {
      EXPECT_EQ(model.lasers[i].ring, static_cast<int16_t>(i));
      if (i > 0) {
        EXPECT_GT(model.lasers[i].elevation_rad, model.lasers[i - 1].elevation_rad);
      }
    }
  }
  EXPECT_FALSE(NamedMultiLineModel("vlp32").has_value());
}

}  // namespace
}  // namespace lcmslam

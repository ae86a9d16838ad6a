#include "common/scan_input.h"

#include <gtest/gtest.h>
#include <lcmslam/planar_lidar_t.hpp>
#include <lcmslam/planar_scan_t.hpp>
#include <lcmslam/pose_t.hpp>
#include <lcmslam/rigid_transform_t.hpp>

#include "bus/messages.h"

namespace lcmslam {
namespace {

class ScanInputTest : public testing::Test {
 protected:
  ScanInput Make(const std::string& channel = "", bool mounting_configured = false) {
    return {channel, mounting_configured, [this](const Pose2& T) { mountings_.push_back(T); },
            [this](const PlanarScan& scan) { scans_.push_back(scan.utime); }};
  }
  static Event Scan(const std::string& channel, int64_t utime) {
    return {utime, channel, Encode(ToMessage(PlanarScan{utime, {{1.0F, 0.0F, 0}}}))};
  }
  static Event Extrinsics(const std::string& channel) {
    return {0, channel, Encode(ExtrinsicsMessage(0, ToPose3({0.5, 0.0, 1.0})))};
  }

  std::vector<Pose2> mountings_;
  std::vector<int64_t> scans_;
};

TEST_F(ScanInputTest, HoldsScansUntilTheMountingIsKnown) {
  ScanInput input = Make();
  EXPECT_EQ(input.Offer(Scan("LIDAR_2D", 100)), Handled::kAccepted);
  EXPECT_TRUE(scans_.empty());
  EXPECT_EQ(input.Offer(Extrinsics("LIDAR_2D_EXTRINSICS")), Handled::kAccepted);
  ASSERT_EQ(mountings_.size(), 1U);
  EXPECT_EQ(mountings_[0].x(), 0.5);
  EXPECT_EQ(input.Offer(Scan("LIDAR_2D", 200)), Handled::kAccepted);
  EXPECT_EQ(scans_, (std::vector<int64_t>{100, 200}));
  EXPECT_EQ(input.Offer(Extrinsics("LIDAR_2D_EXTRINSICS")), Handled::kIgnored) << "repeated for late joiners";
}

TEST_F(ScanInputTest, GivesUpWaitingAfterAWhile) {
  ScanInput input = Make();
  for (int64_t t = 0; t <= 1'500'000; t += 500'000) input.Offer(Scan("LIDAR_2D", t));
  EXPECT_TRUE(scans_.empty());
  input.Offer(Scan("LIDAR_2D", 2'000'000));
  EXPECT_EQ(scans_.size(), 5U);
  EXPECT_EQ(mountings_.size(), 1U);
}

TEST_F(ScanInputTest, FlushLosesNothing) {
  ScanInput input = Make();
  input.Offer(Scan("LIDAR_2D", 7));
  input.Flush();
  EXPECT_EQ(scans_, std::vector<int64_t>{7});
}

TEST_F(ScanInputTest, TakesAnyChannelThatCarriesScans) {
  ScanInput input = Make("", true);
  EXPECT_EQ(input.Offer({0, "POSE", Encode(ToMessage(StampedPose{}))}), Handled::kIgnored);
  EXPECT_EQ(input.Offer(Scan("RPLIDAR_LASER", 1)), Handled::kAccepted);
  EXPECT_EQ(input.channel(), "RPLIDAR_LASER");
  EXPECT_EQ(input.Offer(Scan("OTHER_LASER", 2)), Handled::kIgnored);
  EXPECT_EQ(input.Offer(Scan("LIDAR_2D", 2)), Handled::kIgnored);
  EXPECT_EQ(scans_, std::vector<int64_t>{1});
}

TEST_F(ScanInputTest, FurtherLidarsOnlyByName) {
  ScanInput automatic = Make("", true);
  EXPECT_EQ(automatic.Offer(Scan("LIDAR_2D_BACK", 1)), Handled::kIgnored);
  ScanInput named = Make("LIDAR_2D_BACK");
  EXPECT_EQ(named.Offer(Extrinsics("LIDAR_2D_EXTRINSICS")), Handled::kIgnored);
  EXPECT_EQ(named.Offer(Extrinsics("LIDAR_2D_BACK_EXTRINSICS")), Handled::kAccepted);
  EXPECT_EQ(named.Offer(Scan("LIDAR_2D_BACK", 1)), Handled::kAccepted);
  EXPECT_EQ(scans_.size(), 1U);
}

TEST_F(ScanInputTest, RefusesRubbishOnItsChannel) {
  ScanInput input = Make("", true);
  EXPECT_EQ(input.Offer({0, "LIDAR_2D", {1, 2, 3}}), Handled::kRefused);
  Event cut = Scan("RPLIDAR_LASER", 1);
  cut.data.pop_back();
  EXPECT_EQ(input.Offer(cut), Handled::kIgnored) << "not ours until it has carried a scan";
  input.Offer(Scan("RPLIDAR_LASER", 2));
  EXPECT_EQ(input.Offer(cut), Handled::kRefused);
}

}  // namespace
}  // namespace lcmslam

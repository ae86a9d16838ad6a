#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/temporary_file.h"
#include "trajectory/read.h"
#include "trajectory/text_lines.h"
#include "trajectory/write.h"
#include "unit/trajectory/trajectories.h"

namespace lcmslam {
namespace {

using ::testing::EndsWith;
using ::testing::HasSubstr;

class ReadWrite : public ::testing::Test {
 protected:
  std::filesystem::path Path(const std::string& name) const { return folder_.path() / name; }
  std::filesystem::path Write(const std::string& name, const std::string& text) const {
    std::ofstream(Path(name), std::ios::binary) << text;
    return Path(name);
  }
  TrajectoryFile Read(const std::string& text) const { return ReadTrajectory(Write("t.txt", text)); }

  // Every stamp exact, every number within the nine decimals.
  static void ExpectSame(const Trajectory& a, const Trajectory& b) {
    ASSERT_EQ(a.size(), b.size());
    for (size_t i = 0; i < a.size(); ++i) {
      SCOPED_TRACE(i);
      EXPECT_EQ(a[i].utime, b[i].utime);
      EXPECT_LT((a[i].pose.translation - b[i].pose.translation).cwiseAbs().maxCoeff(), 1e-9);
      EXPECT_LT(AngleBetween(a[i].pose.rotation, b[i].pose.rotation), 1e-8);
    }
  }

 private:
  const TemporaryFolder folder_;
};

Trajectory Flight(int64_t start_utime) { return testing::Sample(testing::Flight, 20.0, 0.0371, start_utime); }

TEST_F(ReadWrite, EveryFormatComesBack) {
  const Trajectory t = Flight(1'411'657'682'042'859);
  ASSERT_EQ(WriteTum(Path("tum"), t), "");
  ExpectSame(ReadTrajectory(Path("tum")).trajectory, t);
  ASSERT_EQ(WriteEuroc(Path("euroc"), t), "");
  ExpectSame(ReadTrajectory(Path("euroc")).trajectory, t);
  ASSERT_EQ(WriteKitti(Path("kitti"), t, Path("times")), "");
  ExpectSame(ReadTrajectory(Path("kitti"), {.kitti_times = Path("times")}).trajectory, t);
}

TEST_F(ReadWrite, KittiWithoutTimesCountsUp) {
  const Trajectory t = Flight(0);
  ASSERT_EQ(WriteKitti(Path("kitti"), t), "");
  const Trajectory read = ReadTrajectory(Path("kitti"), {.kitti_period_us = 500'000}).trajectory;
  ASSERT_EQ(read.size(), t.size());
  EXPECT_EQ(read[3].utime, 1'500'000);
}

TEST_F(ReadWrite, PlanarText) {
  const TrajectoryFile file = Read("# t x y theta\n1411657682.042859 0.5 -2 1.5\n\n1411657682.167484 0 0 -3\n");
  ASSERT_EQ(file.error, "");
  ASSERT_EQ(file.trajectory.size(), 2u);
  EXPECT_EQ(file.trajectory[0].utime, 1'411'657'682'042'859);
  EXPECT_NEAR(Yaw(file.trajectory[0].pose.rotation), 1.5, 1e-12);
}

TEST_F(ReadWrite, EvosExponentsAndWindowsLineEnds) {
  const TrajectoryFile file = Read("1.403636580863555431e+09 1 2 3 0 0 0 1\r\n1.403636581e9 1e-1 2 3 0 0 0 1\r\n");
  ASSERT_EQ(file.error, "");
  EXPECT_EQ(file.trajectory[0].utime, 1'403'636'580'863'555);
  EXPECT_EQ(file.trajectory[1].pose.translation.x(), 0.1);
}

TEST_F(ReadWrite, EurocWithVelocitiesAndBiases) {
  const TrajectoryFile file = Read(
      "#timestamp, p_RS_R_x [m], ...\n"
      "1403636580838555648,4.688319,-1.786938,0.783338,0.534108,-0.153029,-0.827383,-0.082152,-0.02,0.03,0.08,-0,0,"
      "0\n");
  ASSERT_EQ(file.error, "");
  EXPECT_EQ(file.trajectory[0].utime, 1'403'636'580'838'556);
  EXPECT_NEAR(file.trajectory[0].pose.rotation.w(), 0.534108, 1e-5);
}

TEST_F(ReadWrite, ErrorsNameFileAndLine) {
  const struct {
    const char* text;
    const char* error;
  } cases[] = {
      {"1 0 0 0 0 0 0 1\n2 0 0 nan 0 0 0 1\n", "t.txt:2: not a finite number: 'nan'"},
      {"1 0 0 0 0 0 0 1\n2 0 0 -inf 0 0 0 1\n", "t.txt:2: not a finite number: '-inf'"},
      {"# c\n\n1 0 0 0 0 0 0 1\n1.0000001 0 0 0 0 0 0 1\n", "t.txt:4: stamp repeats that of the pose before"},
      {"2 0 0 0 0 0 0 1\n1.5 0 0 0 0 0 0 1\n", "t.txt:2: stamp steps back by 0.500000 s"},
      {"1 0 0 0 0 0 0 1\n2 0 0 0 0 0 1\n",
       "t.txt:2: 8 numbers expected (TUM: timestamp tx ty tz qx qy qz qw), found 7"},
      {"1 0 0 0 0 0 0 0\n", "t.txt:1: quaternion of length 0"},
      {"1 0 0 0 0 0 0 1.2\n", "t.txt:1: quaternion of length 1.2"},
      {"now 0 0 0 0 0 0 1\n", "t.txt:1: not a stamp in seconds: 'now'"},
      {"nan 0 0 0 0 0 0 1\n", "t.txt:1: not a stamp in seconds: 'nan'"},
      {"1 2 3\n", "t.txt:1: not a TUM, planar, EuRoC or KITTI trajectory"},
      {"1e9,1,2,3,1,0,0,0\n", "t.txt:1: not a stamp in nanoseconds: '1e9'"},
      {"1 0 0 0 0 1 0 0 0 0 2 0\n", "t.txt:1: the 3x3 part is not a rotation"},
      {"-1 0 0 0 0 1 0 0 0 0 1 0\n", "t.txt:1: the 3x3 part is not a rotation"},
      {"", "t.txt: no poses"},
      {"# only a comment\n", "t.txt: no poses"},
  };
  for (const auto& c : cases) {
    SCOPED_TRACE(c.text);
    const TrajectoryFile file = Read(c.text);
    EXPECT_THAT(file.error, EndsWith(c.error));
    EXPECT_TRUE(file.trajectory.empty());
  }
}

TEST_F(ReadWrite, MissingFilesFoldersAndRubbish) {
  EXPECT_THAT(ReadTrajectory("/nowhere/t.txt").error, HasSubstr("/nowhere/t.txt: cannot open: No such file"));
  EXPECT_NE(ReadTrajectory(::testing::TempDir()).error, "");
  EXPECT_THAT(WriteTum("/nowhere/t.txt", Flight(0)), HasSubstr("/nowhere/t.txt: cannot write"));
  testing::Noise noise(1);
  std::string rubbish(200'000, '\0');
  for (char& c : rubbish) c = static_cast<char>(noise.Uniform(0, 256));
  EXPECT_THAT(Read(rubbish).error, HasSubstr("t.txt:1: "));
  EXPECT_THAT(Read(std::string(200'000, '\x01')).error, HasSubstr("t.txt:1: line too long: not a text file"));
}

TEST_F(ReadWrite, KittiStampsHaveErrorsOfTheirOwn) {
  ASSERT_EQ(WriteKitti(Path("kitti"), testing::Sample(testing::Flight, 1.0, 0.5)), "");
  EXPECT_THAT(ReadTrajectory(Path("kitti"), {.kitti_times = Write("times", "0\nx\n2\n")}).error,
              HasSubstr("times:2: not a stamp in seconds: 'x'"));
  EXPECT_THAT(ReadTrajectory(Path("kitti"), {.kitti_times = Write("times", "0\n1\n")}).error,
              HasSubstr("kitti:3: no stamp left for this pose"));
}

TEST(ParseSecondsAsMicroseconds, ExactOnDecimals) {
  const struct {
    const char* text;
    int64_t us;
  } cases[] = {{"0", 0},
               {"-0.000001", -1},
               {".5", 500'000},
               {"3.", 3'000'000},
               {"+2.5", 2'500'000},
               {"9223372036.854775", 9'223'372'036'854'775},
               {"1411657682.0428594", 1'411'657'682'042'859},
               {"1411657682.0428595", 1'411'657'682'042'860},
               {"1000000000000.123456", 1'000'000'000'000'123'456}};
  for (const auto& c : cases) EXPECT_EQ(ParseSecondsAsMicroseconds(c.text), c.us) << c.text;
  for (const char* bad : {"", ".", "-", "1.2.3", "1,5", "0x10", "inf", "99999999999999", "1e300", "--1", "+-1"}) {
    EXPECT_FALSE(ParseSecondsAsMicroseconds(bad)) << bad;
  }
}

TEST(FormatTum, EveryStampComesBack) {
  testing::Noise noise(3);
  for (int k = 0; k < 1000; ++k) {
    const auto utime = static_cast<int64_t>(noise.Uniform(-1e18, 1e18));
    const std::string line = FormatTum({utime, {}});
    EXPECT_EQ(ParseSecondsAsMicroseconds(line.substr(0, line.find(' '))), utime);
  }
  EXPECT_EQ(FormatTum({1'500'000, {}}),
            "1.500000000 0.000000000 0.000000000 0.000000000 0.000000000 0.000000000 0.000000000 1.000000000\n");
}

}  // namespace
}  // namespace lcmslam

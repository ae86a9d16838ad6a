#include <cmath>
#include <fstream>

#include <gtest/gtest.h>
#include <lcmslam/pose_t.hpp>

#include "bus/log_writer.h"
#include "bus/messages.h"
#include "support/temporary_file.h"
#include "trajectory/read.h"
#include "trajectory/write.h"
#include "unit/evaluator/run_evaluator.h"

namespace lcmslam {
namespace {

constexpr int64_t kStart = 1'600'000'000'000'000;

Trajectory Spiral() {
  Trajectory t;
  for (int k = 0; k < 200; ++k) {
    const Eigen::AngleAxisd turn(0.05 * k, Eigen::Vector3d(1.0, 2.0, 3.0).normalized());
    t.push_back({kStart + k * 100'003, {{std::cos(0.1 * k), std::sin(0.1 * k), 0.01 * k}, Eigen::Quaterniond(turn)}});
  }
  return t;
}

void ExpectSame(const Trajectory& a, const Trajectory& b) {
  ASSERT_EQ(a.size(), b.size());
  for (size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].utime, b[i].utime);
    EXPECT_LT((a[i].pose.translation - b[i].pose.translation).norm(), 3e-9);
    EXPECT_LT(AngleBetween(a[i].pose.rotation, b[i].pose.rotation), 1e-8);
  }
}

testing::Outcome Convert(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), "convert");
  return testing::RunEvaluator(arguments);
}

TEST(Convert, EveryFormatToEveryOther) {
  const TemporaryFolder folder;
  const auto path = [&](const std::string& name) { return (folder.path() / name).string(); };
  ASSERT_EQ(WriteTum(path("0.tum"), Spiral()), "");
  ASSERT_EQ(Convert({path("0.tum"), path("1.csv")}).code, 0);
  ASSERT_EQ(Convert({path("1.csv"), path("2.kitti")}).code, 0);
  ASSERT_EQ(Convert({path("2.kitti"), path("3.txt"), "--kitti-times", path("2_times.txt")}).code, 0);
  ASSERT_EQ(Convert({path("3.txt"), path("4.txt"), "--to", "kitti"}).code, 0);
  ASSERT_EQ(Convert({path("4.txt"), path("5.txt"), "--kitti-times", path("4_times.txt"), "--to", "euroc"}).code, 0);
  for (const char* name : {"1.csv", "3.txt", "5.txt"}) {
    SCOPED_TRACE(name);
    ExpectSame(ReadTrajectory(path(name)).trajectory, Spiral());
  }
  EXPECT_EQ(ReadTrajectory(path("5.txt"), {.format = TrajectoryFormat::kEuroc}).error, "");
}

TEST(Convert, PosesOfALog) {
  const TemporaryFolder folder;
  const std::string log = folder.path() / "run.lcm", out = folder.path() / "poses.tum";
  {
    LogWriter writer(log);
    for (const StampedPose& pose : Spiral()) writer.Write(pose.utime, "SDF2D_POSE", ToMessage(pose));
    writer.Flush();
  }
  ASSERT_EQ(Convert({log, out, "--channel", "SDF2D_POSE"}).code, 0);
  ExpectSame(ReadTrajectory(out).trajectory, Spiral());
  EXPECT_EQ(Convert({log, out, "--channel", "NONE"}).code, 4);
}

TEST(Convert, SaysInOneLineWhatIsWrong) {
  const TemporaryFile nan("1 nan 0 0 0 0 0 1\n", ".tum"), good("1 0 0 0 0 0 0 1\n", ".tum");
  const TemporaryFile out;
  testing::ExpectRefused({"convert", nan.path(), out.path()}, 3,
                         nan.path().string() + ":1: not a finite number: 'nan'");
  testing::ExpectRefused({"convert", good.path(), "/nowhere/x.tum"}, 1, "/nowhere/x.tum: cannot write");
  testing::ExpectRefused({"convert", good.path(), "x", "--to", "matlab"}, 2, "matlab not in");
}

}  // namespace
}  // namespace lcmslam

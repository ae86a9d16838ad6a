// What the evaluator says to files that are wrong, in every format it reads: one line that names file and line.
#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <lcmslam/pose_t.hpp>

#include "bus/log_writer.h"
#include "bus/messages.h"
#include "support/temporary_file.h"
#include "unit/evaluator/circle_run.h"
#include "unit/evaluator/run_evaluator.h"

namespace lcmslam {
namespace {

using testing::ExpectRefused;
using ::testing::HasSubstr;

constexpr int kBadInput = 3, kNothingMatched = 4;

std::vector<std::string> Files(const TemporaryFile& estimate, const TemporaryFile& reference) {
  return {"--estimate", estimate.path(), "--reference", reference.path()};
}

// The file is refused as the estimate and as the reference.
void ExpectBadFile(const TemporaryFile& file, int code, const std::string& error) {
  const TemporaryFile good = testing::TumFile(testing::Reference());
  ExpectRefused(Files(file, good), code, error);
  ExpectRefused(Files(good, file), code, error);
}

struct BadText {
  std::string text;
  std::string error;  // after the file's name
};

TEST(BadInput, TumAndEurocFiles) {
  const BadText cases[] = {
      {"1 0 0 0 0 0 0 1\n2 nan 0 0 0 0 0 1\n", ":2: not a finite number: 'nan'"},
      {"1 0 0 0 0 0 0 1\n2 inf 0 0 0 0 0 1\n", ":2: not a finite number: 'inf'"},
      {"# tum\n1 0 0 0 0 0 0 1\n3 0 0 0 0 0 0 1\n2 0 0 0 0 0 0 1\n", ":4: stamp steps back by 1.000000 s"},
      {"1 0 0 0 0 0 0 1\n1 0 0 0 0 0 0 1\n", ":2: stamp repeats that of the pose before"},
      {"", ": no poses"},
      {"# tum\n\n", ": no poses"},
      {"1 0 0 0 0 0 0 1\n\x01\x02\xff\n", ":2: 8 numbers expected"},
      {"1000000000,0,0,0,1,0,0,0\n2000000000,0,NaN,0,1,0,0,0\n", ":2: not a finite number: 'NaN'"},
      {"#euroc\n3000000000,0,0,0,1,0,0,0\n2000000000,0,0,0,1,0,0,0\n", ":3: stamp steps back by 1.000000 s"},
      {"1000000000,0,0,0,1,0,0,0\n1000000000,0,0,0,1,0,0,0\n", ":2: stamp repeats that of the pose before"},
      {"#timestamp,x,y,z,qw,qx,qy,qz\n", ": no poses"},
      {"1000000000,0,0,0,1,0,0,0\n\x01,\x02\n", ":2: 8 numbers expected"},
      {std::string("\x7f"
                   "ELF\x02\x01\x01\0\0\0\n",
                   11),
       ":1: not a TUM, planar, EuRoC or KITTI trajectory"},
      {std::string(100'000, '\0'), ":1: line too long: not a text file"},
  };
  for (const BadText& c : cases) {
    const TemporaryFile file(c.text, ".txt");
    ExpectBadFile(file, kBadInput, file.path().string() + c.error);
  }
}

TEST(BadInput, KittiFilesAndTheirStamps) {
  const std::string good = "1 0 0 0 0 1 0 0 0 0 1 0\n";
  for (const BadText& c : {BadText{good + "1 0 0 nan 0 1 0 0 0 0 1 0\n", ":2: not a finite number: 'nan'"},
                           BadText{good + "1 0 0 0 0 1 0 0 0 0 2 0\n", ":2: the 3x3 part is not a rotation"},
                           BadText{good + "\x01\x02\n", ":2: 12 numbers expected"}}) {
    const TemporaryFile file(c.text, ".kitti");
    ExpectBadFile(file, kBadInput, file.path().string() + c.error);
  }
  const TemporaryFile poses(good + good + good, ".kitti"), reference = testing::TumFile(testing::Reference());
  for (const BadText& c : {BadText{"1\nnan\n3\n", ":2: not a stamp in seconds: 'nan'"},
                           BadText{"1\n3\n2\n", ":3: stamp steps back by 1.000000 s"},
                           BadText{"1\n2\n2\n", ":3: stamp repeats that of the pose before"},
                           BadText{"\x01\x02\n", ":1: not a stamp in seconds: '"}}) {
    const TemporaryFile times(c.text, ".txt");
    std::vector<std::string> arguments = Files(poses, reference);
    arguments.insert(arguments.end(), {"--kitti-times", times.path()});
    ExpectRefused(arguments, kBadInput, times.path().string() + c.error);
  }
  const TemporaryFile too_few("1\n2\n");
  std::vector<std::string> arguments = Files(poses, reference);
  arguments.insert(arguments.end(), {"--kitti-times", too_few.path()});
  ExpectRefused(arguments, kBadInput, poses.path().string() + ":3: no stamp left for this pose");
}

TEST(BadInput, NoOverlapInAnyFormat) {
  const TemporaryFile reference = testing::TumFile(testing::Reference());
  for (const char* text :
       {"1 0 0 0 0 0 0 1\n", "1000000000,0,0,0,1,0,0,0\n", "1 0 0 0\n", "1 0 0 0 0 1 0 0 0 0 1 0\n"}) {
    const TemporaryFile file(text, ".txt");
    ExpectRefused(Files(file, reference), kNothingMatched, "no pose of " + file.path().string() + " (");
    ExpectRefused(Files(file, reference), kNothingMatched, "(1600000000.000 to 1600000040.000 s)");
  }
}

class BadLog : public ::testing::Test {
 protected:
  // GROUND_TRUTH is good.
  void Write(const std::vector<StampedPose>& estimate) const {
    LogWriter writer(log_.path());
    for (const StampedPose& pose : estimate) writer.Write(pose.utime, "SDF2D_POSE", ToMessage(pose));
    for (int64_t k = 0; k < 10; ++k) writer.Write(k, "GROUND_TRUTH", ToMessage(StampedPose{k * 100'000, {}}));
    writer.Flush();
  }
  std::string path() const { return log_.path(); }
  std::vector<std::string> Arguments() const { return {"--log-in", path(), "--estimate", "SDF2D_POSE", "--quiet"}; }

  TemporaryFile log_;
};

TEST_F(BadLog, NothingButNaN) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Write({{100'000, {{nan, 0.0, 0.0}, Eigen::Quaterniond::Identity()}},
         {200'000, {{0.0, 0.0, 0.0}, Eigen::Quaterniond(0.0, 0.0, 0.0, 0.0)}}});
  ExpectRefused(Arguments(), kNothingMatched, path() + ": no poses on SDF2D_POSE: 2 malformed");
}

TEST_F(BadLog, ClockThatStepsBack) {
  Write({{5'000'000, {}}, {6'000'000, {}}, {1'000'000, {}}});
  ExpectRefused(Arguments(), kBadInput,
                path() + ": SDF2D_POSE: the clock steps back by 5.000 s after pose 2; cut the log there");
}

TEST_F(BadLog, RepeatedAndSwappedStampsAreLeftOutAndSaid) {
  Write({{100'000, {}}, {300'000, {}}, {300'000, {}}, {200'000, {}}, {400'000, {}}});
  const testing::Outcome run = testing::RunEvaluator(Arguments());
  EXPECT_EQ(run.code, 0) << run.error;
  EXPECT_THAT(run.out, HasSubstr("3 poses, 2 out of order left out"));
}

TEST_F(BadLog, NoOverlap) {
  Write({{100'000'000, {}}, {101'000'000, {}}});
  ExpectRefused(Arguments(), kNothingMatched, "no pose of SDF2D_POSE in " + path() + " (100.000 to 101.000 s)");
}

TEST_F(BadLog, EmptyLogAndRubbish) {
  const TemporaryFile empty, rubbish(std::string(1000, '\x5a'));
  ExpectRefused({"--log-in", empty.path(), "--estimate", "SDF2D_POSE", "--quiet"}, kBadInput,
                empty.path().string() + ": not an LCM log");
  ExpectRefused({"--log-in", rubbish.path(), "--estimate", "SDF2D_POSE", "--quiet"}, kBadInput,
                rubbish.path().string());
}

TEST(BadInput, ChannelsAndFlags) {
  const TemporaryFile estimate = testing::TumFile(testing::Estimate(0.02)), log, out;
  const TemporaryFile reference = testing::TumFile(testing::Reference());
  testing::WriteLog(log.path(), testing::Estimate(0.02), testing::Reference());
  const auto channels = [&](const char* e, const char* r) {
    return std::vector<std::string>{"--log-in", log.path(), "--estimate", e, "--reference", r, "--quiet"};
  };
  const auto with = [&](std::vector<std::string> more) {
    const std::vector<std::string> files = Files(estimate, reference);
    more.insert(more.begin(), files.begin(), files.end());
    return more;
  };
  ExpectRefused({"--estimate", "/none.tum", "--reference", reference.path()}, 3,
                "/none.tum: cannot open: No such file");
  ExpectRefused(channels("OCTO3D_POSE", "GROUND_TRUTH"), 4, ": no poses on OCTO3D_POSE\n");
  ExpectRefused(channels("SDF2D_POSE", "TRUE_POSE"), 4, ": no poses on TRUE_POSE\n");
  ExpectRefused(channels("SDF2D_POSE|GROUND_TRUTH", "GROUND_TRUTH"), 2, "matches GROUND_TRUTH and SDF2D_POSE\n");
  ExpectRefused(channels("(", "GROUND_TRUTH"), 2, "channel '(': not a regular expression\n");
  ExpectRefused({"--estimate", estimate.path()}, 2, "--reference FILE or --relations FILE: required\n");
  ExpectRefused(with({"--align", "sim3"}), 2, "--align: sim3 not in {auto,none,first,yaw,se2,se3,calibrate}\n");
  ExpectRefused(with({"--max-gap", "-1"}), 2, "association.max_gap_us: must be positive\n");
  ExpectRefused(with({"--min-coverage", "95"}), 2, "thresholds.min_coverage: must be in 0..1\n");
  ExpectRefused(with({"--config", "/tmp"}), 2, "/tmp: cannot be read\n");
  ExpectRefused({"--estimate", estimate.path(), "--relations", "x", "--evo-zip", out.path()}, 2,
                "--evo-zip: needs --reference\n");
  ExpectRefused({"--estimate", log.path(), "--reference", reference.path()}, 3, ": an LCM log, no trajectory file");
  ExpectRefused({"--log-in", log.path(), "--log-out", out.path(), "--align", "calibrate"}, 2,
                "only with files or --log-in alone\n");
}

}  // namespace
}  // namespace lcmslam

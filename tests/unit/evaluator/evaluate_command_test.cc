#include <cmath>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <lcmslam/evaluation_t.hpp>
#include <lcmslam/pose_t.hpp>
#include <lcmslam/pose_xyt_t.hpp>

#include "bus/log_writer.h"
#include "bus/messages.h"
#include "evaluator/evaluation.pb.h"
#include "evaluator/result.h"
#include "support/temporary_file.h"
#include "unit/evaluator/circle_run.h"
#include "unit/evaluator/run_evaluator.h"

namespace lcmslam {
namespace {

using testing::Estimate;
using ::testing::HasSubstr;
using testing::Outcome;
using testing::Reference;
using testing::TumFile;
using testing::WriteLog;

Outcome Evaluator(const std::vector<std::string>& arguments) { return testing::RunEvaluator(arguments); }

result::Evaluation ReadEvaluation(const std::filesystem::path& path) {
  result::Evaluation message;
  ReadJson(path, message);
  return message;
}

TEST(Evaluate, FilesToTableAndJson) {
  const TemporaryFile estimate = TumFile(Estimate(0.02)), reference = TumFile(Reference()), json;
  const Outcome run =
      Evaluator({"--estimate", estimate.path(), "--reference", reference.path(), "--json", json.path()});
  ASSERT_EQ(run.code, 0) << run.error;
  EXPECT_THAT(run.out, HasSubstr("401 matched, 0 before the reference, 0 after it, 0 in gaps: coverage 100.00 %"));
  EXPECT_THAT(run.out, HasSubstr("alignment    se2, no scale"));
  EXPECT_THAT(run.out, HasSubstr("absolute             m         0.02000"));
  const result::Evaluation m = ReadEvaluation(json.path());
  EXPECT_NEAR(m.absolute().translation_m().mean(), 0.02, 1e-4);
  EXPECT_EQ(m.absolute().translation_m().count(), 401);
  EXPECT_EQ(m.alignment().kind(), "se2");
  EXPECT_NEAR(m.association().coverage(), 1.0, 1e-12);
  EXPECT_EQ(m.relative_size(), 7);
  EXPECT_EQ(m.estimate().name(), estimate.path().string());
  EXPECT_FALSE(m.has_kitti());
}

TEST(Evaluate, LogGivesWhatFilesGive) {
  const TemporaryFile estimate = TumFile(Estimate(0.02)), reference = TumFile(Reference()), json1, json2, log;
  WriteLog(log.path(), Estimate(0.02), Reference());
  ASSERT_EQ(Evaluator({"--estimate", estimate.path(), "--reference", reference.path(), "--json", json1.path()}).code,
            0);
  const Outcome run =
      Evaluator({"--log-in", log.path(), "--estimate", "SDF2D_POSE", "--json", json2.path(), "--quiet"});
  ASSERT_EQ(run.code, 0) << run.error;
  EXPECT_THAT(run.out, HasSubstr("SDF2D_POSE in " + log.path().string() + ", 401 poses"));
  const double from_files = ReadEvaluation(json1.path()).absolute().translation_m().rmse();
  EXPECT_NEAR(ReadEvaluation(json2.path()).absolute().translation_m().rmse(), from_files, 1e-9);
}

TEST(Evaluate, EstimateOfALogAgainstAFile) {
  const TemporaryFile reference = TumFile(Reference()), log;
  WriteLog(log.path(), Estimate(0.02), {Reference().back()});
  const Outcome run = Evaluator({"--log-in", log.path(), "--estimate", "SDF2D_POSE", "--reference", reference.path()});
  EXPECT_EQ(run.code, 0) << run.error;
  EXPECT_THAT(run.out, HasSubstr("absolute             m         0.02000"));
}

TEST(Evaluate, MBotsPlanarPoseIsRecognized) {
  const TemporaryFile log, json;
  LogWriter writer(log.path());
  for (const StampedPose& p : Reference()) {
    const Pose2 pose = ToPose2(p.pose);
    const pose_xyt_t message{p.utime, static_cast<float>(pose.x()), static_cast<float>(pose.y()),
                             static_cast<float>(pose.yaw())};
    writer.Write(p.utime, "TRUE_POSE", message);
    writer.Write(p.utime, "SLAM_POSE", message);
  }
  writer.Flush();
  EXPECT_EQ(Evaluator({"--log-in", log.path(), "--estimate", "SLAM_POSE", "--json", json.path()}).code, 0);
  EXPECT_EQ(ReadEvaluation(json.path()).absolute().translation_m().count(), 2001);
  EXPECT_LT(ReadEvaluation(json.path()).absolute().translation_m().max(), 1e-9);
}

// The log gains the error so far once a second; the end is that of the batch evaluation.
TEST(Evaluate, LogToLogPublishesTheErrorSoFar) {
  const TemporaryFile log, out, json1, json2;
  WriteLog(log.path(), Estimate(0.02), Reference());
  ASSERT_EQ(Evaluator({"--log-in", log.path(), "--estimate", "SDF2D_POSE", "--json", json1.path()}).code, 0);
  const Outcome run = Evaluator({"--log-in", log.path(), "--log-out", out.path(), "--json", json2.path()});
  ASSERT_EQ(run.code, 0) << run.error;
  EXPECT_NEAR(ReadEvaluation(json1.path()).absolute().translation_m().mean(),
              ReadEvaluation(json2.path()).absolute().translation_m().mean(), 1e-12);
  LogReader reader(out.path());
  std::vector<evaluation_t> published;
  for (Event event; reader.Next(event);) {
    if (event.channel == "EVALUATION") published.push_back(Decode<evaluation_t>(event.data).value());
  }
  ASSERT_GE(published.size(), 39u);
  EXPECT_EQ(published.back().matched, 401);
  EXPECT_NEAR(published.back().ate_mean, 0.02, 1e-4);
  EXPECT_EQ(published.back().estimate_channel, "SDF2D_POSE");
  EXPECT_EQ(published.back().reference_channel, "GROUND_TRUTH");
  EXPECT_EQ(published.back().alignment, "se2");
  EXPECT_LT(published.front().matched, published.back().matched);
}

TEST(Evaluate, Relations) {
  const TemporaryFile estimate = TumFile(Estimate(0.0)), json;
  const double chord_m = 4.0 * std::sin(0.125);  // of one second of arc
  char line[200];
  std::snprintf(line, sizeof line, "1600000001.0 1600000002.0 %.9f %.9f 0 0 0 0.25\n1 2 0 0 0 0 0 0\n",
                std::cos(0.125 + 1.5707963267948966) * chord_m + 0.03,
                std::sin(0.125 + 1.5707963267948966) * chord_m - 0.04);
  const TemporaryFile relations(line);
  const Outcome run =
      Evaluator({"--estimate", estimate.path(), "--relations", relations.path(), "--json", json.path()});
  ASSERT_EQ(run.code, 0) << run.error;
  EXPECT_THAT(run.out, HasSubstr("relations: 1 matched, 1 without pose"));
  const result::Evaluation m = ReadEvaluation(json.path());
  EXPECT_FALSE(m.has_absolute());
  EXPECT_EQ(m.relations().unmatched(), 1);
  EXPECT_NEAR(m.relations().squared_translation_m2().mean(),
              m.relations().error().translation_m().mean() * m.relations().error().translation_m().mean(), 1e-12);
}

TEST(Evaluate, Calibrate) {
  Trajectory late = Reference();
  for (StampedPose& pose : late) pose.utime += 50'000;
  const TemporaryFile estimate = TumFile(Estimate(0.001)), reference = TumFile(late), json;
  const Outcome run = Evaluator(
      {"--estimate", estimate.path(), "--reference", reference.path(), "--align", "calibrate", "--json", json.path()});
  ASSERT_EQ(run.code, 0) << run.error;
  EXPECT_THAT(run.out, HasSubstr("WARNING: the motion does not excite"))
      << "on a circle at constant speed the time offset looks like a turn of the frame";
  EXPECT_GT(ReadEvaluation(json.path()).calibration().unexcited_size(), 0);
}

TEST(Evaluate, ThresholdsDecideTheExitCode) {
  const TemporaryFile estimate = TumFile(Estimate(0.02)), reference = TumFile(Reference());
  const auto run = [&](const char* flag, const char* limit) {
    return Evaluator({"--estimate", estimate.path(), "--reference", reference.path(), flag, limit});
  };
  EXPECT_EQ(run("--max-mean", "0.021").code, 0);
  EXPECT_EQ(run("--max-mean", "0.019").code, 5);
  EXPECT_EQ(run("--max-rmse", "0.019").code, 5);
  EXPECT_EQ(run("--max-p95", "0.019").code, 5);
  EXPECT_EQ(run("--max-error", "0.019").code, 5);
  EXPECT_EQ(run("--max-rotation", "0.001").code, 0);
  EXPECT_EQ(run("--min-coverage", "1").code, 0);
  EXPECT_THAT(run("--max-mean", "0.019").out, HasSubstr("MISSED max_mean_m: 0.0199999, limit 0.019"));
}

TEST(Evaluate, DemandsWithoutAReferenceAreNotMeasured) {
  const TemporaryFile log, out;
  LogWriter writer(log.path());
  for (const StampedPose& pose : Estimate(0.02)) writer.Write(pose.utime, "SDF2D_POSE", ToMessage(pose));
  writer.Flush();
  const Outcome run = Evaluator({"--log-in", log.path(), "--log-out", out.path(), "--quiet", "--max-mean", "1"});
  EXPECT_EQ(run.code, 4);
  EXPECT_THAT(run.out, HasSubstr("reference    GROUND_TRUTH|TRUE_POSE, 0 poses"));
  EXPECT_THAT(run.out, HasSubstr("MISSED max_mean_m: not measured, limit 1\n"));
}

TEST(Evaluate, DamagedLogIsEvaluatedAndSaid) {
  const TemporaryFile log;
  WriteLog(log.path(), Estimate(0.02), Reference());
  {
    std::fstream file(log.path(), std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(static_cast<std::streamoff>(std::filesystem::file_size(log.path()) / 2));
    file << std::string(300, '\x55');
  }
  const Outcome run = Evaluator({"--log-in", log.path(), "--estimate", "SDF2D_POSE", "--quiet"});
  EXPECT_EQ(run.code, 3);
  EXPECT_THAT(run.out, HasSubstr("absolute"));
}

TEST(Evaluate, StampsAtTheEndsOfInt64AreRefused) {
  const TemporaryFile log, json;
  LogWriter writer(log.path());
  for (const int64_t utime : {INT64_MIN, INT64_MAX, int64_t{0}, int64_t{100'000}}) {
    writer.Write(0, "SDF2D_POSE", ToMessage(StampedPose{utime, {}}));
    writer.Write(0, "GROUND_TRUTH", ToMessage(StampedPose{utime, {}}));
  }
  writer.Flush();
  EXPECT_EQ(Evaluator({"--log-in", log.path(), "--estimate", "SDF2D_POSE", "--json", json.path()}).code, 0);
  EXPECT_EQ(ReadEvaluation(json.path()).estimate().refused(), 2);
  EXPECT_EQ(ReadEvaluation(json.path()).association().matched(), 2);
}

}  // namespace
}  // namespace lcmslam

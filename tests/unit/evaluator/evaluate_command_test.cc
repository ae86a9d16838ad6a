#include "evaluator/evaluate_command.h"

#include <cmath>
#include <fstream>
#include <sstream>

#include <CLI/CLI.hpp>
#include <gmock/gmock.h>
#include <google/protobuf/util/json_util.h>
#include <lcmslam/evaluation_t.hpp>
#include <lcmslam/pose_t.hpp>
#include <lcmslam/pose_xyt_t.hpp>

#include "bus/log_writer.h"
#include "bus/messages.h"
#include "common/command_line.h"
#include "evaluator/evaluation.pb.h"
#include "evaluator/evaluator.pb.h"
#include "support/temporary_file.h"
#include "trajectory/write.h"

namespace lcmslam {
namespace {

using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::MatchesRegex;

constexpr int64_t kStart = 1'600'000'000'000'000;

// A circle at 0.5 m/s. The estimate is in a frame of its own and `error_m` too far out on every second pose.
Pose2 Circle(double t_s) { return Pose2(std::cos(0.25 * t_s) * 2.0, std::sin(0.25 * t_s) * 2.0, 0.25 * t_s); }

Trajectory Reference(double duration_s = 40.0) {
  Trajectory t;
  for (int k = 0; k * 0.02 <= duration_s; ++k) t.push_back({kStart + k * 20'000, ToPose3(Circle(0.02 * k))});
  return t;
}

Trajectory Estimate(double error_m) {
  Trajectory t;
  for (int k = 0; k <= 400; ++k) {
    const Pose2 error(0.0, k % 2 == 0 ? error_m : -error_m, 0.0);
    t.push_back({kStart + k * 100'000, ToPose3(Pose2(5.0, -3.0, 1.0) * Circle(0.1 * k) * error)});
  }
  return t;
}

TemporaryFile TumFile(const Trajectory& trajectory) {
  std::string text;
  for (const StampedPose& pose : trajectory) text += FormatTum(pose);
  return TemporaryFile(text, ".tum");
}

struct Outcome {
  int code = 0;
  std::string out, error;
};

Outcome Evaluator(std::vector<std::string> arguments) {
  CLI::App app("test", "evaluator");
  EvaluateArguments evaluate;
  config::Evaluator flags;
  AddServiceOptions(app, evaluate.service);
  AddEvaluateOptions(app, evaluate, flags);
  arguments.insert(arguments.begin(), "evaluator");
  std::vector<char*> argv;
  for (std::string& argument : arguments) argv.push_back(argument.data());
  ::testing::internal::CaptureStdout();
  ::testing::internal::CaptureStderr();
  Outcome outcome;
  outcome.code =
      RunCommandLine(app, static_cast<int>(argv.size()), argv.data(), [&] { return RunEvaluate(evaluate, flags); });
  std::fflush(stdout);
  outcome.out = ::testing::internal::GetCapturedStdout();
  outcome.error = ::testing::internal::GetCapturedStderr();
  return outcome;
}

result::Evaluation ReadJson(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::stringstream text;
  text << file.rdbuf();
  result::Evaluation message;
  EXPECT_TRUE(google::protobuf::util::JsonStringToMessage(text.str(), &message).ok()) << text.str();
  return message;
}

// A log with a reference and an estimate, as they would come in live: by time.
void WriteLog(const std::filesystem::path& path, const Trajectory& estimate, const Trajectory& reference) {
  LogWriter log(path);
  size_t e = 0;
  for (const StampedPose& r : reference) {
    log.Write(r.utime, "GROUND_TRUTH", ToMessage(r));
    for (; e < estimate.size() && estimate[e].utime <= r.utime; ++e) {
      log.Write(r.utime, "SDF2D_POSE", ToMessage(estimate[e]));
    }
  }
  log.Flush();
}

TEST(Evaluate, FilesToTableAndJson) {
  const TemporaryFile estimate = TumFile(Estimate(0.02)), reference = TumFile(Reference()), json;
  const Outcome run =
      Evaluator({"--estimate", estimate.path(), "--reference", reference.path(), "--json", json.path()});
  ASSERT_EQ(run.code, 0) << run.error;
  EXPECT_THAT(run.out, HasSubstr("401 matched, 0 before the reference, 0 after it, 0 in gaps: coverage 100.00 %"));
  EXPECT_THAT(run.out, HasSubstr("alignment    se2, no scale"));
  EXPECT_THAT(run.out, HasSubstr("absolute             m         0.02000"));
  const result::Evaluation m = ReadJson(json.path());
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
  const double from_files = ReadJson(json1.path()).absolute().translation_m().rmse();
  EXPECT_NEAR(ReadJson(json2.path()).absolute().translation_m().rmse(), from_files, 1e-9);
}

TEST(Evaluate, EstimateOfALogAgainstAFile) {
  const TemporaryFile reference = TumFile(Reference()), log;
  WriteLog(log.path(), Estimate(0.02), {Reference().back()});
  const Outcome run = Evaluator({"--log-in", log.path(), "--estimate", "SDF2D_POSE", "--reference", reference.path()});
  EXPECT_EQ(run.code, 0) << run.error;
  EXPECT_THAT(run.out, HasSubstr("absolute             m         0.02000"));
}

TEST(Evaluate, MBotsPlanarPoseIsRecognised) {
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
  EXPECT_EQ(ReadJson(json.path()).absolute().translation_m().count(), 2001);
  EXPECT_LT(ReadJson(json.path()).absolute().translation_m().max(), 1e-9);
}

// The log gains the error so far once a second; the end is that of the batch evaluation.
TEST(Evaluate, LogToLogPublishesTheErrorSoFar) {
  const TemporaryFile log, out, json1, json2;
  WriteLog(log.path(), Estimate(0.02), Reference());
  ASSERT_EQ(Evaluator({"--log-in", log.path(), "--estimate", "SDF2D_POSE", "--json", json1.path()}).code, 0);
  const Outcome run = Evaluator({"--log-in", log.path(), "--log-out", out.path(), "--json", json2.path()});
  ASSERT_EQ(run.code, 0) << run.error;
  EXPECT_NEAR(ReadJson(json1.path()).absolute().translation_m().mean(),
              ReadJson(json2.path()).absolute().translation_m().mean(), 1e-12);
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
  const result::Evaluation m = ReadJson(json.path());
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
  EXPECT_GT(ReadJson(json.path()).calibration().unexcited_size(), 0);
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

TEST(Evaluate, SaysInOneLineWhatIsWrong) {
  const TemporaryFile estimate = TumFile(Estimate(0.02)), reference = TumFile(Reference());
  const TemporaryFile nan("1 nan 0 0 0 0 0 1\n", ".tum"), empty("", ".tum"), rubbish("\x01\x02\n\xff", ".tum");
  const TemporaryFile elsewhen("1 0 0 0 0 0 0 1\n", ".tum"), log, stepping_log, no_log("rubbish");
  WriteLog(log.path(), Estimate(0.02), Reference());
  {
    LogWriter writer(stepping_log.path());
    for (const int64_t utime : {5'000'000, 6'000'000, 1'000'000}) {
      writer.Write(utime, "SDF2D_POSE", ToMessage(StampedPose{utime, {}}));
    }
    writer.Flush();
  }
  const auto files = [](const std::filesystem::path& e, const std::filesystem::path& r) {
    return std::vector<std::string>{"--estimate", e, "--reference", r};
  };
  const auto channels = [](const std::filesystem::path& in, const char* e, const char* r) {
    return std::vector<std::string>{"--log-in", in, "--estimate", e, "--reference", r, "--quiet"};
  };
  const struct {
    std::vector<std::string> arguments;
    int code;
    std::string error;
  } cases[] = {
      {files(nan.path(), reference.path()), 3, nan.path().string() + ":1: not a finite number: 'nan'\n"},
      {files(estimate.path(), empty.path()), 3, empty.path().string() + ": no poses\n"},
      {files(rubbish.path(), reference.path()), 3,
       rubbish.path().string() + ":1: not a TUM, planar, EuRoC or KITTI trajectory\n"},
      {files("/none.tum", reference.path()), 3, "/none.tum: cannot open: No such file or directory\n"},
      {files(elsewhen.path(), reference.path()), 4, "(1600000000.000 to 1600000040.000 s)\n"},
      {{"--estimate", estimate.path()}, 2, "--reference FILE or --relations FILE: required\n"},
      {{"--estimate", estimate.path(), "--reference", reference.path(), "--align", "sim3"},
       2,
       "--align: sim3 not in {auto,none,first,yaw,se2,se3,calibrate}\n"},
      {{"--estimate", estimate.path(), "--reference", reference.path(), "--max-gap", "-1"},
       2,
       "association.max_gap_us: must be positive\n"},
      {channels(log.path(), "OCTO3D_POSE", "GROUND_TRUTH"), 4, ": no poses on OCTO3D_POSE\n"},
      {channels(log.path(), "SDF2D_POSE", "TRUE_POSE"), 4, ": no poses on TRUE_POSE\n"},
      {channels(log.path(), "SDF2D_POSE|GROUND_TRUTH", "GROUND_TRUTH"), 2, "matches GROUND_TRUTH and SDF2D_POSE\n"},
      {channels(log.path(), "(", "GROUND_TRUTH"), 2, "channel '(': not a regular expression\n"},
      {channels(stepping_log.path(), "SDF2D_POSE", "SDF2D_POSE"), 3,
       "SDF2D_POSE: the clock steps back by 5.000 s after pose 2; cut the log there\n"},
      {channels(no_log.path(), "SDF2D_POSE", "GROUND_TRUTH"), 3, "\n"},
      {{"--log-in", log.path(), "--log-out", log.path().string() + ".out", "--align", "calibrate"},
       2,
       "only with files or --log-in alone\n"},
  };
  for (const auto& c : cases) {
    SCOPED_TRACE(::testing::PrintToString(c.arguments));
    const Outcome run = Evaluator(c.arguments);
    EXPECT_EQ(run.code, c.code);
    EXPECT_THAT(run.error, EndsWith(c.error));
    EXPECT_THAT(run.error, MatchesRegex("evaluator: [^\n]*\n"));
  }
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
  EXPECT_EQ(ReadJson(json.path()).estimate().refused(), 2);
  EXPECT_EQ(ReadJson(json.path()).association().matched(), 2);
}

}  // namespace
}  // namespace lcmslam

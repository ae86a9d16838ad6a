#include "evaluator/evo_archive.h"

#include <cmath>
#include <cstring>
#include <fstream>
#include <map>
#include <memory>
#include <sstream>

#include <gmock/gmock.h>
#include <google/protobuf/struct.pb.h>
#include <google/protobuf/util/json_util.h>
#include <gtest/gtest.h>
#include <zip.h>

#include "bus/errors.h"
#include "evaluator/evaluation.pb.h"
#include "evaluator/files.h"
#include "support/temporary_file.h"
#include "trajectory/read.h"

namespace lcmslam {
namespace {

using ::testing::ElementsAre;
using ::testing::StartsWith;

Evaluation SomeEvaluation() {
  Trajectory estimate, reference;
  for (int k = 0; k < 50; ++k) {
    const double error_m = k % 2 == 0 ? 0.01 : 0.03;
    reference.push_back({1'000'000 + k * 100'000, {{0.1 * k, std::sin(0.1 * k), 0.0}, Eigen::Quaterniond::Identity()}});
    estimate.push_back(reference.back());
    estimate.back().pose.translation.z() += error_m;
  }
  return Evaluate(estimate, reference, {.alignment = AlignmentKind::kNone});
}

result::Evaluation SomeMessage() {
  result::Evaluation message;
  message.mutable_estimate()->set_name("SDF2D_POSE in \"run\".lcm");
  message.mutable_reference()->set_name("GROUND_TRUTH");
  return message;
}

std::map<std::string, std::string> Unzip(const std::filesystem::path& path) {
  std::map<std::string, std::string> entries;
  const std::unique_ptr<zip_t, decltype(&zip_discard)> archive(zip_open(path.c_str(), ZIP_RDONLY, nullptr),
                                                               zip_discard);
  if (!archive) return entries;
  for (zip_int64_t i = 0; i < zip_get_num_entries(archive.get(), 0); ++i) {
    zip_stat_t stat;
    zip_stat_index(archive.get(), static_cast<zip_uint64_t>(i), 0, &stat);
    std::string bytes(stat.size, '\0');
    zip_file_t* file = zip_fopen_index(archive.get(), static_cast<zip_uint64_t>(i), 0);
    EXPECT_EQ(zip_fread(file, bytes.data(), bytes.size()), static_cast<zip_int64_t>(bytes.size()));
    zip_fclose(file);
    entries[stat.name] = bytes;
  }
  return entries;
}

google::protobuf::Struct ParseJson(const std::string& text) {
  google::protobuf::Struct object;
  EXPECT_TRUE(google::protobuf::util::JsonStringToMessage(text, &object).ok()) << text;
  return object;
}

TEST(EvoArchive, HoldsWhatEvoReads) {
  const TemporaryFile file({}, ".zip");
  const Evaluation evaluation = SomeEvaluation();
  WriteEvoArchive(evaluation, SomeMessage(), file.path());
  const auto entries = Unzip(file.path());
  std::vector<std::string> names;
  for (const auto& [name, bytes] : entries) names.push_back(name);
  ASSERT_THAT(names,
              ElementsAre("distances.npy", "distances_from_start.npy", "error_array.npy", "estimate.tum", "info.json",
                          "reference.tum", "seconds_from_start.npy", "stats.json", "timestamps.npy"));
  auto info = *ParseJson(entries.at("info.json")).mutable_fields();
  EXPECT_EQ(info["est_name"].string_value(), "SDF2D_POSE in \"run\".lcm");
  EXPECT_EQ(info["label"].string_value(), "APE (m)");
  auto stats = *ParseJson(entries.at("stats.json")).mutable_fields();
  EXPECT_NEAR(stats["mean"].number_value(), 0.02, 1e-12);
  EXPECT_NEAR(stats["std"].number_value(), 0.01, 1e-12);
  EXPECT_NEAR(stats["sse"].number_value(), 25 * (0.01 * 0.01 + 0.03 * 0.03), 1e-12);
}

TEST(EvoArchive, ArraysAreNumPys) {
  const TemporaryFile file({}, ".zip");
  WriteEvoArchive(SomeEvaluation(), SomeMessage(), file.path());
  const auto entries = Unzip(file.path());
  for (const char* name : {"error_array.npy", "timestamps.npy", "seconds_from_start.npy"}) {
    SCOPED_TRACE(name);
    const std::string& npy = entries.at(name);
    ASSERT_THAT(npy, StartsWith(std::string("\x93NUMPY\x01\x00", 8)));
    const size_t header = static_cast<uint8_t>(npy[8]) + 256 * static_cast<uint8_t>(npy[9]);
    EXPECT_EQ((10 + header) % 64, 0u);
    EXPECT_EQ(npy[10 + header - 1], '\n');
    EXPECT_THAT(npy.substr(10), StartsWith("{'descr': '<f8', 'fortran_order': False, 'shape': (50,), }"));
    EXPECT_EQ(npy.size(), 10 + header + 50 * sizeof(double));
  }
  double second = 0.0;
  const std::string& errors = entries.at("error_array.npy");
  std::memcpy(&second, errors.data() + errors.size() - sizeof second, sizeof second);
  EXPECT_NEAR(second, 0.03, 1e-12);
}

TEST(EvoArchive, TrajectoriesAreTumAndTheSameBytesTwice) {
  const TemporaryFile one({}, ".zip"), two({}, ".zip");
  WriteEvoArchive(SomeEvaluation(), SomeMessage(), one.path());
  WriteEvoArchive(SomeEvaluation(), SomeMessage(), two.path());
  EXPECT_EQ(ReadFile(one.path()), ReadFile(two.path()));
  const TemporaryFile estimate(Unzip(one.path()).at("estimate.tum"), ".tum");
  const TrajectoryFile read = ReadTrajectory(estimate.path());
  ASSERT_EQ(read.error, "");
  ASSERT_EQ(read.trajectory.size(), 50u);
  EXPECT_NEAR(read.trajectory[1].pose.translation.z(), 0.03, 1e-9);
}

TEST(EvoArchive, UnwritablePathIsNamed) {
  try {
    WriteEvoArchive(SomeEvaluation(), SomeMessage(), "/nowhere/result.zip");
    FAIL();
  } catch (const CommandError& error) {
    EXPECT_EQ(error.code(), ExitCode::kRuntime);
    EXPECT_THAT(error.what(), StartsWith("/nowhere/result.zip: cannot write"));
  }
}

}  // namespace
}  // namespace lcmslam

#include "trajectory/relations.h"

#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/real_data.h"
#include "support/temporary_file.h"
#include "unit/trajectory/matrix_oracle.h"
#include "unit/trajectory/trajectories.h"

namespace lcmslam {
namespace {

using ::testing::EndsWith;
using ::testing::HasSubstr;

Eigen::Matrix4d FromEuler(const Eigen::Vector3d& translation, double roll, double pitch, double yaw) {
  const double cr = std::cos(roll), sr = std::sin(roll), cp = std::cos(pitch), sp = std::sin(pitch);
  const double cy = std::cos(yaw), sy = std::sin(yaw);
  Eigen::Matrix3d rx, ry, rz;
  rx << 1, 0, 0, 0, cr, -sr, 0, sr, cr;
  ry << cp, 0, sp, 0, 1, 0, -sp, 0, cp;
  rz << cy, -sy, 0, sy, cy, 0, 0, 0, 1;
  Eigen::Matrix4d m = Eigen::Matrix4d::Identity();
  m.topLeftCorner<3, 3>() = rz * ry * rx;
  m.topRightCorner<3, 1>() = translation;
  return m;
}

RelationFile Read(const std::string& text) { return ReadRelations(TemporaryFile(text, "test.relations").path()); }

TEST(EvaluateRelations, AgreesWithMatricesFromTheDefinition) {
  testing::Noise noise(1);
  const Trajectory estimate = testing::Sample(testing::Flight, 60.0, 0.1, 0);
  std::string text = "# t1 t2 x y z roll pitch yaw\n";
  std::vector<double> translation, rotation;
  for (int k = 0; k < 200; ++k) {
    const auto i = static_cast<size_t>(noise.Uniform(0, 600)), j = static_cast<size_t>(noise.Uniform(0, 600));
    const Eigen::Vector3d t = noise.Gauss3(1.0);
    const double roll = noise.Uniform(-3, 3), pitch = noise.Uniform(-1.5, 1.5), yaw = noise.Uniform(-3, 3);
    char line[300];
    std::snprintf(line, sizeof line, "%.6f %.6f %.17g %.17g %.17g %.17g %.17g %.17g\n",
                  static_cast<double>(estimate[i].utime) * 1e-6, static_cast<double>(estimate[j].utime) * 1e-6, t.x(),
                  t.y(), t.z(), roll, pitch, yaw);
    text += line;
    const Eigen::Matrix4d T_i_j = testing::Matrix(estimate[i].pose).inverse() * testing::Matrix(estimate[j].pose);
    const Eigen::Matrix4d error = FromEuler(t, roll, pitch, yaw).inverse() * T_i_j;
    translation.push_back(testing::Translation(error));
    rotation.push_back(testing::Angle(error));
  }
  const RelationFile file = Read(text);
  ASSERT_EQ(file.error, "");
  const RelationErrors actual = EvaluateRelations(estimate, file.relations, 1);
  EXPECT_EQ(actual.unmatched, 0);
  ASSERT_EQ(actual.errors.translation_m.size(), translation.size());
  for (size_t k = 0; k < translation.size(); ++k) {
    EXPECT_NEAR(actual.errors.translation_m[k], translation[k], 1e-9);
    EXPECT_NEAR(actual.errors.rotation_rad[k], rotation[k], 1e-9);
  }
}

TEST(EvaluateRelations, CountsWhatHasNoPose) {
  const Trajectory estimate = testing::Sample(testing::Flight, 10.0, 0.5, 0);
  const std::vector<Relation> relations = {
      {0, 10'000'000, {}}, {-1, 5'000'000, {}}, {0, 10'000'001, {}}, {250'000, 500'000, {}}};
  EXPECT_EQ(EvaluateRelations(estimate, relations, 500'000).unmatched, 2);
  EXPECT_EQ(EvaluateRelations(estimate, relations, 400'000).unmatched, 3) << "between poses 0.5 s apart";
  EXPECT_EQ(EvaluateRelations({}, relations, 500'000).unmatched, 4);
}

TEST(ReadRelations, ErrorsNameFileAndLine) {
  EXPECT_THAT(Read("1 2 0 0 0 0 0 0\n1 2 0 0 0 0 0\n").error,
              EndsWith("test.relations:2: 8 numbers expected (t1 t2 x y z roll pitch yaw), found 7"));
  EXPECT_THAT(Read("1 2 0 0 0 0 0 nan\n").error, EndsWith("test.relations:1: not a finite number: 'nan'"));
  EXPECT_THAT(Read("").error, EndsWith("test.relations: no relations"));
  EXPECT_THAT(ReadRelations("/nowhere").error, HasSubstr("cannot open"));
}

TEST(ReadRelations, RealLogs) {
  if (!std::filesystem::exists(RealData("radish"))) GTEST_SKIP() << "no " << RealData("radish");
  EXPECT_EQ(ReadRelations(RealData("radish/fr079.relations")).relations.size(), 1685u);
  EXPECT_EQ(ReadRelations(RealData("radish/aces.relations")).relations.size(), 1279u);
}

}  // namespace
}  // namespace lcmslam

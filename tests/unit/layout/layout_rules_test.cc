#include "unit/layout/layout_rules.h"

#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/temporary_file.h"

namespace lcmslam {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

TEST(Layout, ProjectHasNoForbiddenInclude) { EXPECT_THAT(ForbiddenIncludes(LCMSLAM_SOURCE_DIR), IsEmpty()); }

TEST(Layout, ProjectHasNothingForeignAtTheTop) { EXPECT_THAT(ForeignTopLevelEntries(LCMSLAM_SOURCE_DIR), IsEmpty()); }

TEST(Layout, LibFoldersSeeOnlyWhatTheyBuildOn) {
  EXPECT_EQ(WhyForbidden("lib/lidar/a.cc", "\"lidar/sweep.h\""), "");
  EXPECT_EQ(WhyForbidden("lib/lidar/a.cc", "\"geometry/pose2.h\""), "");
  EXPECT_EQ(WhyForbidden("lib/sdf2d/a.cc", "\"geometry/pose2.h\""), "");
  EXPECT_EQ(WhyForbidden("lib/bus/a.cc", "\"lidar/planar_scan.h\""), "");
  EXPECT_EQ(WhyForbidden("lib/geometry/a.h", "\"lidar/sweep.h\""), "lib/geometry must not include lidar/");
  EXPECT_EQ(WhyForbidden("lib/sdf2d/a.h", "\"octo3d/tree.h\""), "lib/sdf2d must not include octo3d/");
  EXPECT_EQ(WhyForbidden("lib/trajectory/a.h", "\"lidar/sweep.h\""), "lib/trajectory must not include lidar/");
  EXPECT_EQ(WhyForbidden("lib/bus/a.h", "\"sensors/carmen.h\""), "lib/bus must not include sensors/");
  EXPECT_EQ(WhyForbidden("lib/lidar/a.h", "\"bus/wire.h\""), "lib/lidar must not include bus/");
  EXPECT_EQ(WhyForbidden("lib/lidar/a.h", "\"common/config.h\""), "lib/lidar must not include common/");
  EXPECT_EQ(WhyForbidden("lib/lidar/a.h", "\"../geometry/pose2.h\""), "lib/lidar must not include ../");
}

TEST(Layout, LibFoldersOutsideTheTableAreForbidden) {
  EXPECT_THAT(WhyForbidden("lib/utils/a.h", "\"geometry/pose2.h\""), HasSubstr("not in the table"));
}

TEST(Layout, ServicesNeverSeeEachOther) {
  EXPECT_EQ(WhyForbidden("services/sdf2d-slam/a.cc", "\"sdf2d/pipeline.h\""), "");
  EXPECT_EQ(WhyForbidden("services/sdf2d-slam/a.cc", "\"common/run_service.h\""), "");
  EXPECT_EQ(WhyForbidden("services/sdf2d-slam/a.cc", "\"sdf2d-slam/b.h\""), "");
  EXPECT_EQ(WhyForbidden("services/sdf2d-slam/a.cc", "\"b.h\""), "");
  EXPECT_EQ(WhyForbidden("services/sdf2d-slam/a.cc", "\"evaluator/b.h\""),
            "services/sdf2d-slam must not include evaluator/");
}

TEST(Layout, OnlyBusServicesAndReplaySeeMessages) {
  for (const char* message : {"<lcmslam/pose_t.hpp>", "<lcm/lcm-cpp.hpp>", "\"lcmslam/pose_t.hpp\""}) {
    SCOPED_TRACE(message);
    EXPECT_EQ(WhyForbidden("lib/sdf2d/a.cc", message), "lib/sdf2d must not see LCM and its messages");
  }
  for (const char* file : {"lib/bus/a.cc", "services/evaluator/a.cc", "replay/tools/a.cc"})
    EXPECT_EQ(WhyForbidden(file, "<lcmslam/pose_t.hpp>"), "") << file;
}

TEST(Layout, OnlyServicesAndReplaySeeProtobuf) {
  EXPECT_EQ(WhyForbidden("lib/bus/a.cc", "<google/protobuf/message.h>"), "lib/bus must not see Protobuf");
  EXPECT_EQ(WhyForbidden("lib/sdf2d/a.cc", "\"sdf2d-slam/config.pb.h\""), "lib/sdf2d must not see Protobuf");
  EXPECT_EQ(WhyForbidden("services/sdf2d-slam/a.cc", "\"sdf2d-slam/config.pb.h\""), "");
}

TEST(Layout, HeavyLibrariesStayWhereTheyBelong) {
  EXPECT_EQ(WhyForbidden("lib/trajectory/a.cc", "<ceres/ceres.h>"), "");
  EXPECT_EQ(WhyForbidden("lib/sdf2d/a.cc", "<ceres/ceres.h>"), "lib/sdf2d must not see Ceres");
  EXPECT_EQ(WhyForbidden("lib/octo3d/a.h", "<octomap/OcTreeBaseImpl.h>"), "");
  EXPECT_EQ(WhyForbidden("lib/baselines/a.h", "<octomap/OcTree.h>"), "lib/baselines must not see OctoMap");
}

TEST(Layout, LibraryHasNoClockAndNoLogger) {
  EXPECT_EQ(WhyForbidden("lib/sdf2d/a.cc", "<chrono>"), "lib/sdf2d must not see the clock");
  EXPECT_EQ(WhyForbidden("lib/sdf2d/a.cc", "<spdlog/spdlog.h>"), "lib/sdf2d must not see a logger");
  EXPECT_EQ(WhyForbidden("lib/bus/a.cc", "<chrono>"), "");
}

// A project made for the test, so that the reading of folders and lines is tested too.
class LayoutTree : public ::testing::Test {
 protected:
  void Write(const std::string& file, const std::string& text) const {
    fs::create_directories((root_ / file).parent_path());
    std::ofstream(root_ / file) << text;
  }
  const TemporaryFolder temporary_;
  const fs::path& root_ = temporary_.path();
};

TEST_F(LayoutTree, NamesFileAndLineOfEachForbiddenInclude) {
  Write("lib/geometry/pose.h", "#pragma once\n#include <cmath>\n");
  Write("lib/lidar/scan.cc", "#include \"geometry/pose.h\"\n  #  include <lcm/lcm-cpp.hpp>  // why\n");
  Write("lib/lidar/notes.txt", "#include \"bus/wire.h\"\n");
  Write("lib/octo3d/index/cells.h", "\n\n#include \"baselines/tree.h\"\n");
  Write("services/evaluator/main.cc", "// #include \"sdf2d-slam/service.h\"\n#include \"sdf2d-slam/service.h\"\n");
  EXPECT_THAT(ForbiddenIncludes(root_),
              ElementsAre("lib/lidar/scan.cc:2: lib/lidar must not see LCM and its messages",
                          "lib/octo3d/index/cells.h:3: lib/octo3d must not include baselines/",
                          "services/evaluator/main.cc:2: services/evaluator must not include "
                          "sdf2d-slam/"));
}

TEST_F(LayoutTree, NamesForeignTopLevelEntries) {
  Write("README.md", "");
  Write("lib/geometry/pose.h", "");
  Write(".clang-format", "");
  Write("build-debug/a", "");
  Write("out/a", "");
  Write("scripts/a", "");
  Write("notes.txt", "");
  EXPECT_THAT(ForeignTopLevelEntries(root_), ElementsAre("notes.txt", "scripts"));
}

TEST_F(LayoutTree, EmptyProjectIsClean) {
  fs::create_directories(root_);
  EXPECT_THAT(ForbiddenIncludes(root_), IsEmpty());
  EXPECT_THAT(ForeignTopLevelEntries(root_), IsEmpty());
}

}  // namespace
}  // namespace lcmslam

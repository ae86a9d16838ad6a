// Worlds of one's own in spatial episodes.

#include "sensor-bridge/spatial_episode_world.h"

#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <google/protobuf/text_format.h>
#include <gtest/gtest.h>

#include "bus/errors.h"
#include "simulation/spatial_worlds.h"
#include "support/temporary_file.h"

namespace lcmslam {
namespace {

using testing::StartsWith;

SpatialWorld World(const std::string& text, const std::filesystem::path& folder = "") {
  config::Episode::SpatialWorld config;
  EXPECT_TRUE(google::protobuf::TextFormat::ParseFromString(text, &config)) << text;
  return MakeSpatialWorld(config, folder);
}

// From the point x, y, z to the world's nearest surface.
double Distance(const SpatialWorld& world, double x_m, double y_m, double z_m) {
  return world.Distance({x_m, y_m, z_m}, 10.0);
}

constexpr double kTolerance_m = 1e-4;

TEST(SpatialEpisodeWorld, PartsStandWhereTheirPosesSay) {
  const std::string inside = " inside { x_m: 1 z_m: 2 }";
  const SpatialWorld box =
      World("box { length_m: 2 width_m: 1 height_m: 3 pose { x_m: 5 yaw_rad: 1.5707963 } }" + inside);
  EXPECT_NEAR(Distance(box, 4.0, 0.0, 1.0), 0.5, kTolerance_m) << "half its width";
  EXPECT_NEAR(Distance(box, 5.0, 2.0, 1.0), 1.0, kTolerance_m) << "less half its length";
  EXPECT_NEAR(Distance(box, 5.0, 0.0, 4.0), 1.0, kTolerance_m) << "above it";
  EXPECT_EQ(box.p_inside(), Eigen::Vector3d(1.0, 0.0, 2.0));

  const SpatialWorld cylinder = World("cylinder { radius_m: 0.5 height_m: 2 pose { z_m: 1 } }" + inside);
  EXPECT_NEAR(Distance(cylinder, 2.0, 0.0, 2.0), 1.5, kTolerance_m);
  EXPECT_NEAR(Distance(cylinder, 0.0, 0.0, 0.0), 1.0, kTolerance_m);

  const SpatialWorld vault = World("vault { length_m: 4 span_m: 4 rise_m: 2 pose { z_m: 1 } }" + inside);
  EXPECT_NEAR(Distance(vault, 0.0, 0.0, 1.0), 2.0, kTolerance_m) << "half a circle";

  const std::string arch = "arched_wall { length_m: 4 height_m: 3 opening_width_m: 2 springing_m: 1 ";
  EXPECT_NEAR(Distance(World(arch + "}" + inside), 0.0, -1e-3, 1.0), 1.0, 1e-3) << "in the middle of its opening";
  EXPECT_NEAR(Distance(World(arch + "sill_m: 0.8 }" + inside), 0.0, 0.0, 1.0), 0.2, kTolerance_m) << "over its sill";
}

TEST(SpatialEpisodeWorld, MeshesAreRelativeToTheEpisodesFolder) {
  const TemporaryFile file(
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 1\n"
      "property list uchar int vertex_indices\nend_header\n-500 -500 0\n500 -500 0\n0 500 0\n3 0 1 2\n");
  const std::string name = file.path().filename().string();
  const SpatialWorld world =
      World("mesh { file: '" + name + "' scale: 0.001 pose { z_m: 1 } reflectivity: 0.25 } inside {}",
            file.path().parent_path());
  EXPECT_NEAR(Distance(world, 0.0, 0.0, 3.0), 2.0, kTolerance_m);
  EXPECT_GT(Distance(world, 2.0, 0.0, 1.0), 1.0) << "millimetres";
  EXPECT_EQ(world.facets()[0].reflectivity, 0.25F);
}

TEST(SpatialEpisodeWorld, PartsAreAddedToANamedWorld) {
  EXPECT_EQ(World("").p_inside(), Hall10World().p_inside());
  const SpatialWorld world =
      World("name: 'bare_room' box { length_m: 1 width_m: 1 height_m: 1 pose { x_m: 3 y_m: 2.5 } }");
  EXPECT_EQ(world.facets().size(), BareRoomWorld().facets().size() + 12);
  EXPECT_EQ(world.p_inside(), BareRoomWorld().p_inside());
  EXPECT_NEAR(Distance(world, 3.0, 2.5, 1.3), 0.3, kTolerance_m);
}

struct Refusal {
  ExitCode code = ExitCode::kOk;
  std::string line;
};

Refusal RefusalOf(const std::string& text, const std::filesystem::path& folder = "") {
  try {
    (void)World(text, folder);
  } catch (const CommandError& error) {
    return {error.code(), error.what()};
  }
  return {};
}

TEST(SpatialEpisodeWorld, RefusalsNameTheField) {
  const std::string box = "length_m: 1 width_m: 1 height_m: 1";
  const std::string arch = "arched_wall { length_m: 3 opening_width_m: 1 springing_m: 1 ";
  const std::vector<std::pair<std::string, std::string>> cases{
      {"name: 'moon'", "spatial.world.name: "},
      {"box { " + box + " }", "spatial.world.inside: "},
      {"inside {} box { " + box + " } box { length_m: 1 height_m: 1 }", "spatial.world.box[1].width_m: "},
      {"inside {} box { " + box + " reflectivity: 2 }", "spatial.world.box[0].reflectivity: "},
      {"inside {} box { " + box + " pose { yaw_rad: nan } }", "spatial.world.box[0].pose.yaw_rad: "},
      {"inside {} box { " + box + " pose { x_m: 1e30 } }", "spatial.world.box[0].pose: "},
      {"inside {} cylinder { radius_m: -1 height_m: 1 }", "spatial.world.cylinder[0].radius_m: "},
      {"inside {} vault { length_m: 1 span_m: 2 rise_m: 1.5 }", "spatial.world.vault[0].rise_m: "},
      {"inside {} " + arch + "height_m: 3 sill_m: 2 }", "spatial.world.arched_wall[0].springing_m: "},
      {"inside {} " + arch + "height_m: 1.4 }", "spatial.world.arched_wall[0].height_m: "},
      {"inside {} mesh {}", "spatial.world.mesh[0].file: "},
      {"inside {} mesh { file: 'a.ply' scale: 0 }", "spatial.world.mesh[0].scale: "},
      {"inside { y_m: inf } box { " + box + " }", "spatial.world.inside.y_m: "},
  };
  for (const auto& [text, field] : cases) {
    const Refusal refusal = RefusalOf(text);
    EXPECT_EQ(refusal.code, ExitCode::kUsage) << text;
    EXPECT_THAT(refusal.line, StartsWith(field)) << text;
    EXPECT_EQ(refusal.line.find('\n'), std::string::npos) << text;
  }
}

TEST(SpatialEpisodeWorld, BadMeshesAreNamedWithTheirLine) {
  const Refusal missing = RefusalOf("inside {} mesh { file: 'none.ply' }");
  EXPECT_EQ(missing.code, ExitCode::kBadInput);
  EXPECT_THAT(missing.line, StartsWith("spatial.world.mesh[0].file: none.ply: "));

  const TemporaryFile file("ply\nformat ascii 1.0\nelement vertex one\n");
  const std::string name = file.path().filename().string();
  const Refusal broken = RefusalOf("inside {} mesh { file: '" + name + "' }", file.path().parent_path());
  EXPECT_EQ(broken.code, ExitCode::kBadInput);
  EXPECT_EQ(broken.line, "spatial.world.mesh[0].file: " + file.path().string() + ": PLY line 3: 'one' is not a number");
}

}  // namespace
}  // namespace lcmslam

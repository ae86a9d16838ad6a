#include "sensor-bridge/episode_config.h"

#include <string>
#include <variant>

#include <gmock/gmock.h>
#include <google/protobuf/text_format.h>
#include <gtest/gtest.h>

#include "bus/errors.h"
#include "common/config.h"
#include "lidar/occupancy_grid.h"
#include "sensor-bridge/episode.pb.h"
#include "simulation/planar_worlds.h"
#include "support/temporary_file.h"

namespace lcmslam {
namespace {

using testing::StartsWith;

config::Episode Parse(const std::string& text) {
  config::Episode config;
  EXPECT_TRUE(google::protobuf::TextFormat::ParseFromString(text, &config)) << text;
  return config;
}

PlanarEpisode Make(const std::string& text, const std::filesystem::path& folder = {}) {
  config::Episode config = Parse(text);
  return std::get<PlanarEpisode>(MakeEpisode(config, folder));
}

SpatialEpisode MakeSpatial(const std::string& text) {
  config::Episode config = Parse(text);
  return std::get<SpatialEpisode>(MakeEpisode(config, {}));
}

struct Refusal {
  ExitCode code = ExitCode::kOk;
  std::string line;
};

Refusal RefusalOf(const std::string& text) {
  try {
    config::Episode config = Parse(text);
    (void)MakeEpisode(config, {});
  } catch (const CommandError& error) {
    return {error.code(), error.what()};
  }
  return {};
}

TEST(EpisodeConfig, UnsetMeansTheLibrarysDefault) {
  const PlanarEpisode episode = Make("");
  EXPECT_EQ(episode.world().walls().size(), Room5World().walls().size());
  config::Episode from_nothing;
  (void)MakeEpisode(from_nothing, {});
  EXPECT_EQ(from_nothing.duration_s(), PlanarEpisodeOptions{}.duration_s);
  EXPECT_EQ(from_nothing.planar().lidar().model().num_beams(), PlanarLidarOptions{}.model.num_beams);
  EXPECT_EQ(from_nothing.planar().drive().clearance_m(), PlanarDriveOptions{}.clearance_m);
  EXPECT_EQ(from_nothing.planar().odometry().rate_hz(), OdometryOptions{}.rate_hz);
  EXPECT_EQ(from_nothing.planar().people().radius_m(), PlanarPeopleOptions{}.radius_m);
}

TEST(EpisodeConfig, EffectiveConfigurationReadsBackAsItself) {
  for (const char* text : {"planar { world { box { x_m: 1 length_m: 9 width_m: 9 } } lidar { type: UTM_30LX } }",
                           "spatial { world { name: 'bare_room' } lidar { type: OS1_64 mounting { roll_rad: 1 } } }"}) {
    config::Episode config = Parse(text);
    (void)MakeEpisode(config, {});
    const std::string effective = ConfigText(config);
    config::Episode again = Parse(effective);
    (void)MakeEpisode(again, {});
    EXPECT_EQ(ConfigText(again), effective);
  }
}

TEST(EpisodeConfig, TypesAndLevelsGiveDefaultsThatFieldsOverride) {
  const auto lidar = [](const std::string& text) { return Make("planar { lidar { " + text + " } }").options().lidar; };
  EXPECT_EQ(lidar("type: UTM_30LX").model.num_beams, 1081);
  EXPECT_EQ(lidar("type: RPLIDAR_A1").model.turn_s, RplidarA1().turn_s);
  EXPECT_EQ(lidar("type: RPLIDAR_A2").model.num_beams, 800);
  EXPECT_EQ(lidar("type: UTM_30LX model { max_range_m: 7 }").model.max_range_m, 7.0);
  EXPECT_EQ(lidar("type: UTM_30LX model { max_range_m: 7 }").model.num_beams, 1081);
  EXPECT_TRUE(lidar("").noise.IsNone());
  EXPECT_EQ(lidar("noise_level: LOW").noise.sigma_m, 0.01);
  EXPECT_EQ(lidar("noise_level: RATED").noise.relative_sigma, 0.03);
  EXPECT_EQ(lidar("noise_level: RATED noise { sigma_m: 0.02 }").noise.sigma_m, 0.02);
  EXPECT_EQ(lidar("mounting { x_m: 0.1 yaw_rad: 2 }").T_body_lidar.yaw(), 2.0);
}

TEST(EpisodeConfig, UnsetInSpaceMeansTheLibrarysDefault) {
  config::Episode from_nothing = Parse("spatial {}");
  (void)MakeEpisode(from_nothing, {});
  EXPECT_EQ(from_nothing.spatial().world().name(), "hall10");
  EXPECT_EQ(from_nothing.spatial().lidar().range_sigma_m(), MultiLineLidarOptions{}.range_sigma_m);
  EXPECT_EQ(from_nothing.spatial().lidar().model().max_range_m(), VelodyneVlp16().max_range_m);
  EXPECT_EQ(from_nothing.spatial().carrier().clearance_m(), SpatialCarrierOptions{}.clearance_m);
  EXPECT_EQ(from_nothing.spatial().imu().rate_hz(), ImuOptions{}.rate_hz);
  EXPECT_FALSE(from_nothing.has_planar());
}

TEST(EpisodeConfig, FieldsInSpaceArriveInTheEpisode) {
  const SpatialEpisodeOptions options = MakeSpatial(R"(
      seed: 9
      duration_s: 3
      spatial {
        lidar { type: HDL_64E model { max_range_m: 7 } mounting { z_m: 0.1 yaw_rad: 1.5 } motion_distortion: false }
        carrier { kind: MULTICOPTER max_turn_rate_radps: 2 start_in_motion: true }
        imu { rate_hz: 100 gyroscope_bias_sigma_radps: 0 }
      })")
                                            .options();
  EXPECT_EQ(options.seed, 9U);
  EXPECT_EQ(options.lidar.model.lasers.size(), 64U);
  EXPECT_EQ(options.lidar.model.max_range_m, 7.0);
  EXPECT_EQ(options.lidar.T_body_lidar.translation.z(), 0.1);
  EXPECT_NEAR(Yaw(options.lidar.T_body_lidar.rotation), 1.5, 1e-12);
  EXPECT_FALSE(options.lidar.motion_distortion);
  EXPECT_EQ(options.carrier.carrier, SpatialCarrier::kMulticopter);
  EXPECT_EQ(options.carrier.max_turn_rate_radps, 2.0);
  EXPECT_TRUE(options.carrier.start_in_motion);
  EXPECT_EQ(options.imu.rate_hz, 100.0);
  EXPECT_EQ(options.imu.gyroscope_bias_sigma_radps, 0.0);
}

TEST(EpisodeConfig, MultiLineLidarsHaveTheirModels) {
  const auto num_lasers = [](const std::string& type) {
    return MakeSpatial("spatial { lidar { type: " + type + " } }").options().lidar.model.lasers.size();
  };
  EXPECT_EQ(num_lasers("VLP_16"), 16U);
  EXPECT_EQ(num_lasers("HDL_32E"), 32U);
  EXPECT_EQ(num_lasers("HDL_64E"), 64U);
  EXPECT_EQ(num_lasers("OS1_64"), 64U);
}

TEST(EpisodeConfig, WorldsAreAddedUp) {
  const auto walls = [](const std::string& text) {
    return Make("planar { world { " + text + " } }").world().walls().size();
  };
  const size_t room5 = Room5World().walls().size();
  EXPECT_EQ(walls("name: 'stdr10'"), Stdr10World().walls().size());
  EXPECT_EQ(walls("name: 'room5' box { x_m: 2.5 y_m: 2.5 length_m: 0.1 width_m: 0.1 }"), room5 + 4);
  EXPECT_EQ(walls("box { length_m: 4 width_m: 4 } segment { x2_m: 1 }"), 5U);
  EXPECT_EQ(walls("name: 'stdr10' random_boxes { count: 2 }"), Stdr10World().walls().size() + 8);
}

TEST(EpisodeConfig, BoxesAreMoved) {
  const auto moved_at = [](const std::string& seconds) {
    return Make(
        "duration_s: 2 planar { world { box { length_m: 3 width_m: 3 } moved_box { length_m: 4 width_m: 4 } "
        "moved_at_s: " +
        seconds + "} lidar { noise_level: NONE } }");
  };
  const PlanarEpisode moved = moved_at("1"), later = moved_at("3");
  const auto reach_m = [](const PlanarEpisode& episode, int i) { return episode.Frame(i).scan.beams.at(300).range_m; };
  EXPECT_EQ(reach_m(moved, 0), reach_m(later, 0));
  EXPECT_GT(reach_m(moved, 19), reach_m(later, 19));
}

TEST(EpisodeConfig, MapsAreRelativeToTheEpisodesFolder) {
  const TemporaryFile file;
  OccupancyGrid grid{.width = 100, .height = 80, .cells = std::vector<int8_t>(8000, -1)};
  ASSERT_EQ(WriteMapFiles(grid, file.path().string()), "");
  const std::string name = file.path().filename().string() + ".yaml";
  const PlanarEpisode episode = Make("planar { world { map: '" + name + "' } }", file.path().parent_path());
  EXPECT_TRUE(episode.world().bounds().max().isApprox(Eigen::Vector2d(5.0, 4.0)));
  for (const char* suffix : {".yaml", ".pgm"}) std::filesystem::remove(file.path().string() + suffix);

  const Refusal refusal = RefusalOf("planar { world { map: 'none.yaml' } }");
  EXPECT_EQ(refusal.code, ExitCode::kBadInput);
  EXPECT_EQ(refusal.line, "planar.world.map: none.yaml: cannot be read");
}

TEST(EpisodeConfig, RefusalsNameTheField) {
  const std::vector<std::pair<std::string, std::string>> cases{
      {"seed: -1", "seed: "},
      {"duration_s: nan", "duration_s: "},
      {"duration_s: 1e9", "duration_s: "},
      {"duration_s: 0.05", "duration_s: "},
      {"start_utime: -5", "start_utime: "},
      {"planar { world { name: 'moon' } }", "planar.world.name: "},
      {"planar { world { name: 'room5' map: 'a.yaml' } }", "planar.world.map: "},
      {"planar { world { segment { x1_m: inf } } }", "planar.world.segment[0]: "},
      {"planar { world { name: 'room5' box {} box { yaw_rad: nan } } }", "planar.world.box[1]: "},
      {"planar { world { random_boxes { count: -1 } } }", "planar.world.random_boxes.count: "},
      {"planar { world { random_boxes { min_gap_m: nan } } }", "planar.world.random_boxes.min_gap_m: "},
      {"planar { world { box {} moved_box { x_m: nan } } }", "planar.world.moved_box[0]: "},
      {"planar { world { moved_at_s: nan } }", "planar.world.moved_at_s: "},
      {"planar { world { random_boxes { count: 1 } moved_box {} } }", "planar.world.random_boxes: "},
      {"planar { lidar { model { turn_s: 0 } } }", "planar.lidar.model.turn_s: "},
      {"planar { lidar { model { max_range_m: inf } } }", "planar.lidar.model.max_range_m: "},
      {"planar { lidar { noise { sigma_m: -1 } } }", "planar.lidar.noise.sigma_m: "},
      {"planar { lidar { mounting { x_m: nan } } }", "planar.lidar.mounting.x_m: "},
      {"planar { drive { max_speed_mps: -1 } }", "planar.drive.max_speed_mps: "},
      {"planar { drive { clearance_m: 4 } }", "planar.drive.clearance_m: "},
      {"planar { odometry { rate_hz: 1e5 } }", "planar.odometry.rate_hz: "},
      {"planar { people { count: 101 } }", "planar.people.count: "},
      {"planar {} spatial {}", "spatial: "},
      {"spatial {} duration_s: 0.05", "duration_s: "},
      {"spatial { world { name: 'moon' } }", "spatial.world.name: "},
      {"spatial { lidar { range_sigma_m: -1 } }", "spatial.lidar.range_sigma_m: "},
      {"spatial { lidar { model { turn_s: 0 } } }", "spatial.lidar.model.turn_s: "},
      {"spatial { lidar { mounting { roll_rad: nan } } }", "spatial.lidar.mounting.roll_rad: "},
      {"spatial { carrier { max_tilt_rad: 2 } }", "spatial.carrier.max_tilt_rad: "},
      {"spatial { carrier { clearance_m: 5 } }", "spatial.carrier.clearance_m: "},
      {"spatial { imu { rate_hz: -1 } }", "spatial.imu.rate_hz: "},
      {"spatial { odometry { rate_hz: -1 } }", "spatial.odometry.rate_hz: "},
  };
  for (const auto& [text, field] : cases) {
    const Refusal refusal = RefusalOf(text);
    EXPECT_EQ(refusal.code, ExitCode::kUsage) << text;
    EXPECT_THAT(refusal.line, StartsWith(field)) << text;
    EXPECT_EQ(refusal.line.find('\n'), std::string::npos) << text;
  }
}

}  // namespace
}  // namespace lcmslam

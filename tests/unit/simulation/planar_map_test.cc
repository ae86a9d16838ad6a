#include "simulation/planar_map.h"

#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>

#include <boost/random/uniform_int_distribution.hpp>
#include <boost/random/uniform_real_distribution.hpp>
#include <gtest/gtest.h>
#include <png.h>

#include "geometry/pose2.h"
#include "simulation/planar_drive.h"
#include "simulation/random.h"
#include "support/temporary_file.h"

namespace lcmslam {
namespace {

using Eigen::Vector2d;

PlanarMap RandomMap(Rng& rng, double occupied_share) {
  PlanarMap map{.grid = {.origin_m = Vector2d(-1.3, 2.7), .cell_m = 0.25, .width = 17, .height = 11, .cells = {}},
                .origin_yaw_rad = 0.3};
  boost::random::uniform_real_distribution<double> uniform(0.0, 1.0);
  for (int i = 0; i < map.grid.width * map.grid.height; ++i) {
    const double draw = uniform(rng);
    map.grid.cells.push_back(draw < occupied_share ? int8_t{10} : draw > 0.95 ? int8_t{0} : int8_t{-10});
  }
  return map;
}

// From the origin to the nearest occupied cell, each cell a box met by the slab method. Origin outside all of them.
double BruteForceRange(const PlanarMap& map, const Vector2d& origin, const Vector2d& direction) {
  const Pose2 T_grid_map = Pose2(map.grid.origin_m, map.origin_yaw_rad).inverse();
  const Vector2d p = (T_grid_map * origin) / map.grid.cell_m;
  const Vector2d d = T_grid_map.rotation() * direction / map.grid.cell_m;
  double best = std::numeric_limits<double>::infinity();
  for (int row = 0; row < map.grid.height; ++row) {
    for (int column = 0; column < map.grid.width; ++column) {
      if (map.grid.At(column, row) <= 0) continue;
      const Eigen::Array2d to_low = (Vector2d(column, row) - p).array() / d.array();
      const Eigen::Array2d to_high = (Vector2d(column + 1, row + 1) - p).array() / d.array();
      const double enter = to_low.min(to_high).maxCoeff();
      const double leave = to_low.max(to_high).minCoeff();
      if (enter >= 0.0 && enter <= leave) best = std::min(best, enter);
    }
  }
  return best;
}

TEST(PlanarMap, RaysEndExactlyAtCellFaces) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    Rng rng = MakeRng(seed, RandomStream::kObjects);
    const PlanarMap map = RandomMap(rng, 0.01 * seed);
    const PlanarWorld world = WorldOf(map);
    const Pose2 T_map_grid(map.grid.origin_m, map.origin_yaw_rad);
    boost::random::uniform_real_distribution<double> angle(-4.0, 4.0);
    for (int cell = 0; cell < static_cast<int>(map.grid.cells.size()); ++cell) {
      const int column = cell % map.grid.width;
      const int row = cell / map.grid.width;
      if (map.grid.At(column, row) > 0) continue;
      const Vector2d origin = T_map_grid * Vector2d(map.grid.cell_m * Vector2d(column + 0.4, row + 0.7));
      const double heading = angle(rng);
      const Vector2d direction(std::cos(heading), std::sin(heading));
      const double expected = BruteForceRange(map, origin, direction);
      const auto hit = world.CastRay(origin, direction, 100.0);
      ASSERT_EQ(hit.has_value(), std::isfinite(expected));
      if (hit) {
        EXPECT_NEAR(hit->range_m, expected, 1e-9);
      }
    }
  }
}

TEST(PlanarMap, AdjoiningFacesBecomeOneSegment) {
  PlanarMap map{.grid = {.cell_m = 1.0, .width = 4, .height = 3, .cells = std::vector<int8_t>(12, -1)}};
  for (const int cell : {5, 6}) map.grid.cells[cell] = 1;  // a block of 2 x 1 cells in free space
  const PlanarWorld world = WorldOf(map);
  EXPECT_EQ(world.walls().size(), 4U);
  EXPECT_EQ(world.barriers().size(), 4U);  // the edge of the map
}

TEST(PlanarMap, RobotsStayInKnownFreeSpace) {
  PlanarMap map{.grid = {.cell_m = 0.1, .width = 60, .height = 40, .cells = std::vector<int8_t>(2400, -1)}};
  for (int row = 0; row < 40; ++row) {
    for (int column = 40; column < 60; ++column) map.grid.cells[row * 60 + column] = 0;  // unknown, no wall before it
  }
  const auto motion = DriveAround(WorldOf(map), 30.0, 0, {.clearance_m = 0.3}, 1);
  ASSERT_TRUE(motion.has_value());
  for (int64_t utime = 0; utime <= 30'000'000; utime += 20'000) {
    EXPECT_LE(motion->PoseAt(utime).x(), 4.0 - 0.3);
    EXPECT_GE(motion->PoseAt(utime).x(), 0.3);
  }
}

class MapFileTest : public testing::Test {
 protected:
  std::filesystem::path Write(const std::string& name, const std::string& bytes) const {
    std::ofstream(folder_ / name, std::ios::binary) << bytes;
    return folder_ / name;
  }
  std::string ErrorOf(const std::filesystem::path& path) const {
    try {
      (void)ReadPlanarMap(path);
    } catch (const BadMap& error) {
      return std::string(error.what()).substr(folder_.string().size() + 1);
    }
    return "none";
  }

  const TemporaryFolder temporary_;
  const std::filesystem::path& folder_ = temporary_.path();
};

const char* const kYaml = "image: map.pgm\nresolution: 0.1\norigin: [1, 2, 0.5]\nnegate: 0\n";
const char* const kPgm = "P2 # plain\n2 2\n# white\n255\n0 254\n205 128\n";

TEST_F(MapFileTest, ReadsWhatTheMapWriterWrites) {
  Rng rng(5);
  const OccupancyGrid grid = RandomMap(rng, 0.3).grid;
  ASSERT_EQ(WriteMapFiles(grid, (folder_ / "written").string()), "");
  const PlanarMap read = ReadPlanarMap(folder_ / "written.yaml");
  EXPECT_EQ(read.grid.width, grid.width);
  EXPECT_EQ(read.grid.height, grid.height);
  EXPECT_EQ(read.grid.cell_m, grid.cell_m);
  EXPECT_EQ(read.grid.origin_m, grid.origin_m);
  EXPECT_EQ(read.origin_yaw_rad, 0.0);
  for (size_t i = 0; i < grid.cells.size(); ++i) EXPECT_EQ(read.grid.cells[i] > 0, grid.cells[i] > 0) << i;
  for (size_t i = 0; i < grid.cells.size(); ++i) EXPECT_EQ(read.grid.cells[i] < 0, grid.cells[i] < 0) << i;
}

TEST_F(MapFileTest, ReadsPlainPgmTopRowLast) {
  Write("map.pgm", kPgm);
  const PlanarMap map = ReadPlanarMap(Write("map.yaml", kYaml));
  EXPECT_EQ(map.grid.cells, (std::vector<int8_t>{0, 0, 1, -1}));
  EXPECT_EQ(map.grid.origin_m, Vector2d(1.0, 2.0));
  EXPECT_EQ(map.origin_yaw_rad, 0.5);
}

TEST_F(MapFileTest, NegateSwapsFreeAndOccupied) {
  Write("map.pgm", kPgm);
  const PlanarMap map =
      ReadPlanarMap(Write("map.yaml", "image: map.pgm\nresolution: 1\norigin: [0, 0, 0]\nnegate: 1\n"));
  EXPECT_EQ(map.grid.cells, (std::vector<int8_t>{1, 0, -1, 1}));
}

TEST_F(MapFileTest, ReadsGrayAndColourPng) {
  const std::string yaml = "image: map.png\nresolution: 1\norigin: [0, 0, 0]\n";
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  png.width = 3;
  png.height = 1;
  png.format = PNG_FORMAT_GRAY;
  const std::vector<uint8_t> gray{0, 128, 255};
  ASSERT_NE(png_image_write_to_file(&png, (folder_ / "map.png").c_str(), 0, gray.data(), 0, nullptr), 0);
  EXPECT_EQ(ReadPlanarMap(Write("map.yaml", yaml)).grid.cells, (std::vector<int8_t>{1, 0, -1}));

  png.format = PNG_FORMAT_RGB;
  const std::vector<uint8_t> rgb{255, 0, 0, 255, 255, 255, 255, 255, 0};  // red is 2/3 occupied, yellow 1/3
  ASSERT_NE(png_image_write_to_file(&png, (folder_ / "map.png").c_str(), 0, rgb.data(), 0, nullptr), 0);
  EXPECT_EQ(ReadPlanarMap(folder_ / "map.yaml").grid.cells, (std::vector<int8_t>{1, -1, 0}));
}

TEST_F(MapFileTest, BadFilesAreNamedWithTheReason) {
  EXPECT_EQ(ErrorOf(folder_ / "no.yaml"), "no.yaml: cannot be read");
  EXPECT_EQ(ErrorOf(Write("map.yaml", "")), "map.yaml: not a map of map_server");
  EXPECT_EQ(ErrorOf(Write("map.yaml", "image: a.pgm\norigin: [0, 0, 0]\n")), "map.yaml: resolution: missing");
  EXPECT_EQ(ErrorOf(Write("map.yaml", "image: a.pgm\nresolution: x\n")), "map.yaml: resolution: malformed");
  EXPECT_EQ(ErrorOf(Write("map.yaml", "image: a.pgm\nresolution: .nan\n")), "map.yaml: resolution: must be positive");
  EXPECT_EQ(ErrorOf(Write("map.yaml", "image: a.pgm\nresolution: 1\norigin: [0, 0]\n")),
            "map.yaml: origin: must be [x, y, yaw]");
  EXPECT_EQ(ErrorOf(Write("map.yaml", std::string(kYaml) + "mode: raw\n")), "map.yaml: mode: must be trinary or scale");

  const std::filesystem::path yaml = Write("map.yaml", kYaml);
  EXPECT_EQ(ErrorOf(yaml), "map.pgm: cannot be read");
  Write("map.pgm", "GIF89a");
  EXPECT_EQ(ErrorOf(yaml), "map.pgm: neither PGM nor PNG");
  Write("map.pgm", "P5 3 3 255 xxxx");
  EXPECT_EQ(ErrorOf(yaml), "map.pgm: too short");
  Write("map.pgm", "P2 2 1 255 7");
  EXPECT_EQ(ErrorOf(yaml), "map.pgm: too short");
  Write("map.pgm", "P5 100000 100000 255 ");
  EXPECT_EQ(ErrorOf(yaml), "map.pgm: 100000 x 100000 pixels are not in 1..100000000");
  Write("map.pgm", "P5 1 1 65535 ab");
  EXPECT_EQ(ErrorOf(yaml), "map.pgm: not a PGM of 8 bits");
  Write("map.pgm", std::string("\x89PNG\r\n\x1a\n") + "rubbish");
  EXPECT_NE(ErrorOf(yaml), "none");
}

// Bytes changed, taken out or doubled, a few at a time.
std::string Mutate(std::string bytes, Rng& rng) {
  const auto draw = [&](size_t below) { return boost::random::uniform_int_distribution<size_t>(0, below - 1)(rng); };
  for (size_t i = 0, changes = 1 + draw(4); i < changes && !bytes.empty(); ++i) {
    const size_t at = draw(bytes.size());
    const size_t length = 1 + draw(8);
    switch (draw(3)) {
      case 0:
        bytes[at] = static_cast<char>(draw(256));
        break;
      case 1:
        bytes.erase(at, length);
        break;
      default:
        bytes.insert(at, bytes.substr(at, length));
    }
  }
  return bytes;
}

TEST_F(MapFileTest, MutatedFilesAreReadOrRefused) {
  const std::string png_yaml = "image: map.png\nresolution: 0.1\norigin: [0, 0, 0]\n";
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  png.width = png.height = 8;
  png.format = PNG_FORMAT_GRAY;
  const std::vector<uint8_t> gray(64, 100);
  ASSERT_NE(png_image_write_to_file(&png, (folder_ / "map.png").c_str(), 0, gray.data(), 0, nullptr), 0);
  std::ostringstream png_bytes;
  png_bytes << std::ifstream(folder_ / "map.png", std::ios::binary).rdbuf();

  Rng rng = MakeRng(1, RandomStream::kObjects);
  int read = 0;
  int refused = 0;
  const auto offer = [&](const std::string& yaml) { ErrorOf(Write("map.yaml", yaml)) == "none" ? ++read : ++refused; };
  for (int i = 0; i < 300; ++i) {
    Write("map.pgm", kPgm);
    offer(Mutate(kYaml, rng));
    Write("map.pgm", Mutate(kPgm, rng));
    offer(kYaml);
    Write("map.png", Mutate(png_bytes.str(), rng));
    offer(png_yaml);
  }
  EXPECT_GT(read, 50);
  EXPECT_GT(refused, 50);
}

}  // namespace
}  // namespace lcmslam

#include "sdf2d/map_file.h"

#include <filesystem>
#include <fstream>
#include <random>

#include <gmock/gmock.h>

#include "sdf2d/occupancy.h"
#include "support/temporary_file.h"

namespace lcmslam::sdf2d {
namespace {

// Two tiles; a wall along y = 0.1 m, seen from above.
SdfMap WallMap() {
  SdfMap map(0.05);
  map.BeginRevision();
  for (int tile_x : {0, -1}) {
    SdfTile& tile = map.Touch(tile_x, 0);
    for (int x = 0; x < SdfTile::kSide; ++x) {
      for (int y = 0; y < 6; ++y) {
        const int i = SdfTile::IndexOf(x, y);
        tile.sheets[0].distance_m[i] = static_cast<float>(0.05 * y - 0.1);
        tile.sheets[0].information[i] = 1e4F;
      }
      tile.seen_through[SdfTile::IndexOf(x, 10)] = 3;
    }
  }
  return map;
}

class MapFile : public testing::Test {
 protected:
  std::string Bytes() {
    std::ifstream file(path_, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  void Overwrite(const std::string& bytes) { std::ofstream(path_, std::ios::binary) << bytes; }
  const TemporaryFile file_;
  const std::string path_ = file_.path();
  std::string error_;
};

TEST_F(MapFile, ReadsBackExactly) {
  const SdfMap map = WallMap();
  ASSERT_EQ(WriteMap(map, path_), "");
  const auto back = ReadMap(path_, &error_);
  ASSERT_TRUE(back) << error_;
  EXPECT_EQ(back->cell_m(), map.cell_m());
  ASSERT_EQ(back->tiles().size(), 2U);
  EXPECT_EQ(back->tiles()[1].tile_x, -1);
  const std::string bytes = Bytes();
  ASSERT_EQ(WriteMap(*back, path_), "");
  EXPECT_EQ(Bytes(), bytes);
}

TEST_F(MapFile, EmptyMap) {
  ASSERT_EQ(WriteMap(SdfMap(0.1), path_), "");
  const auto back = ReadMap(path_, &error_);
  ASSERT_TRUE(back) << error_;
  EXPECT_TRUE(back->empty());
}

TEST_F(MapFile, EveryDamageIsSeen) {
  ASSERT_EQ(WriteMap(WallMap(), path_), "");
  const std::string whole = Bytes();
  std::mt19937_64 random(5);
  for (int i = 0; i < 200; ++i) {
    std::string damaged = whole;
    if (i % 2 == 0) {
      damaged[random() % damaged.size()] ^= static_cast<char>(1U << random() % 8);
    } else {
      damaged.resize(random() % damaged.size());
    }
    Overwrite(damaged);
    error_.clear();
    EXPECT_FALSE(ReadMap(path_, &error_));
    EXPECT_THAT(error_, testing::StartsWith(path_ + ": "));
  }
}

TEST_F(MapFile, NoFile) {
  EXPECT_FALSE(ReadMap("/no/such/map.sdf", &error_));
  EXPECT_THAT(error_, testing::HasSubstr("/no/such/map.sdf"));
  EXPECT_THAT(WriteMap(SdfMap(0.1), "/no/such/map.sdf"), testing::HasSubstr("/no/such/map.sdf"));
}

TEST(Occupancy, WallFreeAndUnknown) {
  const OccupancyGrid grid = ToOccupancyGrid(WallMap());
  ASSERT_EQ(grid.width, 2 * SdfTile::kSide);
  ASSERT_EQ(grid.height, SdfTile::kSide);
  EXPECT_NEAR(grid.origin_m.x(), (-SdfTile::kSide - 0.5) * 0.05, 1e-12);
  for (const int column : {0, SdfTile::kSide, grid.width - 1}) {
    EXPECT_GT(grid.At(column, 2), 0) << "the wall";
    EXPECT_EQ(grid.At(column, 0), 0) << "behind it";
    EXPECT_LT(grid.At(column, 4), 0) << "in front of it";
    EXPECT_LT(grid.At(column, 10), 0) << "seen through";
    EXPECT_EQ(grid.At(column, 20), 0) << "never seen";
  }
  EXPECT_EQ(ToOccupancyGrid(SdfMap(0.05)).width, 0);
}

// A set pose or odometry may put the robot anywhere: a map is kept of it, but no grid that spans it all.
TEST(Occupancy, NoGridOfTilesThatLieTooFarApart) {
  for (const int far : {1 << 20, 1 << 30}) {
    SdfMap map(0.05);
    map.Touch(-far, -far);
    map.Touch(far, far);
    const OccupancyGrid grid = ToOccupancyGrid(map);
    EXPECT_EQ(grid.width, 0);
    EXPECT_TRUE(grid.cells.empty());
  }
}

}  // namespace
}  // namespace lcmslam::sdf2d

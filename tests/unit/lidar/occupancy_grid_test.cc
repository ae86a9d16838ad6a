#include "lidar/occupancy_grid.h"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/temporary_file.h"

namespace lcmslam {
namespace {

using testing::HasSubstr;

OccupancyGrid TwoByThree() {  // (0, 0) occupied, (1, 2) free
  return {.origin_m = {-1.5, 0.25}, .cell_m = 0.05, .width = 2, .height = 3, .cells = {9, 0, 0, 0, 0, -3}};
}

std::string Slurp(const std::filesystem::path& path) {
  std::ostringstream bytes;
  bytes << std::ifstream(path, std::ios::binary).rdbuf();
  return bytes.str();
}

TEST(OccupancyGrid, PgmShowsTheHighestRowFirst) {
  const std::string unknown(1, '\xcd'), free(1, '\xfe'), occupied(1, '\0');
  EXPECT_EQ(EncodePgm(TwoByThree()), "P5\n2 3\n255\n" + unknown + free + unknown + unknown + occupied + unknown);
}

TEST(OccupancyGrid, YamlIsWhatMapServerReads) {
  const std::string yaml = MapYaml(TwoByThree(), "room.pgm");
  EXPECT_THAT(yaml, HasSubstr("image: room.pgm\n"));
  EXPECT_THAT(yaml, HasSubstr("resolution: 0.05\n"));
  EXPECT_THAT(yaml, HasSubstr("origin: [-1.5, 0.25, 0.0]\n"));
}

TEST(OccupancyGrid, EmptyGridIsAnEmptyImage) { EXPECT_EQ(EncodePgm({}), "P5\n0 0\n255\n"); }

TEST(OccupancyGrid, LogOddsKeepTheirSign) {
  EXPECT_EQ(QuantizeLogOdds(0.0), 0);
  EXPECT_EQ(QuantizeLogOdds(1e-9), 1);
  EXPECT_EQ(QuantizeLogOdds(-1e-9), -1);
  EXPECT_EQ(QuantizeLogOdds(0.4), 4);
  EXPECT_EQ(QuantizeLogOdds(1e9), 127);
  EXPECT_EQ(QuantizeLogOdds(-std::numeric_limits<double>::infinity()), -127);
  EXPECT_EQ(QuantizeLogOdds(std::nan("")), 0);
}

TEST(OccupancyGrid, WritesBothFilesOrSaysWhichItCannot) {
  const TemporaryFolder temporary;
  const std::filesystem::path& folder = temporary.path();
  EXPECT_EQ(WriteMapFiles(TwoByThree(), folder / "map"), "");
  EXPECT_EQ(Slurp(folder / "map.pgm"), EncodePgm(TwoByThree()));
  EXPECT_EQ(Slurp(folder / "map.yaml"), MapYaml(TwoByThree(), "map.pgm"));
  EXPECT_THAT(WriteMapFiles(TwoByThree(), folder / "absent/map"), HasSubstr("absent/map.pgm"));
}

TEST(OccupancyGrid, CoarseningKeepsWhatIsOccupied) {
  OccupancyGrid grid{{-1.0, 2.0},
                     0.05,
                     5,
                     3,
                     {0, -3, 0, 0, 0,  //
                      0, -9, 0, 4, 0,  //
                      0, 0, 0, -8, 7}};
  EXPECT_EQ(CoarsenedTo(grid, 15).width, 5);
  const OccupancyGrid coarse = CoarsenedTo(grid, 14);
  EXPECT_DOUBLE_EQ(coarse.cell_m, 0.10);
  EXPECT_EQ(coarse.origin_m, grid.origin_m);
  ASSERT_EQ(coarse.width, 3);
  ASSERT_EQ(coarse.height, 2);
  EXPECT_EQ(coarse.cells, (std::vector<int8_t>{-9, 4, 0, 0, -8, 7}));
  EXPECT_EQ(CoarsenedTo(OccupancyGrid(), 10).width, 0);
}

}  // namespace
}  // namespace lcmslam

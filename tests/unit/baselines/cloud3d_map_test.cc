#include "baselines/cloud3d_map.h"

#include <cmath>
#include <cstring>
#include <limits>
#include <sstream>

#include <gtest/gtest.h>

#include "unit/baselines/cloud3d_room.h"

namespace lcmslam::cloud3d {
namespace {

float SmallestSpacing(const std::vector<Eigen::Vector3f>& points) {
  float smallest_m2 = std::numeric_limits<float>::max();
  for (size_t i = 0; i < points.size(); ++i) {
    for (size_t j = 0; j < i; ++j) smallest_m2 = std::min(smallest_m2, (points[i] - points[j]).squaredNorm());
  }
  return std::sqrt(smallest_m2);
}

TEST(Map, KeepsItsSpacingAndMissesNothing) {
  Map map(MapOptions{.spacing_m = 0.2});
  const Cloud clouds[] = {RoomCloud(500, 1), RoomCloud(500, 2)};
  size_t size = 0;
  for (const Cloud& cloud : clouds) {
    const int grown = map.Grow(cloud);
    EXPECT_GT(grown, 0);
    size += static_cast<size_t>(grown);
    EXPECT_EQ(map.size(), size);
  }
  EXPECT_GE(SmallestSpacing(map.points()), 0.2F);
  for (const Cloud& cloud : clouds) {
    for (const Eigen::Vector3f& p : cloud.points) {
      Neighbour found;
      EXPECT_EQ(map.tree().Nearest(p, 0.2001F, 0.0F, {&found, 1}), 1) << "no map point near " << p.transpose();
    }
  }
  EXPECT_EQ(map.Grow(clouds[0]), 0) << "all of it is there";
}

TEST(Map, PointsKeepTheirNormals) {
  Map map(MapOptions{});
  map.Grow(RoomCloud(500, 3));
  ASSERT_EQ(map.normals().size(), map.points().size());
  for (size_t i = 0; i < map.size(); ++i) EXPECT_LT(map.normals()[i].dot(map.points()[i]), 0.0F);
}

TEST(Map, LeavesOutWhatIsNotFinite) {
  Map map(MapOptions{});
  Cloud cloud{.points = {{std::numeric_limits<float>::quiet_NaN(), 0, 0},
                         {0, std::numeric_limits<float>::infinity(), 0},
                         {1e30F, 0, 0},
                         {1, 0, 0}},
              .normals = std::vector<Eigen::Vector3f>(4, Eigen::Vector3f::UnitZ())};
  EXPECT_EQ(map.Grow(cloud), 2);
  EXPECT_EQ(map.Grow({}), 0);
}

TEST(Map, PlyHoldsEveryPoint) {
  Map map(MapOptions{});
  map.Grow(RoomCloud(100, 4));
  std::ostringstream out;
  WritePly(map, out);
  const std::string bytes = out.str(), end = "end_header\n";
  EXPECT_NE(bytes.find("element vertex " + std::to_string(map.size()) + "\n"), std::string::npos);
  const size_t body = bytes.find(end) + end.size();
  ASSERT_EQ(bytes.size() - body, map.size() * 6 * sizeof(float));
  Eigen::Matrix<float, 6, 1> last;
  std::memcpy(last.data(), &bytes[bytes.size() - sizeof(last)], sizeof(last));
  EXPECT_EQ(last.head<3>(), map.points().back());
  EXPECT_EQ(last.tail<3>(), map.normals().back());
}

TEST(MapOptions, FaultsAreNamed) {
  EXPECT_EQ(MapOptions{}.Validate(), "");
  EXPECT_EQ(MapOptions{.spacing_m = 0.0}.Validate(), "spacing_m: must be in [0.001, 100]");
}

}  // namespace
}  // namespace lcmslam::cloud3d

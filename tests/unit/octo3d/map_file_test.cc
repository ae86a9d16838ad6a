#include "octo3d/map_file.h"

#include <random>
#include <sstream>

#include <gtest/gtest.h>
#include <octomap/OcTree.h>

#include "octo3d/occupancy_export.h"

namespace lcmslam::octo3d {
namespace {

SurfelMap FloorMap() {
  std::vector<Eigen::Vector3f> floor;
  for (int i = 0; i < 60; ++i) {
    for (int k = 0; k < 60; ++k) floor.emplace_back(0.05F * i, 0.05F * k, 0.1F + 0.001F * ((i * 7 + k * 3) % 11));
  }
  SurfelMap map{MapOptions{}};
  map.Insert(floor, Eigen::Vector3f(1.5F, 1.5F, 2.1F));
  return map;
}

std::string Bytes(const SurfelMap& map) {
  std::ostringstream out;
  WriteMap(map, out);
  return out.str();
}

ReadMapResult Read(const std::string& bytes) {
  std::istringstream in(bytes);
  return ReadMap(in);
}

TEST(MapFile, ReadsWhatItWrote) {
  const SurfelMap map = FloorMap();
  const ReadMapResult read = Read(Bytes(map));
  ASSERT_TRUE(read.map) << read.error;
  EXPECT_EQ(Bytes(*read.map), Bytes(map));
  EXPECT_EQ(read.map->num_cells(), map.num_cells());
}

TEST(MapFile, ReadsAnEmptyMap) {
  const ReadMapResult read = Read(Bytes(SurfelMap{MapOptions{}}));
  ASSERT_TRUE(read.map) << read.error;
  EXPECT_EQ(read.map->num_cells(), 0U);
}

TEST(MapFile, SaysWhatIsWrong) {
  const std::string good = Bytes(FloorMap());
  EXPECT_EQ(Read("").error, "too short");
  EXPECT_EQ(Read(std::string(500, 'x')).error, "not a surfel map, or another version");
  std::string flipped = good;
  flipped[good.size() / 2] ^= 1;
  EXPECT_EQ(Read(flipped).error, "checksum does not match");
  EXPECT_FALSE(Read(good.substr(0, good.size() - 7)).map);
}

TEST(MapFile, NoMutationIsTaken) {
  const std::string good = Bytes(FloorMap());
  std::mt19937_64 random(3);
  for (int i = 0; i < 300; ++i) {
    std::string bad = good;
    for (int k = 0; k < 3; ++k) bad[random() % bad.size()] ^= static_cast<char>(1 + random() % 255);
    if (i % 3 == 0) bad.resize(random() % bad.size());
    EXPECT_FALSE(Read(bad).map) << i;
  }
}

TEST(WritePly, HasOneRecordASurfel) {
  const std::vector<Surfel> surfels = FloorMap().ChangedSince(0);
  ASSERT_FALSE(surfels.empty());
  std::ostringstream out;
  WritePly(surfels, out);
  const std::string header_end = "end_header\n";
  const size_t start = out.str().find(header_end);
  ASSERT_NE(start, std::string::npos);
  EXPECT_NE(out.str().find("element vertex " + std::to_string(surfels.size()) + "\n"), std::string::npos);
  EXPECT_EQ(out.str().size() - start - header_end.size(), surfels.size() * 32);
}

TEST(OccupancyExport, OctoMapReadsBothFilesBack) {
  const SurfelMap map = FloorMap();
  std::stringstream ot, bt;
  WriteOt(map, {}, ot);
  WriteBt(map, {}, bt);
  const std::unique_ptr<octomap::AbstractOcTree> any(octomap::AbstractOcTree::read(ot));
  const auto* tree = dynamic_cast<const octomap::OcTree*>(any.get());
  ASSERT_NE(tree, nullptr);
  octomap::OcTree binary(0.1);
  ASSERT_TRUE(binary.readBinary(bt));
  for (const octomap::OcTree* t : {tree, static_cast<const octomap::OcTree*>(&binary)}) {
    EXPECT_DOUBLE_EQ(t->getResolution(), map.options().leaf_m);
    for (const LeafRecord& leaf : map.Leaves()) {
      const auto* node = t->search(leaf.centre.x(), leaf.centre.y(), leaf.centre.z());
      ASSERT_NE(node, nullptr);
      EXPECT_TRUE(t->isNodeOccupied(node));
    }
    const auto* between = t->search(1.5, 1.5, 1.1);
    ASSERT_NE(between, nullptr) << "between floor and viewer";
    EXPECT_FALSE(t->isNodeOccupied(between));
    EXPECT_EQ(t->search(1.5, 1.5, -1.0), nullptr) << "below the floor is unknown";
  }
}

TEST(OccupancyExport, FreeSpaceIsOptional) {
  const SurfelMap map = FloorMap();
  std::stringstream bt;
  WriteBt(map, {.free_space = false}, bt);
  octomap::OcTree tree(0.1);
  ASSERT_TRUE(tree.readBinary(bt));
  EXPECT_EQ(tree.search(1.5, 1.5, 1.1), nullptr);
}

}  // namespace
}  // namespace lcmslam::octo3d

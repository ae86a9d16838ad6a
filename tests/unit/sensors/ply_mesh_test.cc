#include <random>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sensors/bad_input.h"
#include "sensors/ply.h"
#include "support/as_bytes.h"
#include "support/error_of.h"

namespace lcmslam {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

// A square, an edge and a triangle.
constexpr char kMesh[] =
    "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\nproperty float z\n"
    "element face 3\nproperty list uchar int vertex_indices\nend_header\n"
    "0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 2.5\n4 0 1 2 3\n2 0 1\n3 0 1 4\n";

PlyMesh Mesh(const std::string& text) { return ParsePlyMesh(AsBytes(text)); }

std::string With(const std::string& from, const std::string& to) {
  std::string text = kMesh;
  return text.replace(text.find(from), from.size(), to);
}

std::string RefusalOf(const std::string& text) {
  return ErrorOf([&] { (void)Mesh(text); });
}

TEST(PlyMesh, FacesBecomeFansOfTriangles) {
  for (const std::string& text : {std::string(kMesh), With("vertex_indices", "vertex_index")}) {
    const PlyMesh mesh = Mesh(text);
    ASSERT_EQ(mesh.vertices.size(), 5u);
    EXPECT_EQ(mesh.vertices[4], Eigen::Vector3d(0.0, 0.0, 2.5));
    EXPECT_THAT(mesh.triangles, ElementsAre(ElementsAre(0, 1, 2), ElementsAre(0, 2, 3), ElementsAre(0, 1, 4)));
  }
}

TEST(PlyMesh, SaysWhatIsWrong) {
  EXPECT_EQ(RefusalOf(With("3 0 1 4", "3 0 1 5")), "PLY line 17: a face with vertex 5 of 5");
  EXPECT_EQ(RefusalOf(With("3 0 1 4", "3 0 -1 4")), "PLY line 17: a face with vertex -1 of 5");
  EXPECT_EQ(RefusalOf(With("3 0 1 4", "3 0 one 4")), "PLY line 17: 'one' is not a number");
  EXPECT_THAT(RefusalOf(With("0 0 2.5", "0 0 nan")), HasSubstr("vertex 4 is not finite"));
  EXPECT_THAT(RefusalOf(With("float z", "float depth")), HasSubstr("no z"));
  EXPECT_THAT(RefusalOf(With("vertex_indices", "colours")), HasSubstr("no faces"));
  EXPECT_THAT(RefusalOf(With("element face", "element vertex_pair")), HasSubstr("no faces"));
  EXPECT_THAT(RefusalOf(""), HasSubstr("does not begin with 'ply'"));
}

// Whatever is changed: a mesh whose triangles have their vertices, or BadInput.
TEST(PlyMesh, SurvivesMutation) {
  int parsed = 0, refused = 0;
  for (unsigned seed = 0; seed < 10'000; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    std::string text = kMesh;
    const unsigned first = seed % 2 == 0 ? '0' : 0, count = seed % 2 == 0 ? 10 : 128;  // a digit, or anything
    for (unsigned i = 0; i < 1 + seed % 3; ++i)
      text[random() % text.size()] = static_cast<char>(first + random() % count);
    try {
      const PlyMesh mesh = Mesh(text);
      for (const auto& triangle : mesh.triangles) {
        for (const uint32_t corner : triangle) ASSERT_LT(corner, mesh.vertices.size());
      }
      ++parsed;
    } catch (const BadInput&) {
      ++refused;
    }
  }
  EXPECT_GT(parsed, 500);
  EXPECT_GT(refused, 500);
}

}  // namespace
}  // namespace lcmslam

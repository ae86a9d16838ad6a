// PCD and PLY in all their encodings, and what the columns become.

#include <bit>
#include <cmath>
#include <cstring>
#include <random>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <lzf.h>

#include "sensors/bad_input.h"
#include "sensors/pcd.h"
#include "sensors/ply.h"
#include "support/as_bytes.h"
#include "support/error_of.h"

namespace lcmslam {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

PointTable Pcd(const std::string& text) { return ParsePcd(AsBytes(text)); }
PointTable Ply(const std::string& text) { return ParsePly(AsBytes(text)); }

template <class Number>
std::string Raw(Number number, bool big_endian = false) {
  std::string bytes(sizeof number, '\0');
  std::memcpy(bytes.data(), &number, sizeof number);
  if (big_endian) std::ranges::reverse(bytes);
  return bytes;
}

// Two points with every kind of field: float x y z, uint16 ring, float64 timestamp, three normals, padding.
constexpr char kPcdHeader[] =
    "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\n"
    "FIELDS x y z ring timestamp normal _\nSIZE 4 4 4 2 8 4 1\nTYPE F F F U F F U\nCOUNT 1 1 1 1 1 3 4\n"
    "WIDTH 2\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS 2\n";

std::string PcdAscii() {
  return std::string(kPcdHeader) +
         "DATA ascii\n1.5 -2 3 7 1600000000.25 0 0 1 0 0 0 0\nnan 4e-1 0.25 65535 1600000000.5 0 0 1 0 0 0 0\n";
}

std::string PcdFields(bool by_field) {
  const std::string first[] = {
      Raw(1.5F), Raw(-2.0F), Raw(3.0F), Raw(uint16_t{7}), Raw(1600000000.25), Raw(0.0F) + Raw(0.0F) + Raw(1.0F),
      "pad_"};
  const std::string second[] = {Raw(std::nanf("")),
                                Raw(0.4F),
                                Raw(0.25F),
                                Raw(uint16_t{65535}),
                                Raw(1600000000.5),
                                Raw(0.0F) + Raw(0.0F) + Raw(1.0F),
                                "pad_"};
  std::string bytes;
  if (by_field) {
    for (size_t f = 0; f < 7; ++f) bytes += first[f] + second[f];
  } else {
    for (const std::string& field : first) bytes += field;
    for (const std::string& field : second) bytes += field;
  }
  return bytes;
}

std::string PcdBinary() { return std::string(kPcdHeader) + "DATA binary\n" + PcdFields(false); }

std::string PcdCompressed() {
  const std::string fields = PcdFields(true);
  std::string packed(2 * fields.size(), '\0');
  packed.resize(lzf_compress(fields.data(), static_cast<unsigned>(fields.size()), packed.data(),
                             static_cast<unsigned>(packed.size())));
  return std::string(kPcdHeader) + "DATA binary_compressed\n" + Raw(static_cast<uint32_t>(packed.size())) +
         Raw(static_cast<uint32_t>(fields.size())) + packed;
}

TEST(Pcd, AllEncodingsAreTheSame) {
  for (const std::string& file : {PcdAscii(), PcdBinary(), PcdCompressed()}) {
    const PointTable table = Pcd(file);
    EXPECT_EQ(table.num_points, 2u);
    EXPECT_EQ(table.columns.size(), 5u);
    EXPECT_EQ(table.columns.at("x")[0], 1.5);
    EXPECT_TRUE(std::isnan(table.columns.at("x")[1]));
    EXPECT_NEAR(table.columns.at("y")[1], 0.4, 1e-7);
    EXPECT_THAT(table.columns.at("z"), ElementsAre(3.0, 0.25));
    EXPECT_THAT(table.columns.at("ring"), ElementsAre(7.0, 65535.0));
    EXPECT_THAT(table.columns.at("timestamp"), ElementsAre(1600000000.25, 1600000000.5));
  }
}

TEST(Pcd, NoPointsAreFine) {
  const std::string header = "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nPOINTS 0\n";
  for (const char* data : {"DATA ascii\n", "DATA binary\n", "DATA ascii"}) {
    EXPECT_TRUE(ToSweepPoints(Pcd(header + data)).empty());
  }
}

TEST(Pcd, SaysWhatIsWrong) {
  const auto with = [](const std::string& from, const std::string& to) {
    std::string text = PcdAscii();
    text.replace(text.find(from), from.size(), to);
    return ErrorOf([&] { (void)Pcd(text); });
  };
  EXPECT_EQ(with("VERSION", "VERSION"), "");
  EXPECT_THAT(with("SIZE 4", "SIZE 3"), HasSubstr("no number has 3 bytes"));
  EXPECT_THAT(with("TYPE F", "TYPE Q"), HasSubstr("PCD line 5: unknown TYPE 'Q'"));
  EXPECT_THAT(with("COUNT 1 ", "COUNT "), HasSubstr("COUNT for 7 fields has 6 values"));
  EXPECT_THAT(with("POINTS 2", "POINTS 3"), HasSubstr("fewer points"));
  EXPECT_THAT(with("POINTS 2", "POINTS 4000000000"), HasSubstr("fewer points"));
  EXPECT_THAT(with("POINTS 2", "POINTS two"), HasSubstr("'two' is not a number"));
  EXPECT_THAT(with("DATA ascii", "DATA braille"), HasSubstr("unknown DATA 'braille'"));
  EXPECT_THAT(with("DATA ascii", "# DATA ascii"), HasSubstr("no DATA"));
  EXPECT_THAT(with("x y z", "x x z"), HasSubstr("x twice"));
  EXPECT_THAT(with("1.5 -2", "1.5 two"), HasSubstr("PCD line 12: 'two' is not a number"));
  EXPECT_THAT(with("0 0 1 0 0 0 0\nnan", "0 0 1\nnan"), HasSubstr("fewer values"));
  EXPECT_THAT(ErrorOf([] { (void)Pcd(""); }), HasSubstr("no DATA"));
  EXPECT_THAT(ErrorOf([] { (void)Pcd(PcdBinary().substr(0, PcdBinary().size() - 1)); }), HasSubstr("fewer points"));
  EXPECT_THAT(ErrorOf([] { (void)Pcd(PcdCompressed().substr(0, PcdCompressed().size() - 1)); }), HasSubstr("shorter"));
}

constexpr char kPlyVertex[] =
    "comment made by hand\nelement camera 1\nproperty list uchar int matrix\nelement vertex 2\n"
    "property float x\nproperty double y\nproperty float z\nproperty list uchar short labels\nproperty uchar "
    "intensity\n"
    "element face 1\nproperty list uchar int vertex_indices\nend_header\n";

std::string PlyAscii() {
  return "ply\nformat ascii 1.0\n" + std::string(kPlyVertex) +
         "2 11 12\n1.5 -2 3 2 8 9 255\nnan 0.5 0.25 0 7\n3 0 1 1\n";
}

std::string PlyBinary(bool big_endian) {
  const auto raw = [&](auto number) { return Raw(number, big_endian); };
  return std::string("ply\nformat ") + (big_endian ? "binary_big_endian" : "binary_little_endian") + " 1.0\n" +
         kPlyVertex + raw(uint8_t{2}) + raw(11) + raw(12) +  //
         raw(1.5F) + raw(-2.0) + raw(3.0F) + raw(uint8_t{2}) + raw(int16_t{8}) + raw(int16_t{9}) +
         raw(uint8_t{255}) +                                                               //
         raw(std::nanf("")) + raw(0.5) + raw(0.25F) + raw(uint8_t{0}) + raw(uint8_t{7}) +  //
         raw(uint8_t{3}) + raw(0) + raw(1) + raw(1);
}

TEST(Ply, AllEncodingsAreTheSame) {
  for (const std::string& file : {PlyAscii(), PlyBinary(false), PlyBinary(true)}) {
    const PointTable table = Ply(file);
    EXPECT_EQ(table.num_points, 2u);
    EXPECT_EQ(table.columns.size(), 4u);
    EXPECT_EQ(table.columns.at("x")[0], 1.5);
    EXPECT_TRUE(std::isnan(table.columns.at("x")[1]));
    EXPECT_THAT(table.columns.at("y"), ElementsAre(-2.0, 0.5));
    EXPECT_THAT(table.columns.at("z"), ElementsAre(3.0, 0.25));
    EXPECT_THAT(table.columns.at("intensity"), ElementsAre(255.0, 7.0));
  }
}

TEST(Ply, SaysWhatIsWrong) {
  const auto with = [](const std::string& from, const std::string& to) {
    std::string text = PlyAscii();
    text.replace(text.find(from), from.size(), to);
    return ErrorOf([&] { (void)Ply(text); });
  };
  EXPECT_EQ(with("comment", "obj_info"), "");
  EXPECT_THAT(with("ply", "plywood"), HasSubstr("PLY line 1: does not begin with 'ply'"));
  EXPECT_THAT(with("format ascii 1.0\n", ""), HasSubstr("no format"));
  EXPECT_THAT(with("ascii", "binary_middle_endian"), HasSubstr("unknown format"));
  EXPECT_THAT(with("property double", "property quad"), HasSubstr("unknown type 'quad'"));
  EXPECT_THAT(with("uchar short", "float short"), HasSubstr("fraction"));
  EXPECT_THAT(with("element vertex 2", "element vertex 3"), HasSubstr("fewer numbers"));
  EXPECT_THAT(with("element vertex 2", "element vertex 4000000000"), HasSubstr("fewer numbers"));
  EXPECT_THAT(with("element vertex", "element vertices"), HasSubstr("no element vertex"));
  EXPECT_THAT(with("float z", "float x"), HasSubstr("x twice"));
  EXPECT_THAT(with("2 11 12", "99 11 12"), HasSubstr("list beyond the end"));
  EXPECT_THAT(with("end_header", ""), HasSubstr("unknown word '2'"));
  EXPECT_THAT(ErrorOf([] { (void)Ply("ply\nproperty float x\n"); }), HasSubstr("property of no element"));
  EXPECT_THAT(ErrorOf([] { (void)Ply("ply\nformat ascii 1.0\n"); }), HasSubstr("no end"));
}

// Whatever is changed: a table, or BadInput.
TEST(PointFiles, SurviveMutation) {
  const std::string files[] = {PcdAscii(), PcdBinary(), PcdCompressed(), PlyAscii(), PlyBinary(false), PlyBinary(true)};
  int parsed = 0, refused = 0;
  for (unsigned seed = 0; seed < 6000; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    std::string bytes = files[seed % 6];
    for (unsigned i = 0; i < 1 + seed % 5; ++i) bytes[random() % bytes.size()] = static_cast<char>(random());
    if (seed % 7 == 0) bytes.resize(random() % bytes.size());
    try {
      const PointTable table = seed % 6 < 3 ? Pcd(bytes) : Ply(bytes);
      for (const auto& [name, column] : table.columns) ASSERT_EQ(column.size(), table.num_points) << name;
      ++parsed;
      (void)ToSweepPoints(table);
    } catch (const BadInput&) {
      ++refused;
    }
  }
  EXPECT_GT(parsed, 500);
  EXPECT_GT(refused, 500);
}

PointTable Table(std::map<std::string, std::vector<double>, std::less<>> columns) {
  for (const char* axis : {"x", "y", "z"}) columns.try_emplace(axis, std::vector<double>{1.0, 2.0});
  return {.num_points = 2, .columns = std::move(columns)};
}

TEST(ToSweepPoints, TakesWhatIsThere) {
  const auto bare = ToSweepPoints(Table({}));
  ASSERT_EQ(bare.size(), 2u);
  EXPECT_EQ(bare[1].z, 2.0F);
  EXPECT_EQ(bare[1].ring, -1);
  EXPECT_EQ(bare[1].dt_us, 0);
  const auto full = ToSweepPoints(Table({{"i", {0.5, 1.0}}, {"laser_id", {3.0, 4.0}}, {"t", {5e6, 95e6}}}));
  EXPECT_EQ(full[0].intensity, 0.5F);
  EXPECT_EQ(full[1].ring, 4);
  EXPECT_EQ(full[0].dt_us, -90'000);
  EXPECT_EQ(full[1].dt_us, 0);
  const auto seconds = ToSweepPoints(Table({{"timestamp", {1600000000.1, 1600000000.0}}}));
  EXPECT_EQ(seconds[0].dt_us, 0);
  EXPECT_NEAR(seconds[1].dt_us, -100'000, 1);
}

TEST(ToSweepPoints, KnowsTheUnitsOfTimes) {
  const auto check = [](const char* name, double first, double last, double latest_us, double tolerance_us) {
    SCOPED_TRACE(name);
    const PointTable table = Table({{name, {first, last}}});
    EXPECT_NEAR(ToSweepPoints(table)[0].dt_us, -100'000, 1);
    EXPECT_NEAR(*LatestTime_us(table), latest_us, tolerance_us);
  };
  check("t", 0.0, 1e8, 1e5, 1e-6);                                                      // Ouster: ns
  check("offset_time", 5e7, 1.5e8, 1.5e5, 1e-6);                                        // Livox: ns
  check("time", -0.1, 0.0, 0.0, 1e-6);                                                  // Velodyne: s
  check("timestamp", 1600000000.0, 1600000000.1, 1.6e15 + 1e5, 1.0);                    // Hesai: s since 1970
  check("timestamp", 1600000000000000000.0, 1600000000100000000.0, 1.6e15 + 1e5, 1.0);  // Livox: ns since 1970
  EXPECT_FALSE(LatestTime_us(Table({})).has_value());
}

TEST(ToSweepPoints, RefusesAbsurdities) {
  const auto error_of = [](const PointTable& table) { return ErrorOf([&] { (void)ToSweepPoints(table); }); };
  EXPECT_THAT(error_of({}), HasSubstr("points without x"));
  EXPECT_THAT(error_of(Table({{"ring", {1.0, -1.0}}})), HasSubstr("ring -1"));
  EXPECT_THAT(error_of(Table({{"ring", {1.0, NAN}}})), HasSubstr("ring nan"));
  EXPECT_THAT(error_of(Table({{"time", {0.0, 1e6}}})), HasSubstr("absurd times"));
  EXPECT_THAT(error_of(Table({{"time", {0.0, NAN}}})), HasSubstr("absurd times"));
  EXPECT_THAT(error_of(Table({{"time", {NAN, NAN}}})), HasSubstr("absurd times"));
}

}  // namespace
}  // namespace lcmslam

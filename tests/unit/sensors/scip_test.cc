#include "sensors/scip.h"

#include <numbers>
#include <random>
#include <string>

#include <gtest/gtest.h>

#include "sensors/bad_input.h"
#include "support/scip_bytes.h"

namespace lcmslam {
namespace {

std::vector<ScipReply> Replies(const std::string& bytes, size_t piece = 1'000'000) {
  ScipReplyReader reader;
  std::vector<ScipReply> replies;
  for (size_t at = 0; at < bytes.size(); at += piece) {
    reader.Append(bytes.substr(at, piece));
    while (auto reply = reader.Next()) replies.push_back(*std::move(reply));
  }
  return replies;
}

TEST(Scip, AnswersOfAnUrg04Lx) {
  for (const size_t piece : {1U, 7U, 1000U}) {
    const std::vector<ScipReply> replies = Replies(std::string("BM\n02R\n\n") + kScipUrg04LxParameters, piece);
    ASSERT_EQ(replies.size(), 2U);
    EXPECT_EQ(replies[0].status, "02");
    EXPECT_EQ(replies[1].command, "PP");
    EXPECT_EQ(replies[1].lines.at(0), "MODL:URG-04LX(Hokuyo Automatic Co.,Ltd.)");
    const ScipParameters parameters = ParseScipParameters(replies[1]);
    EXPECT_EQ(parameters.first_step, 44);
    EXPECT_EQ(parameters.last_step, 725);
    EXPECT_EQ(parameters.front_step, 384);
    EXPECT_EQ(parameters.steps_per_turn, 1024);
    EXPECT_NEAR(parameters.turn_s, 0.1, 1e-12);
    EXPECT_NEAR(parameters.max_range_m, 5.6, 1e-12);
    EXPECT_EQ(ScipScanCommand(parameters), "MD0044072501000\n");
  }
}

// The specification's own example: "1Dh" is 5432 mm.
TEST(Scip, RangesAreSixBitsACharacter) { EXPECT_EQ(ScipRange(5432), "1Dh"); }

TEST(Scip, ScansCountFromTheFront) {
  const ScipParameters parameters = ParseScipParameters(Replies(kScipUrg04LxParameters).at(0));
  std::vector<int> ranges_mm(682, 1000);
  ranges_mm[340] = 5432;  // step 384
  ranges_mm[0] = 7;       // an error code
  const std::vector<ScipReply> replies = Replies(ScipScan("MD0044072501000", ranges_mm));
  ASSERT_EQ(replies.size(), 1U);
  EXPECT_EQ(replies[0].status, "99");
  const PlanarScan scan = DecodeScipScan(replies[0], parameters, 9'000'000);
  ASSERT_EQ(scan.beams.size(), 682U);
  EXPECT_EQ(scan.utime, 9'000'000);
  EXPECT_EQ(scan.beams[340].angle_rad, 0.0F);
  EXPECT_FLOAT_EQ(scan.beams[340].range_m, 5.432F);
  EXPECT_EQ(scan.beams[0].range_m, 0.0F);
  EXPECT_NEAR(scan.beams[0].angle_rad, -340 * 2 * std::numbers::pi / 1024, 1e-6);
  EXPECT_EQ(scan.beams[681].dt_us, 0);
  EXPECT_NEAR(scan.beams[0].dt_us, -681 * 1e5 / 1024, 1.0);
}

// 64 characters of data a line, of which ';' may be the last.
TEST(Scip, SemicolonsInScansAreData) {
  ScipParameters parameters = ParseScipParameters(Replies(kScipUrg04LxParameters).at(0));
  parameters.max_range_m = 60.0;
  std::vector<int> ranges_mm(682, 1000);
  ranges_mm[21] = (';' - 0x30) << 12 | 1;  // character 63
  const PlanarScan scan = DecodeScipScan(Replies(ScipScan("MD0044072501000", ranges_mm)).at(0), parameters, 0);
  EXPECT_FLOAT_EQ(scan.beams[21].range_m, 45.057F);
}

TEST(Scip, PassesOverWhatIsDamaged) {
  std::string scan = ScipScan("MD0044072501000", std::vector<int>(682, 1000));
  scan[100] ^= 1;
  ScipReplyReader reader;
  reader.Append("st of a scan0\n\n" + scan + std::string("\n\n") + "QT\n00P\n\n");
  const auto reply = reader.Next();
  ASSERT_TRUE(reply);
  EXPECT_EQ(reply->command, "QT");
  EXPECT_EQ(reader.refused(), 3);
  EXPECT_FALSE(reader.Next());
  reader.Append(std::string(200'000, 'x'));
  EXPECT_FALSE(reader.Next());
  EXPECT_EQ(reader.refused(), 4);
}

TEST(Scip, RefusesParametersAndScansThatCannotBe) {
  ScipReply parameters = Replies(kScipUrg04LxParameters).at(0);
  const auto with = [&](size_t line, const std::string& text) {
    ScipReply changed = parameters;
    changed.lines[line] = text;
    return changed;
  };
  for (const ScipReply& bad : {with(3, ""), with(3, "ARES:0"), with(4, "AMIN:900"), with(5, "AMAX:99999"),
                               with(7, "SCAN:0"), with(7, "SCAN:x")}) {
    EXPECT_THROW((void)ParseScipParameters(bad), BadInput);
  }
  const ScipReply scan = Replies(ScipScan("MD0044072501000", std::vector<int>(681, 1000))).at(0);
  EXPECT_THROW((void)DecodeScipScan(scan, ParseScipParameters(parameters), 0), BadInput);
  EXPECT_THROW((void)DecodeScipScan({}, ParseScipParameters(parameters), 0), BadInput);
}

TEST(Scip, MutatedBytesAreRefusedOrRead) {
  const std::string good =
      std::string(kScipUrg04LxParameters) + ScipScan("MD0044072501000", std::vector<int>(682, 1000));
  std::mt19937 random(1);
  size_t replies = 0;
  for (int i = 0; i < 10'000; ++i) {
    std::string bytes = good;
    for (unsigned n = 1 + random() % 3; n > 0; --n) bytes[random() % bytes.size()] = static_cast<char>(random());
    for (const ScipReply& reply : Replies(bytes)) {
      ++replies;
      try {
        (void)DecodeScipScan(reply, ParseScipParameters(reply), 0);
      } catch (const BadInput&) {
      }
    }
  }
  EXPECT_GT(replies, 5'000U);
  EXPECT_LT(replies, 19'000U);
}

}  // namespace
}  // namespace lcmslam

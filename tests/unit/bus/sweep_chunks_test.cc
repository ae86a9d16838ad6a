#include "bus/sweep_chunks.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <gmock/gmock.h>
#include <lcmslam/imu_t.hpp>
#include <lcmslam/point_cloud_chunk_t.hpp>

namespace lcmslam {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

// Point i lies at x = i and was measured i us after the first.
Sweep CountingSweep(int64_t utime, int points) {
  Sweep sweep{utime, {}};
  for (int i = 0; i < points; ++i) {
    sweep.points.push_back({static_cast<float>(i), 2.0F, NAN, 7.0F, static_cast<int16_t>(i % 16), i + 1 - points});
  }
  return sweep;
}

std::vector<int64_t> Stamps(const std::vector<Sweep>& sweeps) {
  std::vector<int64_t> stamps;
  for (const Sweep& sweep : sweeps) stamps.push_back(sweep.utime);
  return stamps;
}

// Chunks of three sweeps of four chunks each: chunks[sweep][chunk].
std::vector<std::vector<point_cloud_chunk_t>> ThreeSweeps(int32_t first_number = 0) {
  std::vector<std::vector<point_cloud_chunk_t>> chunks;
  for (int i = 0; i < 3; ++i) chunks.push_back(ToChunks(CountingSweep(100'000 * (i + 1), 3'600), first_number + i));
  return chunks;
}

TEST(SweepChunks, SweepGoesThroughTheWireInSmallChunks) {
  const Sweep sweep = CountingSweep(5'000'000, 29'123);
  SweepAssembler assembler;
  std::vector<Sweep> sweeps;
  for (const point_cloud_chunk_t& chunk : ToChunks(sweep, 3)) {
    const std::vector<uint8_t> bytes = Encode(chunk);
    EXPECT_LE(bytes.size(), 22'000U);
    const auto decoded = DecodeChunk(bytes);
    ASSERT_TRUE(decoded);
    EXPECT_THAT(sweeps, IsEmpty());
    for (Sweep& ended : assembler.Add(*decoded)) sweeps.push_back(std::move(ended));
  }
  ASSERT_THAT(sweeps, SizeIs(1));
  EXPECT_EQ(sweeps[0].utime, sweep.utime);
  ASSERT_EQ(sweeps[0].points.size(), sweep.points.size());
  for (size_t i = 0; i < sweep.points.size(); ++i) {
    const SweepPoint &a = sweeps[0].points[i], &b = sweep.points[i];
    ASSERT_EQ(a.x, b.x);
    ASSERT_TRUE(std::isnan(a.z));
    ASSERT_EQ(a.intensity, b.intensity);
    ASSERT_EQ(a.ring, b.ring);
    ASSERT_EQ(a.dt_us, b.dt_us);
  }
  EXPECT_EQ(assembler.missing(), 0);
}

TEST(SweepChunks, EmptySweepIsOneChunk) {
  SweepAssembler assembler;
  const auto chunks = ToChunks(Sweep{7, {}}, 0);
  ASSERT_THAT(chunks, SizeIs(1));
  const auto sweeps = assembler.Add(chunks[0]);
  ASSERT_THAT(sweeps, SizeIs(1));
  EXPECT_THAT(sweeps[0].points, IsEmpty());
}

TEST(SweepChunks, AnyOrderWithinASweep) {
  auto chunks = ThreeSweeps()[0];
  std::ranges::reverse(chunks);
  chunks.insert(chunks.begin(), chunks.front());  // and one comes twice
  SweepAssembler assembler;
  std::vector<Sweep> sweeps;
  for (const auto& chunk : chunks) {
    for (Sweep& ended : assembler.Add(chunk)) sweeps.push_back(std::move(ended));
  }
  ASSERT_THAT(sweeps, SizeIs(1));
  EXPECT_TRUE(std::ranges::is_sorted(sweeps[0].points, {}, &SweepPoint::x));
  EXPECT_EQ(assembler.late(), 1);
  EXPECT_EQ(assembler.missing(), 0);
}

TEST(SweepChunks, LostChunkIsCountedAndTheRestComes) {
  const auto chunks = ThreeSweeps();
  SweepAssembler assembler;
  for (const int i : {0, 1, 3}) EXPECT_THAT(assembler.Add(chunks[0][static_cast<size_t>(i)]), IsEmpty());
  for (const int i : {0, 1, 2}) EXPECT_THAT(assembler.Add(chunks[1][static_cast<size_t>(i)]), IsEmpty());
  const auto sweeps = assembler.Add(chunks[1][3]);
  EXPECT_THAT(Stamps(sweeps), ElementsAre(100'000, 200'000));
  EXPECT_THAT(sweeps[0].points, SizeIs(2'700));
  EXPECT_EQ(assembler.missing(), 1);
  EXPECT_THAT(assembler.Add(chunks[0][2]), IsEmpty());
  EXPECT_EQ(assembler.late(), 1);
}

TEST(SweepChunks, ASweepWaitsForAtMostTwo) {
  const auto chunks = ThreeSweeps();
  SweepAssembler assembler;
  EXPECT_THAT(assembler.Add(chunks[0][0]), IsEmpty());
  EXPECT_THAT(assembler.Add(chunks[1][0]), IsEmpty());
  EXPECT_THAT(Stamps(assembler.Add(chunks[2][0])), ElementsAre(100'000));
  EXPECT_THAT(Stamps(assembler.Finish()), ElementsAre(200'000, 300'000));
  EXPECT_EQ(assembler.missing(), 9);
}

TEST(SweepChunks, LostSweepIsCounted) {
  const auto chunks = ThreeSweeps();
  SweepAssembler assembler;
  for (const size_t sweep : {0, 2}) {
    for (const auto& chunk : chunks[sweep]) (void)assembler.Add(chunk);
  }
  EXPECT_EQ(assembler.missing(), 4);
}

TEST(SweepChunks, SenderThatStartsAnewIsFollowed) {
  SweepAssembler assembler;
  size_t sweeps = 0;
  for (const int32_t first : {500, 0, INT32_MAX - 2, INT32_MIN}) {
    for (const auto& sweep : ThreeSweeps(first)) {
      for (const auto& chunk : sweep) sweeps += assembler.Add(chunk).size();
    }
  }
  EXPECT_EQ(sweeps, 12U);
  EXPECT_EQ(assembler.missing(), 0);
}

TEST(SweepChunks, StampIsTheLastPoint) {
  auto chunk = ToChunks(CountingSweep(1000, 3), 0)[0];
  chunk.time_offset = {0, 40, 100};  // a driver that stamps the first point
  SweepAssembler assembler;
  const auto sweeps = assembler.Add(chunk);
  ASSERT_THAT(sweeps, SizeIs(1));
  EXPECT_EQ(sweeps[0].utime, 1100);
  EXPECT_EQ(sweeps[0].points[0].dt_us, -100);
  EXPECT_EQ(sweeps[0].points[2].dt_us, 0);
}

TEST(SweepChunks, BadChunksAreRefused) {
  auto chunk = ToChunks(CountingSweep(1000, 3), 0)[0];
  EXPECT_TRUE(DecodeChunk(Encode(chunk)));
  for (const auto& [index, count] : {std::pair{-1, 1}, {1, 1}, {0, 0}, {0, -5}}) {
    chunk.chunk = static_cast<int16_t>(index);
    chunk.num_chunks = static_cast<int16_t>(count);
    EXPECT_FALSE(DecodeChunk(Encode(chunk))) << index << " of " << count;
  }
  chunk = ToChunks(CountingSweep(INT64_MAX, 3), 0)[0];
  EXPECT_FALSE(DecodeChunk(Encode(chunk)));
}

// Whatever headers come: nothing is lost but what was counted.
TEST(SweepChunks, RandomHeadersAreSurvived) {
  std::mt19937_64 random(1);
  SweepAssembler assembler;
  int64_t given = 0, come = 0;
  for (int i = 0; i < 20'000; ++i) {
    const Sweep one{static_cast<int64_t>(random() % 3), {{1.0F, 2.0F, 3.0F, 0.0F, 0, 0}}};
    auto chunk = ToChunks(one, static_cast<int32_t>(random() % 300))[0];
    chunk.num_chunks = static_cast<int16_t>(1 + random() % 4);
    chunk.chunk = static_cast<int16_t>(random() % static_cast<uint64_t>(chunk.num_chunks));
    ++given;
    for (const Sweep& sweep : assembler.Add(chunk)) come += static_cast<int64_t>(sweep.points.size());
  }
  for (const Sweep& sweep : assembler.Finish()) come += static_cast<int64_t>(sweep.points.size());
  EXPECT_EQ(come + assembler.late(), given);
}

TEST(Imu, GoesThroughTheWire) {
  const ImuSample sample{9, {0.1, -0.2, 0.3}, {0.0, 0.5, 9.8}};
  const auto back = DecodeImu(Encode(ToMessage(sample)));
  ASSERT_TRUE(back);
  EXPECT_EQ(back->utime, 9);
  EXPECT_EQ(back->angular_velocity_radps, sample.angular_velocity_radps);
  EXPECT_EQ(back->specific_force_mps2, sample.specific_force_mps2);
  imu_t message = ToMessage(sample);
  message.specific_force[1] = NAN;
  EXPECT_FALSE(DecodeImu(Encode(message)));
}

}  // namespace
}  // namespace lcmslam

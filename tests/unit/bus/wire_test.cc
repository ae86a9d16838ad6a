#include "bus/wire.h"

#include <random>

#include <gtest/gtest.h>

#include "support/every_type.h"
#include "support/sample_messages.h"

namespace lcmslam {
namespace {

template <class M>
class Wire : public testing::Test {};

template <class Tuple>
struct AsTypes;
template <class... Messages>
struct AsTypes<std::tuple<Messages...>> {
  using Types = testing::Types<Messages...>;
};
TYPED_TEST_SUITE(Wire, AsTypes<EveryType>::Types);

TYPED_TEST(Wire, DecodesWhatItEncodes) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 50; ++i) {
    const std::vector<uint8_t> bytes = Encode(RandomMessage<TypeParam>(random));
    EXPECT_TRUE(LayoutFits<TypeParam>(bytes));
    const auto decoded = Decode<TypeParam>(bytes);
    ASSERT_TRUE(decoded);
    EXPECT_EQ(Encode(*decoded), bytes);
  }
}

TYPED_TEST(Wire, RefusesEveryOtherLength) {
  std::mt19937_64 random(2);
  std::vector<uint8_t> bytes = Encode(RandomMessage<TypeParam>(random));
  for (size_t n = 0; n < bytes.size(); ++n) ASSERT_FALSE(Decode<TypeParam>(Bytes(bytes).first(n))) << n;
  bytes.push_back(0);
  EXPECT_FALSE(Decode<TypeParam>(bytes));
}

// Any bytes either decode to a message that encodes to the same bytes, or are refused; nothing throws.
TYPED_TEST(Wire, SurvivesMutation) {
  std::mt19937_64 random(3);
  int refused = 0;
  for (int i = 0; i < 10'000; ++i) {
    const std::vector<uint8_t> bytes = Mutate(Encode(RandomMessage<TypeParam>(random)), random);
    const auto decoded = Decode<TypeParam>(bytes);
    refused += decoded ? 0 : 1;
    if (decoded) {
      ASSERT_EQ(decoded->getEncodedSize(), static_cast<int>(bytes.size()));
    }
  }
  EXPECT_GT(refused, 100);
}

TEST(Wire, RefusesCountsThatGeneratedDecodersTrust) {
  planar_scan_t scan{};
  std::vector<uint8_t> bytes = Encode(scan);
  for (const int32_t count : {-1, 1, 0x7fffffff, static_cast<int32_t>(0x80000000)}) {
    for (int i = 0; i < 4; ++i)
      bytes[16 + static_cast<size_t>(i)] = static_cast<uint8_t>(static_cast<uint32_t>(count) >> (24 - 8 * i));
    EXPECT_FALSE(Decode<planar_scan_t>(bytes)) << count;
  }
}

TEST(Wire, FingerprintsAreThoseOfMBotAndBotCore) {
  EXPECT_EQ(static_cast<uint64_t>(planar_scan_t::getHash()), 0x89dc5b879a5056cf);
  EXPECT_EQ(static_cast<uint64_t>(planar_lidar_t::getHash()), 0xe3d17423180b5e8d);
  EXPECT_EQ(static_cast<uint64_t>(pose_t::getHash()), 0x2e16efb052b0105e);
  EXPECT_EQ(static_cast<uint64_t>(pose_xyt_t::getHash()), 0x1f317af1246276ac);
  EXPECT_EQ(static_cast<uint64_t>(rigid_transform_t::getHash()), 0xea9ffbf2acc5c5ae);
  EXPECT_EQ(static_cast<uint64_t>(occupancy_grid_t::getHash()), 0xd5447e494a66cc92);
}

}  // namespace
}  // namespace lcmslam

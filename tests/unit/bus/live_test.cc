#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <unistd.h>

#include "bus/clock.h"
#include "bus/errors.h"
#include "bus/live_bus.h"
#include "bus/live_receiver.h"

namespace lcmslam {
namespace {

using std::chrono::milliseconds;

// A real multicast bus; the port differs between processes that run at the same time.
class Live : public testing::Test {
 protected:
  void SetUp() override {
    try {
      sender_ = std::make_unique<LiveBus>(url_);
      receiving_ = std::make_unique<LiveBus>(url_);
    } catch (const CommandError& error) {
      GTEST_SKIP() << error.what();
    }
  }
  void Send(int count) {
    for (int i = 0; i < count; ++i) sender_->Publish("COUNT", Bytes(std::vector<uint8_t>{static_cast<uint8_t>(i)}));
  }

  std::string url_ = "udpm://239.255.76.67:" + std::to_string(20'000 + getpid() % 20'000) + "?ttl=0";
  std::unique_ptr<LiveBus> sender_, receiving_;
};

TEST_F(Live, DeliversInOrder) {
  LiveReceiver receiver(*receiving_, "COUNT", 1000);
  Send(100);
  for (int i = 0; i < 100; ++i) {
    const auto arrival = receiver.Pop(milliseconds(2000));
    ASSERT_TRUE(arrival) << i;
    EXPECT_EQ(arrival->channel, "COUNT");
    EXPECT_EQ(arrival->data, std::vector<uint8_t>{static_cast<uint8_t>(i)});
  }
  EXPECT_EQ(receiver.dropped(), 0);
}

TEST_F(Live, HearsTheChannelsAskedForAndNoOther) {
  LiveReceiver receiver(*receiving_, "(COUNT)|(LIDAR_2D(_EXTRINSICS)?)", 1000);
  const Bytes data{};
  for (const char* channel : {"LIDAR_2D", "LIDAR_2D_FRONT", "LIDAR_2D_EXTRINSICS", "ACCOUNT", "COUNTS", "COUNT"})
    sender_->Publish(channel, data);
  std::vector<std::string> heard;
  while (heard.size() < 3) {
    const auto arrival = receiver.Pop(milliseconds(2000));
    ASSERT_TRUE(arrival);
    heard.push_back(arrival->channel);
  }
  EXPECT_THAT(heard, testing::ElementsAre("LIDAR_2D", "LIDAR_2D_EXTRINSICS", "COUNT"));
}

// liblcm sends anything larger than a datagram in fragments.
TEST_F(Live, HearsLargeMessages) {
  LiveReceiver receiver(*receiving_, "LARGE", 1000);
  for (const size_t size : {1'000U, 65'000U, 66'000U, 100'000U}) {
    std::vector<uint8_t> data(size);
    for (size_t i = 0; i < size; ++i) data[i] = static_cast<uint8_t>(i * i);
    sender_->Publish("LARGE", data);
    const auto arrival = receiver.Pop(milliseconds(2000));
    ASSERT_TRUE(arrival) << size;
    EXPECT_EQ(arrival->data, data) << size;
  }
}

TEST_F(Live, KnowsWhenAMessageArrivedThoughItWasReadLater) {
  LiveReceiver receiver(*receiving_, "COUNT", 1000);
  const int64_t before_utime = WallClockUtime();
  Send(1);
  const int64_t after_utime = WallClockUtime();
  std::this_thread::sleep_for(milliseconds(50));
  const auto arrival = receiver.Pop(milliseconds(2000));
  ASSERT_TRUE(arrival);
  EXPECT_GE(arrival->utime, before_utime);
  EXPECT_LE(arrival->utime, after_utime);
}

TEST_F(Live, CountsWhatAFullQueueDrops) {
  LiveReceiver receiver(*receiving_, "COUNT", 10);
  Send(25);
  receiver.Drain();
  int received = 0;
  while (!receiver.drained()) received += receiver.Pop(milliseconds(100)) ? 1 : 0;
  // Popping has begun while messages were still arriving, so more than ten may have found room; none is unaccounted
  // for.
  EXPECT_EQ(received + receiver.dropped(), 25);
  EXPECT_GE(received, 10);
}

TEST_F(Live, DrainsWhatHasArrived) {
  LiveReceiver receiver(*receiving_, "COUNT", 1000);
  Send(50);
  receiver.Drain();
  int received = 0;
  while (!receiver.drained()) received += receiver.Pop(milliseconds(100)) ? 1 : 0;
  EXPECT_EQ(received, 50);
  EXPECT_FALSE(receiver.failed());
}

TEST(LiveBus, BadUrlsAreUsageErrors) {
  for (const char* url : {"udp://1.2.3.4:7", "udpm://1.2.3.4:7667", "udpm://239.255.76.67:99999", "nonsense",
                          "udpm://239.255.76.67:7667?ttl"}) {
    try {
      LiveBus bus(url);
      ADD_FAILURE() << url;
    } catch (const CommandError& error) {
      EXPECT_EQ(error.code(), ExitCode::kUsage) << url;
      EXPECT_THAT(error.what(), testing::HasSubstr(url));
    }
  }
}

TEST(LiveBus, AbsentTcpServerIsARuntimeError) {
  try {
    LiveBus bus("tcpq://127.0.0.1:1");
    ADD_FAILURE();
  } catch (const CommandError& error) {
    EXPECT_EQ(error.code(), ExitCode::kRuntime);
  }
}

}  // namespace
}  // namespace lcmslam

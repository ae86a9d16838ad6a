#include "bus/service.h"

#include <gtest/gtest.h>
#include <lcmslam/service_status_t.hpp>

#include "bus/log_writer.h"
#include "support/temporary_file.h"

namespace lcmslam {
namespace {

// Answers every message on IN with the same bytes on OUT; refuses empty ones.
class Echo : public Service {
 public:
  explicit Echo(ServiceContext& context) : context_(context) {
    context.Subscribe("IN", [this](const Event& event) {
      if (event.data.empty()) return Handled::kRefused;
      context_.Publish("OUT", Bytes(event.data));
      return Handled::kAccepted;
    });
  }
  void Finish() override { context_.Publish("DONE", Bytes()); }

 private:
  ServiceContext& context_;
};

class LogToLog : public testing::Test {
 protected:
  void SetUp() override {
    LogWriter writer(folder_.path() / "in.lcm");
    for (int i = 0; i < 25; ++i) {
      writer.Write(1000 + i * 100'000, "IN", Bytes(std::vector<uint8_t>{static_cast<uint8_t>(i)}));
      writer.Write(1000 + i * 100'000, "OTHER", Bytes());
    }
    writer.Write(2'500'000, "IN", Bytes());
  }

  std::vector<Event> Run(const std::string& out) {
    RunOptions options;
    options.log_in = folder_.path() / "in.lcm";
    options.log_out = folder_.path() / out;
    options.quiet = true;
    ServiceContext context("echo", options);
    EXPECT_EQ(RunLogToLog(context, [](ServiceContext& c) { return std::make_unique<Echo>(c); }), ExitCode::kOk);
    std::vector<Event> events;
    LogReader reader(options.log_out);
    for (Event event; reader.Next(event);) events.push_back(event);
    return events;
  }

  TemporaryFolder folder_;
};

TEST_F(LogToLog, KeepsTheInputAndAddsWhatItCaused) {
  const std::vector<Event> events = Run("out.lcm");
  size_t in = 0, out = 0, other = 0;
  for (size_t i = 0; i < events.size(); ++i) {
    in += events[i].channel == "IN";
    other += events[i].channel == "OTHER";
    if (events[i].channel != "OUT") continue;
    ++out;
    EXPECT_EQ(events[i - 1].channel, "IN");
    EXPECT_EQ(events[i].utime, events[i - 1].utime);
    EXPECT_EQ(events[i].data, events[i - 1].data);
  }
  EXPECT_EQ(in, 26U);
  EXPECT_EQ(other, 25U);
  EXPECT_EQ(out, 25U);
  EXPECT_EQ(events[events.size() - 2].channel, "DONE");
}

TEST_F(LogToLog, StatusOnceASecondOfLogTime) {
  std::vector<service_status_t> statuses;
  for (const Event& event : Run("out.lcm")) {
    if (event.channel != "ECHO_STATUS") continue;
    const auto status = Decode<service_status_t>(event.data);
    ASSERT_TRUE(status);
    statuses.push_back(*status);
  }
  ASSERT_EQ(statuses.size(), 3U) << "after 1 s, 2 s and at the end";
  EXPECT_EQ(statuses[0].received, 10);
  EXPECT_EQ(statuses[2].received, 26);
  EXPECT_EQ(statuses[2].processed, 25);
  EXPECT_EQ(statuses[2].refused, 1);
}

TEST_F(LogToLog, SameBytesEveryTime) {
  const auto a = Run("a.lcm"), b = Run("b.lcm");
  ASSERT_EQ(a.size(), b.size());
  for (size_t i = 0; i < a.size(); ++i) EXPECT_EQ(a[i].data, b[i].data) << a[i].channel;
}

}  // namespace
}  // namespace lcmslam

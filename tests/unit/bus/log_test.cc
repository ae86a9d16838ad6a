#include <filesystem>
#include <fstream>
#include <random>

#include <gtest/gtest.h>
#include <lcm/lcm-cpp.hpp>

#include "bus/errors.h"
#include "bus/log_reader.h"
#include "bus/log_writer.h"
#include "support/temporary_file.h"

namespace lcmslam {
namespace {

class Log : public testing::Test {
 protected:
  // 100 events of growing size; utime 10, 20, ...
  void SetUp() override {
    LogWriter writer(path_);
    for (int i = 1; i <= 100; ++i)
      writer.Write(10 * i, "CHANNEL_" + std::to_string(i % 3),
                   Bytes(std::vector<uint8_t>(static_cast<size_t>(i), static_cast<uint8_t>(i))));
  }

  std::vector<Event> ReadAll(LogReader& reader) {
    std::vector<Event> events;
    for (Event event; reader.Next(event);) events.push_back(event);
    return events;
  }

  const TemporaryFile file_;
  const std::string path_ = file_.path();
};

TEST_F(Log, IsWhatLiblcmReads) {
  lcm::LogFile file(path_, "r");
  ASSERT_TRUE(file.good());
  for (int i = 1; i <= 100; ++i) {
    const lcm::LogEvent* event = file.readNextEvent();
    ASSERT_NE(event, nullptr);
    EXPECT_EQ(event->timestamp, 10 * i);
    EXPECT_EQ(event->eventnum, i - 1);
    EXPECT_EQ(event->channel, "CHANNEL_" + std::to_string(i % 3));
    ASSERT_EQ(event->datalen, i);
    EXPECT_EQ(static_cast<const uint8_t*>(event->data)[i - 1], i);
  }
  EXPECT_EQ(file.readNextEvent(), nullptr);
}

TEST_F(Log, ReadsBackWhole) {
  LogReader reader(path_);
  const auto events = ReadAll(reader);
  ASSERT_EQ(events.size(), 100U);
  EXPECT_EQ(events[41].utime, 420);
  EXPECT_EQ(events[41].channel, "CHANNEL_0");
  EXPECT_EQ(events[41].data, std::vector<uint8_t>(42, 42));
  EXPECT_EQ(reader.DamageReport(), "");
}

TEST_F(Log, CutTailLosesOneEvent) {
  std::filesystem::resize_file(path_, std::filesystem::file_size(path_) - 7);
  LogReader reader(path_);
  EXPECT_EQ(ReadAll(reader).size(), 99U);
  EXPECT_EQ(reader.damaged_bytes(), 0U);
  EXPECT_EQ(reader.cut_bytes(), 28U + 9U + 100U - 7U);
}

TEST_F(Log, DamageInTheMiddleLosesOnlyWhatItStruck) {
  const auto size = std::filesystem::file_size(path_);
  std::fstream file(path_, std::ios::in | std::ios::out | std::ios::binary);
  file.seekp(static_cast<std::streamoff>(size / 2));
  file << std::string(200, '\x5a');
  file.close();
  LogReader reader(path_);
  const size_t survivors = ReadAll(reader).size();
  EXPECT_GE(survivors, 95U);
  EXPECT_LT(survivors, 100U);
  EXPECT_GT(reader.damaged_bytes(), 0U);
  EXPECT_EQ(reader.cut_bytes(), 0U);
}

TEST_F(Log, NoFileAndNoLogAreBadInput) {
  const auto code = [](const std::string& path) {
    try {
      LogReader reader(path);
      Event event;
      reader.Next(event);
    } catch (const CommandError& error) {
      return error.code();
    }
    return ExitCode::kOk;
  };
  EXPECT_EQ(code(path_ + ".absent"), ExitCode::kBadInput);
  std::ofstream(path_) << "this is not a log";
  EXPECT_EQ(code(path_), ExitCode::kBadInput);
  std::ofstream(path_, std::ios::trunc).close();
  EXPECT_EQ(code(path_), ExitCode::kBadInput);
}

TEST_F(Log, SurvivesMutation) {
  std::ifstream in(path_, std::ios::binary);
  const std::string whole((std::istreambuf_iterator<char>(in)), {});
  std::mt19937_64 random(7);
  for (int i = 0; i < 300; ++i) {
    std::string mutated = whole;
    for (int k = 0; k < 20; ++k) mutated[random() % mutated.size()] = static_cast<char>(random());
    std::ofstream(path_, std::ios::binary) << mutated;
    LogReader reader(path_);
    EXPECT_GT(ReadAll(reader).size(), 50U);
  }
}

}  // namespace
}  // namespace lcmslam

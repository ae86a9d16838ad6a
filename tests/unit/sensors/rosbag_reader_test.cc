#include "sensors/rosbag_reader.h"

#include <random>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sensors/bad_input.h"
#include "support/rosbag_builder.h"
#include "support/temporary_file.h"

namespace lcmslam {
namespace {

using testing::HasSubstr;

// Three chunks of messages "0", "1", ... alternating between two topics.
std::string Bag(const std::string& compression, int messages = 30) {
  RosbagBuilder builder(compression);
  for (int i = 0; i < messages; ++i) {
    const std::string topic = i % 2 == 0 ? "/even" : "/odd";
    builder.Message(topic, "std_msgs" + topic, 1'000'000 + i, std::to_string(i));
    if (i % 10 == 9) builder.EndChunk();
  }
  return builder.Bytes();
}

// The messages read before the end, or before `error` came.
std::vector<std::string> Read(const std::string& bytes, std::string* error = nullptr) {
  const TemporaryFile file(bytes, ".bag");
  std::vector<std::string> messages;
  try {
    for (RosbagReader reader(file.path()); const auto message = reader.Next();)
      messages.emplace_back(message->data.begin(), message->data.end());
  } catch (const BadInput& bad) {
    if (error == nullptr) throw;
    *error = bad.what();
  }
  return messages;
}

TEST(RosbagReader, ReadsEveryCompression) {
  for (const char* compression : {"none", "bz2", "lz4"}) {
    SCOPED_TRACE(compression);
    const TemporaryFile file(Bag(compression));
    RosbagReader reader(file.path());
    for (int i = 0; i < 30; ++i) {
      const auto message = reader.Next();
      ASSERT_TRUE(message);
      EXPECT_EQ(message->connection->topic, i % 2 == 0 ? "/even" : "/odd");
      EXPECT_EQ(message->connection->type, "std_msgs" + message->connection->topic);
      EXPECT_EQ(message->received_utime, 1'000'000 + i);
      EXPECT_EQ(std::string(message->data.begin(), message->data.end()), std::to_string(i));
    }
    EXPECT_FALSE(reader.Next());
    EXPECT_FALSE(reader.Next());
  }
}

TEST(RosbagReader, EmptyBagHasNoMessages) { EXPECT_TRUE(Read(Bag("none", 0)).empty()); }

TEST(RosbagReader, CutBagGivesWhatIsWhole) {
  for (const char* compression : {"none", "bz2", "lz4"}) {
    const std::string bytes = Bag(compression);
    std::string error;
    EXPECT_EQ(Read(bytes.substr(0, bytes.size() - 200), &error).size(), 20U);
    EXPECT_THAT(error, HasSubstr("the file ends inside this record"));
    EXPECT_THAT(error, HasSubstr(".bag: offset "));
  }
}

TEST(RosbagReader, OtherFilesAreRefused) {
  std::string error;
  for (const std::string& bytes : {std::string(), std::string("#ROSBAG V1.2\n"), std::string(1000, '\xff')}) {
    Read(bytes, &error);
    EXPECT_THAT(error, HasSubstr("not a ROS bag of format 2.0"));
  }
  Read(Bag("zip"), &error);
  EXPECT_THAT(error, HasSubstr("unknown compression 'zip'"));
  EXPECT_THROW(RosbagReader("/no/such.bag"), BadInput);
}

TEST(RosbagReader, DamagedCompressionIsSaid) {
  for (const char* compression : {"bz2", "lz4"}) {
    SCOPED_TRACE(compression);
    const std::string good = Bag(compression);
    const size_t size_field = good.find("size=") + 5;
    for (const char change : {'\x01', '\x7f'}) {  // the announced size is wrong
      std::string bytes = good;
      bytes[size_field + 1] = static_cast<char>(bytes[size_field + 1] + change);
      std::string error;
      EXPECT_TRUE(Read(bytes, &error).empty());
      EXPECT_THAT(error, HasSubstr("shorter than it says"));
    }
  }
}

TEST(RosbagReader, SurvivesMutation) {
  std::mt19937 random(1);
  int refused = 0;
  for (const char* compression : {"none", "bz2", "lz4"}) {
    const std::string good = Bag(compression);
    for (int i = 0; i < 2000; ++i) {
      std::string bytes = good;
      for (int k = random() % 4; k >= 0; --k) {
        const size_t at = random() % (bytes.size() - 4);
        if (random() % 3 == 0) {
          bytes.replace(at, 4, random() % 2 == 0 ? "\xff\xff\xff\x7f" : "\xff\xff\xff\xff");
        } else {
          bytes[at] = static_cast<char>(random());
        }
      }
      std::string error;
      Read(bytes, &error);
      if (!error.empty()) ++refused;
    }
  }
  EXPECT_GT(refused, 3000);
}

}  // namespace
}  // namespace lcmslam

#include "common/config.h"

#include <cmath>

#include <gmock/gmock.h>
#include <google/protobuf/duration.pb.h>
#include <google/protobuf/type.pb.h>

#include "bus/errors.h"
#include "support/temporary_file.h"

namespace lcmslam {
namespace {

using google::protobuf::Field;
using testing::HasSubstr;

// The line of the CommandError that `body` throws; "" when it throws none.
template <class Body>
std::string ErrorOf(Body body) {
  try {
    body();
  } catch (const CommandError& error) {
    EXPECT_EQ(error.code(), ExitCode::kUsage);
    EXPECT_THAT(error.what(), testing::Not(HasSubstr("\n")));
    return error.what();
  }
  return "";
}

std::string LoadError(const std::string& text) {
  const TemporaryFile file(text, ".pbtxt");
  Field config;
  return ErrorOf([&] { LoadConfig(file.path(), config); });
}

TEST(Config, RefusesWhatItDoesNotKnow) {
  EXPECT_EQ(LoadError("number: 3 name: 'x'"), "");
  EXPECT_THAT(LoadError("number: 3\nnmae: 'x'"), HasSubstr(":2:"));
  EXPECT_THAT(LoadError("number: 3\nnmae: 'x'"), HasSubstr("nmae"));
  EXPECT_THAT(LoadError("number: 3 number: 4"), HasSubstr("number"));
  EXPECT_THAT(LoadError("number: many"), HasSubstr("many"));
  EXPECT_THAT(LoadError("number: {"), HasSubstr(":1:"));
  EXPECT_THAT(ErrorOf([] {
                Field config;
                LoadConfig("/no/such/file.pbtxt", config);
              }),
              HasSubstr("/no/such/file.pbtxt"));
}

TEST(Config, SetsOneField) {
  google::protobuf::Type config;
  SetConfigField("source_context.file_name=a b", config);
  SetConfigField("name=n=1", config);
  EXPECT_EQ(config.source_context().file_name(), "a b");
  EXPECT_EQ(config.name(), "n=1");
  EXPECT_THAT(ErrorOf([&] { SetConfigField("name", config); }), HasSubstr("path=value"));
  EXPECT_THAT(ErrorOf([&] { SetConfigField("nmae=1", config); }), HasSubstr("nmae"));
  EXPECT_THAT(ErrorOf([&] { SetConfigField("name.x=1", config); }), HasSubstr("name"));
  EXPECT_THAT(ErrorOf([&] { SetConfigField("=1", config); }), HasSubstr("=1"));
  google::protobuf::Duration duration;
  SetConfigField("seconds=-7", duration);
  EXPECT_EQ(duration.seconds(), -7);
  EXPECT_THAT(ErrorOf([&] { SetConfigField("seconds=soon", duration); }), HasSubstr("seconds=soon"));
}

TEST(ConfigBinder, FileWinsThenOptionFillsIn) {
  google::protobuf::Duration config;
  config.set_seconds(5);
  int64_t seconds = 1;
  ConfigBinder binder(config);
  binder("seconds", seconds);
  EXPECT_EQ(seconds, 5);

  google::protobuf::Duration unset;
  int64_t fallback = 8;
  ConfigBinder unset_binder(unset);
  unset_binder("seconds", fallback);
  EXPECT_EQ(fallback, 8);
  EXPECT_EQ(unset.seconds(), 8);
  uint8_t narrow = 0;
  unset.set_seconds(300);
  EXPECT_THAT(ErrorOf([&] { unset_binder("seconds", narrow); }), HasSubstr("seconds: 300"));
  EXPECT_THROW(unset_binder("no_such_field", narrow), std::logic_error);
}

TEST(Config, HashTellsTextsApart) {
  EXPECT_EQ(ConfigHash("a"), ConfigHash("a"));
  EXPECT_NE(ConfigHash("a"), ConfigHash("b"));
}

}  // namespace
}  // namespace lcmslam

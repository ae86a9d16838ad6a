#pragma once

#include <algorithm>
#include <concepts>
#include <cstdint>
#include <limits>
#include <string>
#include <type_traits>

namespace google::protobuf {
class FieldDescriptor;
class Message;
}  // namespace google::protobuf

namespace lcmslam {

// Configurations are Protocol Buffers text; numbers in them are int64 or double, fields optional. All functions throw
// CommandError (kUsage) with one line that names file or argument, and the field.

// Adds the file's fields to `config`. Unknown fields and duplicates are errors.
void LoadConfig(const std::string& path, google::protobuf::Message& config);
// "map.cell_m=0.05" sets one field, replacing what the file said.
void SetConfigField(const std::string& assignment, google::protobuf::Message& config);
// The message as the text LoadConfig reads.
std::string ConfigText(const google::protobuf::Message& config);
// FNV-1a of the text; stays within int64.
int64_t ConfigHash(const std::string& text);

// Ties fields of a message to the options of an algorithm: a field that is set goes into the option; then the option
// goes into the field, so that the message ends as the effective configuration and the default stands only in the
// options.
//   binder("cell_m", options.cell_m)("band_m", options.band_m);
//   BindMap(binder.Sub("map"), options.map);
// Non-finite numbers are refused. A name that the message does not have is a defect of the service and throws
// logic_error.
class ConfigBinder {
 public:
  explicit ConfigBinder(google::protobuf::Message& config, std::string path = "");

  ConfigBinder& operator()(const char* field, double& option);
  ConfigBinder& operator()(const char* field, bool& option);
  ConfigBinder& operator()(const char* field, std::string& option);
  template <std::integral I>
  requires(!std::same_as<I, bool>) ConfigBinder& operator()(const char* field, I& option) {
    int64_t wide = static_cast<int64_t>(option);
    BindInteger(field, wide, static_cast<int64_t>(std::numeric_limits<I>::min()),
                static_cast<int64_t>(std::min<uint64_t>(std::numeric_limits<I>::max(), INT64_MAX)));
    option = static_cast<I>(wide);
    return *this;
  }
  // Enumerators of the message's enum have the numbers of the option's.
  template <class E>
  requires std::is_enum_v<E> ConfigBinder& operator()(const char* field, E& option) {
    int number = static_cast<int>(option);
    BindEnum(field, number);
    option = static_cast<E>(number);
    return *this;
  }

  ConfigBinder Sub(const char* field);
  // Whether the configuration says something of it.
  bool Has(const char* field) const;

 private:
  const google::protobuf::FieldDescriptor* Field(const char* name) const;
  void BindInteger(const char* field, int64_t& option, int64_t min, int64_t max);
  void BindEnum(const char* field, int& option);

  google::protobuf::Message& config_;
  std::string path_;
};

// For an Options::Validate(): throws CommandError (kUsage) unless `reason` is "".
void RequireValid(const std::string& reason);

}  // namespace lcmslam

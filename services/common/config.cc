#include "common/config.h"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <memory>
#include <sstream>
#include <stdexcept>

#include <fmt/format.h>
#include <google/protobuf/descriptor.h>
#include <google/protobuf/io/tokenizer.h>
#include <google/protobuf/io/zero_copy_stream_impl_lite.h>
#include <google/protobuf/message.h>
#include <google/protobuf/text_format.h>

#include "bus/errors.h"

namespace lcmslam {
namespace {

namespace pb = google::protobuf;

[[noreturn]] void Fail(const std::string& line) { throw CommandError(ExitCode::kUsage, line); }

// Keeps the first error of a parse.
class FirstError : public pb::io::ErrorCollector {
 public:
  void AddError(int line, pb::io::ColumnNumber column, const std::string& message) override {
    if (text_.empty()) text_ = line < 0 ? message : fmt::format("{}:{}: {}", line + 1, column + 1, message);
  }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

}  // namespace

void LoadConfig(const std::string& path, pb::Message& config) {
  std::ifstream file(path);
  std::stringstream text;
  text << file.rdbuf();
  if (!file || std::filesystem::is_directory(path)) Fail(fmt::format("{}: cannot be read", path));
  FirstError error;
  pb::TextFormat::Parser parser;
  parser.RecordErrorsTo(&error);
  const std::unique_ptr<pb::Message> parsed(config.New());  // merging text directly would accept duplicates
  if (!parser.ParseFromString(text.str(), parsed.get())) Fail(fmt::format("{}:{}", path, error.text()));
  config.MergeFrom(*parsed);
}

void SetConfigField(const std::string& assignment, pb::Message& config) {
  const size_t equals = assignment.find('=');
  if (equals == std::string::npos) Fail(fmt::format("--set {}: not of the form path=value", assignment));
  pb::Message* message = &config;
  std::istringstream path(assignment.substr(0, equals));
  const pb::FieldDescriptor* field = nullptr;
  for (std::string name; std::getline(path, name, '.');) {
    if (field != nullptr) {
      if (field->cpp_type() != pb::FieldDescriptor::CPPTYPE_MESSAGE)
        Fail(fmt::format("--set {}: {} has no fields", assignment, field->name()));
      message = message->GetReflection()->MutableMessage(message, field);
    }
    field = message->GetDescriptor()->FindFieldByName(name);
    if (field == nullptr) Fail(fmt::format("--set {}: no field '{}'", assignment, name));
  }
  if (field == nullptr || field->is_repeated()) Fail(fmt::format("--set {}: not a single field", assignment));

  std::string value = assignment.substr(equals + 1);
  const bool is_text = field->cpp_type() == pb::FieldDescriptor::CPPTYPE_STRING;
  if (is_text) {
    message->GetReflection()->SetString(message, field, value);
    return;
  }
  FirstError error;
  pb::TextFormat::Parser parser;
  parser.RecordErrorsTo(&error);
  message->GetReflection()->ClearField(message, field);
  if (!parser.ParseFieldValueFromString(value, field, message))
    Fail(fmt::format("--set {}: {}", assignment, error.text()));
}

std::string ConfigText(const pb::Message& config) {
  std::string text;
  pb::TextFormat::PrintToString(config, &text);
  return text;
}

int64_t ConfigHash(const std::string& text) {
  uint64_t hash = 0xcbf29ce484222325;
  for (const unsigned char c : text) hash = (hash ^ c) * 0x100000001b3;
  return static_cast<int64_t>(hash);
}

ConfigBinder::ConfigBinder(pb::Message& config, std::string path) : config_(config), path_(std::move(path)) {}

const pb::FieldDescriptor* ConfigBinder::Field(const char* name) const {
  const pb::FieldDescriptor* field = config_.GetDescriptor()->FindFieldByName(name);
  if (field == nullptr) throw std::logic_error(fmt::format("{} has no field {}", config_.GetTypeName(), name));
  return field;
}

ConfigBinder& ConfigBinder::operator()(const char* name, double& option) {
  const auto* field = Field(name);
  const auto* reflection = config_.GetReflection();
  if (reflection->HasField(config_, field)) option = reflection->GetDouble(config_, field);
  if (!std::isfinite(option)) Fail(fmt::format("{}{}: not a finite number", path_, name));
  reflection->SetDouble(&config_, field, option);
  return *this;
}

ConfigBinder& ConfigBinder::operator()(const char* name, bool& option) {
  const auto* field = Field(name);
  const auto* reflection = config_.GetReflection();
  if (reflection->HasField(config_, field)) option = reflection->GetBool(config_, field);
  reflection->SetBool(&config_, field, option);
  return *this;
}

ConfigBinder& ConfigBinder::operator()(const char* name, std::string& option) {
  const auto* field = Field(name);
  const auto* reflection = config_.GetReflection();
  if (reflection->HasField(config_, field)) option = reflection->GetString(config_, field);
  reflection->SetString(&config_, field, option);
  return *this;
}

void ConfigBinder::BindInteger(const char* name, int64_t& option, int64_t min, int64_t max) {
  const auto* field = Field(name);
  const auto* reflection = config_.GetReflection();
  if (reflection->HasField(config_, field)) option = reflection->GetInt64(config_, field);
  if (option < min || option > max) Fail(fmt::format("{}{}: {} is not in {}..{}", path_, name, option, min, max));
  reflection->SetInt64(&config_, field, option);
}

void ConfigBinder::BindEnum(const char* name, int& option) {
  const auto* field = Field(name);
  const auto* reflection = config_.GetReflection();
  if (reflection->HasField(config_, field)) option = reflection->GetEnumValue(config_, field);
  reflection->SetEnumValue(&config_, field, option);
}

ConfigBinder ConfigBinder::Sub(const char* name) {
  pb::Message* message = config_.GetReflection()->MutableMessage(&config_, Field(name));
  return ConfigBinder(*message, path_ + name + ".");
}

bool ConfigBinder::Has(const char* name) const { return config_.GetReflection()->HasField(config_, Field(name)); }

void RequireValid(const std::string& reason) {
  if (!reason.empty()) Fail(reason);
}

}  // namespace lcmslam

#include "sensors/rosbag_reader.h"

#include <algorithm>

#include <fmt/format.h>

#include "sensors/bad_input.h"
#include "sensors/unpack.h"

namespace lcmslam {
namespace {

constexpr std::string_view kVersionLine = "#ROSBAG V2.0\n";
constexpr uint32_t kMaxChunkBytes = uint32_t{1} << 30;

// Of a record's field "op".
enum Op : uint8_t {
  kMessage = 0x02,
  kBagHeader = 0x03,
  kIndex = 0x04,
  kChunk = 0x05,
  kChunkInfo = 0x06,
  kConnection = 0x07
};

std::span<const uint8_t> Field(const RosbagFields& fields, std::string_view name) {
  const auto field = fields.find(name);
  if (field == fields.end()) throw BadInput(fmt::format("record without field '{}'", name));
  return field->second;
}

template <class Number>
Number NumberField(const RosbagFields& fields, std::string_view name) {
  const auto value = Field(fields, name);
  if (value.size() != sizeof(Number)) throw BadInput(fmt::format("field '{}' has {} bytes", name, value.size()));
  return ByteReader(value).Get<Number>();
}

std::string TextField(const RosbagFields& fields, std::string_view name) {
  const auto value = Field(fields, name);
  return {value.begin(), value.end()};
}

RosbagFields ParseFields(std::span<const uint8_t> header) {
  RosbagFields fields;
  for (ByteReader reader(header); !reader.empty();) {
    const auto field = reader.GetSized();
    const auto equals = std::ranges::find(field, uint8_t{'='});
    if (equals == field.end()) throw BadInput("record header field without '='");
    const auto name_bytes = static_cast<size_t>(equals - field.begin());
    fields[std::string(field.begin(), equals)] = field.subspan(name_bytes + 1);
  }
  return fields;
}

std::vector<uint8_t> UnpackChunk(const RosbagFields& fields, std::vector<uint8_t> data) {
  const std::string compression = TextField(fields, "compression");
  if (compression == "none") return data;
  const auto size = NumberField<uint32_t>(fields, "size");
  if (size > kMaxChunkBytes) throw BadInput(fmt::format("chunk of {} bytes", size));
  if (compression == "bz2") return UnpackBzip2(data, size);
  if (compression == "lz4") return UnpackLz4(data, size);
  throw BadInput(fmt::format("unknown compression '{}'", compression));
}

}  // namespace

RosbagReader::RosbagReader(const std::filesystem::path& path) : path_(path), file_(path, std::ios::binary) {
  std::error_code error;
  size_bytes_ = remaining_bytes_ = std::filesystem::file_size(path, error);
  if (error || !file_) throw BadInput(fmt::format("{}: cannot be read", path.string()));
  ReadVersion();
}

std::optional<RosbagMessage> RosbagReader::Next() {
  try {
    do {
      if (auto message = NextInChunk()) return message;
    } while (EnterChunk());
    return {};
  } catch (const BadInput& error) {
    throw BadInput(fmt::format("{}: offset {}: {}", path_.string(), record_offset_, error.what()));
  }
}

void RosbagReader::ReadVersion() {
  std::string line(kVersionLine.size(), '\0');
  file_.read(line.data(), static_cast<std::streamsize>(line.size()));
  if (line != kVersionLine) throw BadInput(fmt::format("{}: not a ROS bag of format 2.0", path_.string()));
  remaining_bytes_ -= line.size();
}

std::vector<uint8_t> RosbagReader::ReadBytes(uint64_t count) {
  if (count > remaining_bytes_) throw BadInput("the file ends inside this record");
  std::vector<uint8_t> bytes(count);
  file_.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(count));
  if (!file_) throw BadInput("cannot be read");
  remaining_bytes_ -= count;
  return bytes;
}

std::optional<uint32_t> RosbagReader::ReadRecordHeader(RosbagFields& fields) {
  record_offset_ = size_bytes_ - remaining_bytes_;
  if (remaining_bytes_ == 0) return {};
  const auto header_bytes = ByteReader(ReadBytes(4)).Get<uint32_t>();
  header_ = ReadBytes(header_bytes);
  fields = ParseFields(header_);
  return ByteReader(ReadBytes(4)).Get<uint32_t>();
}

bool RosbagReader::EnterChunk() {
  RosbagFields fields;
  while (const auto data_bytes = ReadRecordHeader(fields)) {
    const auto op = NumberField<uint8_t>(fields, "op");
    std::vector<uint8_t> data = ReadBytes(*data_bytes);
    if (op == kConnection) AddConnection(fields, data);
    if (op == kBagHeader && fields.contains("encryptor") && !Field(fields, "encryptor").empty())
      throw BadInput("the bag is encrypted");
    if (op == kChunk) {
      chunk_ = UnpackChunk(fields, std::move(data));
      in_chunk_ = ByteReader(chunk_);
      return true;
    }
  }
  return false;
}

std::optional<RosbagMessage> RosbagReader::NextInChunk() {
  while (!in_chunk_.empty()) {
    const RosbagFields fields = ParseFields(in_chunk_.GetSized());
    const auto data = in_chunk_.GetSized();
    const auto op = NumberField<uint8_t>(fields, "op");
    if (op == kConnection) AddConnection(fields, data);
    if (op != kMessage) continue;
    const auto connection = connections_.find(NumberField<uint32_t>(fields, "conn"));
    if (connection == connections_.end()) throw BadInput("message of a connection that was not announced");
    ByteReader time(Field(fields, "time"));
    const int64_t seconds = time.Get<uint32_t>();
    const int64_t nanoseconds = time.Get<uint32_t>();
    return RosbagMessage{&connection->second, seconds * 1'000'000 + (nanoseconds + 500) / 1000, record_offset_, data};
  }
  return {};
}

void RosbagReader::AddConnection(const RosbagFields& fields, std::span<const uint8_t> data) {
  RosbagConnection connection{TextField(fields, "topic"), TextField(ParseFields(data), "type")};
  connections_.try_emplace(NumberField<uint32_t>(fields, "conn"), std::move(connection));
}

}  // namespace lcmslam

#include "sensors/pcd.h"

#include <algorithm>
#include <string>
#include <string_view>

#include <fmt/format.h>
#include <lzf.h>

#include "sensors/bad_input.h"
#include "sensors/byte_reader.h"
#include "sensors/number_type.h"
#include "sensors/text_lines.h"

namespace lcmslam {
namespace {

using Bytes = std::span<const uint8_t>;
using Words = std::vector<std::string_view>;

constexpr size_t kMaxFields = 1000;
constexpr size_t kMaxNumbersPerField = 100'000;
constexpr size_t kLzfMaxGrowth = 300;  // no packed byte makes more

struct Field {
  std::string name;
  NumberType type;
  size_t count = 1;  // numbers

  size_t bytes() const { return count * type.bytes; }
  bool is_column() const { return count == 1 && name != "_"; }  // "_": padding
};

struct Header {
  std::vector<Field> fields;
  size_t num_points = 0;
  std::string data;  // ascii, binary, binary_compressed

  size_t point_bytes() const {
    size_t sum = 0;
    for (const Field& field : fields) sum += field.bytes();
    return sum;
  }
};

NumberType::Kind KindOf(std::string_view letter) {
  if (letter == "I") return NumberType::Kind::kSigned;
  if (letter == "U") return NumberType::Kind::kUnsigned;
  if (letter == "F") return NumberType::Kind::kFloat;
  throw BadInput(fmt::format("unknown TYPE '{}'", letter));
}

void NeedOnePerField(const Words& words, const Header& header) {
  if (words.size() != header.fields.size() + 1) {
    throw BadInput(fmt::format("{} for {} fields has {} values", words[0], header.fields.size(), words.size() - 1));
  }
}

void TakeHeaderLine(const Words& words, Header& header) {
  const std::string_view key = words[0];
  if (key == "FIELDS") {
    if (words.size() > kMaxFields) throw BadInput("too many FIELDS");
    header.fields.clear();
    for (size_t i = 1; i < words.size(); ++i) header.fields.push_back({.name = std::string(words[i]), .type = {}});
  } else if (key == "SIZE" || key == "TYPE" || key == "COUNT") {
    NeedOnePerField(words, header);
    for (size_t i = 1; i < words.size(); ++i) {
      Field& field = header.fields[i - 1];
      if (key == "SIZE") field.type.bytes = ParseNumber<uint8_t>(words[i]);
      if (key == "TYPE") field.type.kind = KindOf(words[i]);
      if (key == "COUNT") field.count = ParseNumber<uint32_t>(words[i]);
      if (field.count > kMaxNumbersPerField) throw BadInput("COUNT beyond reason");
    }
  } else if (key == "POINTS" || key == "DATA") {
    if (words.size() != 2) throw BadInput(fmt::format("{} needs one value", key));
    if (key == "POINTS") header.num_points = ParseNumber<uint32_t>(words[1]);
    if (key == "DATA") header.data = words[1];
  }
}

// Leaves `lines` behind the line DATA.
Header ReadHeader(LineReader& lines) {
  Header header;
  std::string_view line;
  while (header.data.empty()) {
    if (!lines.Next(line)) throw BadInput("the header has no DATA");
    const Words words = SplitWords(line);
    if (words.empty() || words[0].starts_with('#')) continue;
    TakeHeaderLine(words, header);
  }
  if (header.point_bytes() == 0) throw BadInput("no FIELDS");
  for (const Field& field : header.fields) {
    if (!field.type.IsKnown())
      throw BadInput(fmt::format("field {}: no number has {} bytes", field.name, field.type.bytes));
  }
  return header;
}

PointTable ReadAscii(const Header& header, LineReader& lines) {
  if (header.num_points > lines.rest().size() / 2) throw BadInput("fewer points than the header says");
  PointTable table{.num_points = header.num_points, .columns = {}};
  std::vector<std::vector<double>*> columns;  // by field
  for (const Field& field : header.fields)
    columns.push_back(field.is_column() ? &table.AddColumn(field.name) : nullptr);
  std::string_view line;
  for (size_t i = 0; i < header.num_points; ++i) {
    if (!lines.Next(line)) throw BadInput("fewer points than the header says");
    const Words words = SplitWords(line);
    size_t at = 0;
    for (size_t f = 0; f < columns.size(); ++f) {
      if (at + header.fields[f].count > words.size()) throw BadInput("fewer values than FIELDS");
      if (columns[f] != nullptr) columns[f]->push_back(ParseNumber<double>(words[at]));
      at += header.fields[f].count;
    }
  }
  return table;
}

// Where field f of point i is: binary data goes point by point, compressed data field by field.
PointTable ReadBinary(const Header& header, Bytes data, bool by_field) {
  PointTable table{.num_points = header.num_points, .columns = {}};
  size_t field_at = 0;
  for (const Field& field : header.fields) {
    const size_t stride = by_field ? field.bytes() : header.point_bytes();
    if (field.is_column()) {
      std::vector<double>& column = table.AddColumn(field.name);
      column.reserve(header.num_points);
      for (size_t i = 0; i < header.num_points; ++i) {
        column.push_back(ReadNumber(data.subspan(field_at + i * stride, field.bytes()), field.type, false));
      }
    }
    field_at += by_field ? field.bytes() * header.num_points : field.bytes();
  }
  return table;
}

std::vector<uint8_t> Unpack(ByteReader reader, size_t bytes) {
  const auto packed_bytes = reader.Get<uint32_t>();
  if (reader.Get<uint32_t>() != bytes) throw BadInput("compressed points are not as many as the header says");
  const Bytes packed = reader.Take(packed_bytes);
  if (bytes / kLzfMaxGrowth > packed.size()) throw BadInput("compressed points are damaged");
  std::vector<uint8_t> unpacked(bytes);
  const unsigned got =
      bytes == 0 ? 0 : lzf_decompress(packed.data(), packed_bytes, unpacked.data(), static_cast<unsigned>(bytes));
  if (got != bytes) throw BadInput("compressed points are damaged");
  return unpacked;
}

PointTable ReadData(const Header& header, LineReader& lines) {
  if (header.data == "ascii") return ReadAscii(header, lines);
  const std::string_view rest = lines.rest();
  const Bytes data(reinterpret_cast<const uint8_t*>(rest.data()), rest.size());
  const size_t bytes = header.num_points * header.point_bytes();
  if (header.data == "binary") {
    if (bytes > data.size()) throw BadInput("fewer points than the header says");
    return ReadBinary(header, data, false);
  }
  if (header.data == "binary_compressed") return ReadBinary(header, Unpack(ByteReader(data), bytes), true);
  throw BadInput(fmt::format("unknown DATA '{}'", header.data));
}

}  // namespace

PointTable ParsePcd(std::span<const uint8_t> file) {
  LineReader lines({reinterpret_cast<const char*>(file.data()), file.size()});
  try {
    const Header header = ReadHeader(lines);
    return ReadData(header, lines);
  } catch (const BadInput& error) {
    throw BadInput(fmt::format("PCD line {}: {}", lines.number(), error.what()));
  }
}

}  // namespace lcmslam

#include "sensors/ply.h"

#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "sensors/bad_input.h"
#include "sensors/byte_reader.h"
#include "sensors/number_type.h"
#include "sensors/text_lines.h"

namespace lcmslam {
namespace {

using Words = std::vector<std::string_view>;

constexpr size_t kMaxProperties = 1000;

struct Property {
  std::string name;
  NumberType type;
  std::optional<NumberType> count_type;  // of a list
};

struct Element {
  std::string name;
  size_t count = 0;
  std::vector<Property> properties;
};

enum class Format { kAscii, kLittleEndian, kBigEndian };

struct Header {
  std::optional<Format> format;
  std::vector<Element> elements;
};

NumberType TypeNamed(std::string_view name) {
  using enum NumberType::Kind;
  if (name == "char" || name == "int8") return {kSigned, 1};
  if (name == "uchar" || name == "uint8") return {kUnsigned, 1};
  if (name == "short" || name == "int16") return {kSigned, 2};
  if (name == "ushort" || name == "uint16") return {kUnsigned, 2};
  if (name == "int" || name == "int32") return {kSigned, 4};
  if (name == "uint" || name == "uint32") return {kUnsigned, 4};
  if (name == "float" || name == "float32") return {kFloat, 4};
  if (name == "double" || name == "float64") return {kFloat, 8};
  throw BadInput(fmt::format("unknown type '{}'", name));
}

Format FormatNamed(std::string_view name) {
  if (name == "ascii") return Format::kAscii;
  if (name == "binary_little_endian") return Format::kLittleEndian;
  if (name == "binary_big_endian") return Format::kBigEndian;
  throw BadInput(fmt::format("unknown format '{}'", name));
}

void NeedWords(const Words& words, size_t count) {
  if (words.size() != count) throw BadInput(fmt::format("'{}' has {} values", words[0], words.size() - 1));
}

Property ReadProperty(const Words& words) {
  const bool is_list = words.size() > 1 && words[1] == "list";
  NeedWords(words, is_list ? 5 : 3);
  if (!is_list) return {std::string(words[2]), TypeNamed(words[1]), std::nullopt};
  const NumberType count_type = TypeNamed(words[2]);
  if (count_type.kind == NumberType::Kind::kFloat) throw BadInput("a list counted by a fraction");
  return {std::string(words[4]), TypeNamed(words[3]), count_type};
}

// Leaves `lines` behind the line end_header.
Header ReadHeader(LineReader& lines) {
  Header header;
  std::string_view line;
  if (!lines.Next(line) || SplitWords(line) != Words{"ply"}) throw BadInput("does not begin with 'ply'");
  while (true) {
    if (!lines.Next(line)) throw BadInput("the header has no end");
    const Words words = SplitWords(line);
    if (words.empty() || words[0] == "comment" || words[0] == "obj_info") continue;
    if (words[0] == "end_header") break;
    if (words[0] == "format") {
      NeedWords(words, 3);
      header.format = FormatNamed(words[1]);
    } else if (words[0] == "element") {
      NeedWords(words, 3);
      header.elements.push_back({std::string(words[1]), ParseNumber<uint32_t>(words[2]), {}});
    } else if (words[0] == "property") {
      if (header.elements.empty()) throw BadInput("a property of no element");
      if (header.elements.back().properties.size() == kMaxProperties) throw BadInput("too many properties");
      header.elements.back().properties.push_back(ReadProperty(words));
    } else {
      throw BadInput(fmt::format("unknown word '{}'", words[0]));
    }
  }
  if (!header.format) throw BadInput("no format");
  return header;
}

// The numbers of the file's body, one after the other.
class NumberSource {
 public:
  virtual ~NumberSource() = default;
  virtual double Next(const NumberType& type) = 0;
  virtual size_t BytesLeft() const = 0;
};

class AsciiSource : public NumberSource {
 public:
  explicit AsciiSource(std::string_view text) : lines_(text) {}
  double Next(const NumberType&) override {
    while (at_ == words_.size()) {
      std::string_view line;
      if (!lines_.Next(line)) throw BadInput("fewer numbers than the header says");
      words_ = SplitWords(line);
      at_ = 0;
    }
    return ParseNumber<double>(words_[at_++]);
  }
  size_t BytesLeft() const override { return lines_.rest().size() + 2 * words_.size(); }

 private:
  LineReader lines_;
  Words words_;
  size_t at_ = 0;
};

class BinarySource : public NumberSource {
 public:
  BinarySource(std::string_view bytes, bool big_endian)
      : reader_({reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size()}), big_endian_(big_endian) {}
  double Next(const NumberType& type) override { return ReadNumber(reader_.Take(type.bytes), type, big_endian_); }
  size_t BytesLeft() const override { return reader_.size(); }

 private:
  ByteReader reader_;
  bool big_endian_;
};

std::unique_ptr<NumberSource> Body(Format format, std::string_view rest) {
  if (format == Format::kAscii) return std::make_unique<AsciiSource>(rest);
  return std::make_unique<BinarySource>(rest, format == Format::kBigEndian);
}

void PassOverList(const Property& property, NumberSource& body) {
  const double count = body.Next(*property.count_type);
  if (!(count >= 0.0 && count <= static_cast<double>(body.BytesLeft()))) throw BadInput("a list beyond the end");
  for (double i = 0.0; i < count; ++i) (void)body.Next(property.type);
}

// Every number takes a byte or more, so that counts which cannot be true are seen before memory is taken.
PointTable ReadElement(const Element& element, NumberSource& body) {
  if (element.count > 0 && element.properties.empty()) throw BadInput("an element without properties");
  if (element.count > body.BytesLeft()) throw BadInput("fewer numbers than the header says");
  PointTable table{.num_points = element.count, .columns = {}};
  std::vector<std::vector<double>*> columns;  // by property
  for (const Property& property : element.properties) {
    columns.push_back(property.count_type ? nullptr : &table.AddColumn(property.name));
  }
  for (size_t i = 0; i < element.count; ++i) {
    for (size_t p = 0; p < columns.size(); ++p) {
      const Property& property = element.properties[p];
      if (columns[p] == nullptr) {
        PassOverList(property, body);
      } else {
        columns[p]->push_back(body.Next(property.type));
      }
    }
  }
  return table;
}

PointTable ReadVertices(const Header& header, NumberSource& body) {
  for (const Element& element : header.elements) {
    PointTable table = ReadElement(element, body);
    if (element.name == "vertex") return table;
  }
  throw BadInput("no element vertex");
}

}  // namespace

PointTable ParsePly(std::span<const uint8_t> file) {
  LineReader lines({reinterpret_cast<const char*>(file.data()), file.size()});
  try {
    const Header header = ReadHeader(lines);
    return ReadVertices(header, *Body(*header.format, lines.rest()));
  } catch (const BadInput& error) {
    throw BadInput(fmt::format("PLY line {}: {}", lines.number(), error.what()));
  }
}

}  // namespace lcmslam

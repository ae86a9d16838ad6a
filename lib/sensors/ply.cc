#include "sensors/ply.h"

#include <functional>
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
  explicit AsciiSource(LineReader& lines) : lines_(lines) {}
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
  LineReader& lines_;
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

// What the lines hold from here on.
std::unique_ptr<NumberSource> Body(Format format, LineReader& lines) {
  if (format == Format::kAscii) return std::make_unique<AsciiSource>(lines);
  return std::make_unique<BinarySource>(lines.rest(), format == Format::kBigEndian);
}

void ReadList(const Property& property, NumberSource& body, std::vector<double>& values) {
  const double count = body.Next(*property.count_type);
  if (!(count >= 0.0 && count <= static_cast<double>(body.BytesLeft()))) throw BadInput("a list beyond the end");
  values.clear();
  for (double i = 0.0; i < count; ++i) values.push_back(body.Next(property.type));
}

// Is given every list of an element.
using ListTaker = std::function<void(const std::string& property, std::span<const double> values)>;

void PassOver(const std::string& /*property*/, std::span<const double> /*values*/) {}

// Every number takes a byte or more, so that counts which cannot be true are seen before memory is taken.
PointTable ReadElement(const Element& element, NumberSource& body, const ListTaker& take_list = PassOver) {
  if (element.count > 0 && element.properties.empty()) throw BadInput("an element without properties");
  if (element.count > body.BytesLeft()) throw BadInput("fewer numbers than the header says");
  PointTable table{.num_points = element.count, .columns = {}};
  std::vector<std::vector<double>*> columns;  // by property
  for (const Property& property : element.properties) {
    columns.push_back(property.count_type ? nullptr : &table.AddColumn(property.name));
  }
  std::vector<double> list;
  for (size_t i = 0; i < element.count; ++i) {
    for (size_t p = 0; p < columns.size(); ++p) {
      const Property& property = element.properties[p];
      if (columns[p] == nullptr) {
        ReadList(property, body, list);
        take_list(property.name, list);
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

std::vector<Eigen::Vector3d> VerticesOf(const PointTable& table) {
  for (const char* name : {"x", "y", "z"}) {
    if (!table.columns.contains(name)) throw BadInput(fmt::format("no {}", name));
  }
  const auto &x = table.columns.at("x"), &y = table.columns.at("y"), &z = table.columns.at("z");
  std::vector<Eigen::Vector3d> vertices;
  for (size_t i = 0; i < table.num_points; ++i) {
    vertices.emplace_back(x[i], y[i], z[i]);
    if (!vertices.back().allFinite()) throw BadInput(fmt::format("vertex {} is not finite", i));
  }
  return vertices;
}

void AddFace(std::span<const double> corners, PlyMesh& mesh) {
  const auto vertex = [&mesh](double corner) {
    if (!(corner >= 0.0 && corner < static_cast<double>(mesh.vertices.size())))
      throw BadInput(fmt::format("a face with vertex {} of {}", corner, mesh.vertices.size()));
    return static_cast<uint32_t>(corner);
  };
  for (size_t i = 2; i < corners.size(); ++i)
    mesh.triangles.push_back({vertex(corners[0]), vertex(corners[i - 1]), vertex(corners[i])});
}

PlyMesh ReadMesh(const Header& header, NumberSource& body) {
  PlyMesh mesh;
  const auto take_list = [&mesh](const std::string& property, std::span<const double> values) {
    if (property == "vertex_indices" || property == "vertex_index") AddFace(values, mesh);
  };
  for (const Element& element : header.elements) {
    const PointTable table =
        element.name == "face" ? ReadElement(element, body, take_list) : ReadElement(element, body);
    if (element.name == "vertex") mesh.vertices = VerticesOf(table);
  }
  if (mesh.triangles.empty()) throw BadInput("no faces");
  return mesh;
}

template <class Read>
auto ParseWith(const Read& read, std::span<const uint8_t> file) {
  LineReader lines({reinterpret_cast<const char*>(file.data()), file.size()});
  try {
    const Header header = ReadHeader(lines);
    return read(header, *Body(*header.format, lines));
  } catch (const BadInput& error) {
    throw BadInput(fmt::format("PLY line {}: {}", lines.number(), error.what()));
  }
}

}  // namespace

PointTable ParsePly(std::span<const uint8_t> file) { return ParseWith(ReadVertices, file); }

PlyMesh ParsePlyMesh(std::span<const uint8_t> file) { return ParseWith(ReadMesh, file); }

}  // namespace lcmslam

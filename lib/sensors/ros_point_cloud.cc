#include "sensors/ros_point_cloud.h"

#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "sensors/arrange_points.h"
#include "sensors/byte_reader.h"
#include "sensors/number_type.h"
#include "sensors/ros_messages.h"

namespace lcmslam {
namespace {

constexpr uint32_t kMaxFields = 1000;
constexpr double kMaxClockError_us = 10e6;

struct Field {
  std::string name;
  uint32_t offset = 0;  // in a point's bytes
  NumberType type;
  uint32_t count = 1;
};

// sensor_msgs/PointField: INT8 = 1, UINT8, INT16, UINT16, INT32, UINT32, FLOAT32, FLOAT64 = 8.
NumberType TypeOf(uint8_t datatype) {
  using enum NumberType::Kind;
  if (datatype < 1 || datatype > 8) throw BadInput(fmt::format("field of unknown type {}", datatype));
  if (datatype >= 7) return {kFloat, datatype == 7 ? size_t{4} : size_t{8}};
  return {datatype % 2 == 1 ? kSigned : kUnsigned, size_t{1} << ((datatype - 1) / 2)};
}

std::vector<Field> GetFields(ByteReader& reader) {
  const auto count = reader.Get<uint32_t>();
  if (count > kMaxFields) throw BadInput(fmt::format("{} fields", count));
  std::vector<Field> fields(count);
  for (Field& field : fields) {
    field.name = reader.GetString();
    field.offset = reader.Get<uint32_t>();
    field.type = TypeOf(reader.Get<uint8_t>());
    field.count = reader.Get<uint32_t>();
  }
  return fields;
}

// Where the points lie in the data: rows of `width` points.
struct Layout {
  uint64_t height = 0, width = 0;
  uint64_t point_bytes = 0, row_bytes = 0;

  void RequireFits(size_t data_bytes) const {
    const bool fits = point_bytes > 0 && width <= data_bytes / point_bytes && width * point_bytes <= row_bytes &&
                      (row_bytes == 0 || height <= data_bytes / row_bytes);
    if (height > 0 && width > 0 && !fits) throw BadInput("fewer points than the message says");
  }
};

PointTable ReadTable(const std::vector<Field>& fields, const Layout& layout, bool big_endian,
                     std::span<const uint8_t> data) {
  PointTable table{.num_points = static_cast<size_t>(layout.height * layout.width), .columns = {}};
  for (const Field& field : fields) {
    if (field.count != 1) continue;
    if (table.num_points > 0 && field.offset + uint64_t{field.type.bytes} > layout.point_bytes)
      throw BadInput(fmt::format("field {} beyond the point", field.name));
    std::vector<double>& column = table.AddColumn(field.name);
    column.reserve(table.num_points);
    for (uint64_t row = 0; row < layout.height; ++row) {
      for (uint64_t i = 0; i < layout.width; ++i) {
        const size_t at = row * layout.row_bytes + i * layout.point_bytes + field.offset;
        column.push_back(ReadNumber(data.subspan(at, field.type.bytes), field.type, big_endian));
      }
    }
  }
  return table;
}

}  // namespace

RosPointCloud DecodeRosPointCloud(std::span<const uint8_t> data) {
  ByteReader reader(data);
  const RosHeader header = GetRosHeader(reader);
  Layout layout;
  layout.height = reader.Get<uint32_t>();
  layout.width = reader.Get<uint32_t>();
  const std::vector<Field> fields = GetFields(reader);
  const bool big_endian = reader.Get<uint8_t>() != 0;
  layout.point_bytes = reader.Get<uint32_t>();
  layout.row_bytes = reader.Get<uint32_t>();
  if (layout.height == 1) layout.row_bytes = layout.width * layout.point_bytes;  // not every driver fills it in
  const std::span<const uint8_t> points = reader.GetSized();
  reader.Get<uint8_t>();  // is_dense
  RequireEmpty(reader);
  layout.RequireFits(points.size());
  return {header.utime, header.frame, ReadTable(fields, layout, big_endian, points)};
}

Sweep ToSweep(const RosPointCloud& cloud) {
  Sweep sweep{.utime = cloud.utime, .points = ToSweepPoints(cloud.table)};
  if (const auto latest_us = LatestTime_us(cloud.table)) {
    const double from_header_us = *latest_us;
    const double from_1970_us = *latest_us - static_cast<double>(cloud.utime);
    if (std::abs(from_header_us) < kMaxClockError_us) {
      sweep.utime += std::llround(from_header_us);
    } else if (std::abs(from_1970_us) < kMaxClockError_us) {
      sweep.utime += std::llround(from_1970_us);
    }
  }
  DropNoReturns(sweep.points);
  SortByTime(sweep.points);
  return sweep;
}

}  // namespace lcmslam

#include "trajectory/read.h"

#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <span>
#include <string_view>
#include <variant>

#include <Eigen/LU>
#include <fmt/format.h>

#include "trajectory/text_lines.h"

namespace lcmslam {
namespace {

using Fields = std::span<const std::string_view>;

// Says which number of the line is wrong.
struct BadField {
  std::string reason;
};
template <typename T>
using Parsed = std::variant<T, BadField>;

template <size_t N>
std::optional<BadField> ParseNumbers(Fields fields, std::array<double, N>& numbers) {
  for (size_t i = 0; i < N; ++i) {
    const auto number = ParseFinite(fields[i]);
    if (!number) return BadField{fmt::format("not a finite number: {}", Quote(fields[i]))};
    numbers[i] = *number;
  }
  return std::nullopt;
}

Parsed<Pose3> PoseOf(const Eigen::Vector3d& translation, const Eigen::Quaterniond& rotation) {
  const double length = rotation.norm();
  if (std::abs(length - 1.0) > 0.05) return BadField{fmt::format("quaternion of length {:.3g}", length)};
  return Pose3{translation, rotation.normalized()};
}

Parsed<Pose3> ParseTumPose(Fields fields) {
  std::array<double, 7> v;
  if (auto bad = ParseNumbers(fields.subspan(1), v)) return *bad;
  return PoseOf({v[0], v[1], v[2]}, {v[6], v[3], v[4], v[5]});
}

Parsed<Pose3> ParseEurocPose(Fields fields) {
  std::array<double, 7> v;
  if (auto bad = ParseNumbers(fields.subspan(1), v)) return *bad;
  return PoseOf({v[0], v[1], v[2]}, {v[3], v[4], v[5], v[6]});
}

Parsed<Pose3> ParsePlanarPose(Fields fields) {
  std::array<double, 3> v;
  if (auto bad = ParseNumbers(fields.subspan(1), v)) return *bad;
  return ToPose3({v[0], v[1], v[2]});
}

Parsed<Pose3> ParseKittiPose(Fields fields) {
  std::array<double, 12> v;
  if (auto bad = ParseNumbers(fields, v)) return *bad;
  const Eigen::Map<const Eigen::Matrix<double, 3, 4, Eigen::RowMajor>> matrix(v.data());
  const Eigen::Matrix3d rotation = matrix.leftCols<3>();
  const double deviation = (rotation.transpose() * rotation - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
  if (deviation > 0.02 || rotation.determinant() < 0.0) return BadField{"the 3x3 part is not a rotation"};
  return Pose3{matrix.col(3), Eigen::Quaterniond(rotation).normalized()};
}

Parsed<int64_t> ParseSeconds(std::string_view field) {
  if (const auto us = ParseSecondsAsMicroseconds(field)) return *us;
  return BadField{fmt::format("not a stamp in seconds: {}", Quote(field))};
}

// Rounded to the microsecond, half up. Fractions of a nanosecond, as some exporters write, are dropped.
Parsed<int64_t> ParseNanoseconds(std::string_view field) {
  const std::string_view digits = field.substr(0, field.find('.'));
  int64_t ns = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), ns);
  if (error != std::errc() || end != digits.data() + digits.size() || ns < 0 || ns > INT64_MAX - 500) {
    return BadField{fmt::format("not a stamp in nanoseconds: {}", Quote(field))};
  }
  return (ns + 500) / 1000;
}

struct Format {
  std::string_view name;
  size_t columns;
  bool more_columns_allowed;
  std::string_view layout;
  Parsed<int64_t> (*parse_stamp)(std::string_view);
  Parsed<Pose3> (*parse_pose)(Fields);
};

constexpr Format kTum{"TUM", 8, false, "timestamp tx ty tz qx qy qz qw", ParseSeconds, ParseTumPose};
constexpr Format kPlanar{"planar", 4, false, "timestamp x y yaw", ParseSeconds, ParsePlanarPose};
constexpr Format kEuroc{"EuRoC", 8, true, "timestamp,px,py,pz,qw,qx,qy,qz", ParseNanoseconds, ParseEurocPose};
constexpr Format kKitti{"KITTI", 12, false, "a row-major 3x4 matrix", nullptr, ParseKittiPose};

const Format* Recognize(const TextLines& lines) {
  const size_t columns = lines.fields().size();
  if (lines.has_comma()) return columns >= kEuroc.columns ? &kEuroc : nullptr;
  for (const Format* format : {&kTum, &kPlanar, &kKitti}) {
    if (columns == format->columns) return format;
  }
  return nullptr;
}

const Format* FormatOf(TrajectoryFormat format, const TextLines& lines) {
  switch (format) {
    case TrajectoryFormat::kTum:
      return &kTum;
    case TrajectoryFormat::kPlanar:
      return &kPlanar;
    case TrajectoryFormat::kEuroc:
      return &kEuroc;
    case TrajectoryFormat::kKitti:
      return &kKitti;
    case TrajectoryFormat::kAuto:
      break;
  }
  return Recognize(lines);
}

// The stamps of KITTI poses, which stand in a file of their own or are counted up.
class KittiStamps {
 public:
  explicit KittiStamps(const ReadOptions& options) : period_us_(options.kitti_period_us) {
    if (!options.kitti_times.empty()) lines_.emplace(options.kitti_times);
  }
  Parsed<int64_t> Next() {
    if (!lines_) return period_us_ * count_++;
    if (!lines_->Next()) return BadField{lines_->error().empty() ? "no stamp left for this pose" : lines_->error()};
    auto stamp = ParseSeconds(lines_->fields()[0]);
    if (auto* bad = std::get_if<BadField>(&stamp)) return BadField{lines_->Complain(bad->reason)};
    return stamp;
  }
  // About the stamp that Next() gave: those of a file may be wrong, those counted up are not.
  std::string Complain(const std::string& reason) const { return lines_->Complain(reason); }

 private:
  std::optional<TextLines> lines_;
  int64_t period_us_;
  int64_t count_ = 0;
};

std::string WrongColumns(const Format& format, const TextLines& lines) {
  return lines.Complain(fmt::format("{} numbers expected ({}: {}), found {}", format.columns, format.name,
                                    format.layout, lines.fields().size()));
}

std::string ReadInto(Trajectory& trajectory, TextLines& lines, const ReadOptions& options) {
  const Format* format = nullptr;
  KittiStamps kitti_stamps(options);
  while (lines.Next()) {
    if (!format) format = FormatOf(options.format, lines);
    if (!format) return lines.Complain("not a TUM, planar, EuRoC or KITTI trajectory");
    const size_t columns = lines.fields().size();
    if (columns < format->columns || (columns > format->columns && !format->more_columns_allowed)) {
      return WrongColumns(*format, lines);
    }
    const auto stamp = format->parse_stamp ? format->parse_stamp(lines.fields()[0]) : kitti_stamps.Next();
    if (const auto* bad = std::get_if<BadField>(&stamp)) return lines.Complain(bad->reason);
    const int64_t utime = std::get<int64_t>(stamp);
    if (!trajectory.empty() && utime <= trajectory.back().utime) {
      const double step_s = static_cast<double>(utime - trajectory.back().utime) * 1e-6;
      const std::string reason = utime == trajectory.back().utime
                                     ? "stamp repeats that of the pose before"
                                     : fmt::format("stamp steps back by {:.6f} s", -step_s);
      return format->parse_stamp ? lines.Complain(reason) : kitti_stamps.Complain(reason);
    }
    const auto pose = format->parse_pose(lines.fields());
    if (const auto* bad = std::get_if<BadField>(&pose)) return lines.Complain(bad->reason);
    trajectory.push_back({utime, std::get<Pose3>(pose)});
  }
  return lines.error();
}

}  // namespace

TrajectoryFile ReadTrajectory(const std::filesystem::path& path, const ReadOptions& options) {
  TrajectoryFile file;
  TextLines lines(path);
  file.trajectory.reserve(lines.EstimateCount());
  file.error = ReadInto(file.trajectory, lines, options);
  if (file.error.empty() && file.trajectory.empty()) file.error = fmt::format("{}: no poses", path.string());
  if (!file.error.empty()) file.trajectory.clear();
  return file;
}

}  // namespace lcmslam

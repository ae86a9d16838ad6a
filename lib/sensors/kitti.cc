#include "sensors/kitti.h"

#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include <Eigen/SVD>
#include <boost/date_time/gregorian/gregorian_types.hpp>
#include <fmt/format.h>

#include "sensors/bad_input.h"
#include "sensors/byte_reader.h"
#include "sensors/text_lines.h"

namespace lcmslam {
namespace {

constexpr size_t kPointBytes = 4 * sizeof(float);
constexpr double kLatest_s = 9e12;  // fits int64 microseconds
constexpr double kRotationTolerance = 0.01;

using Words = std::span<const std::string_view>;

// Calls handle(words) for every line that is not empty; puts the line in front of its complaints.
template <class Handler>
void ForEachLine(std::string_view text, const Handler& handle) {
  LineReader lines(text);
  std::string_view line;
  try {
    while (lines.Next(line)) {
      const std::vector<std::string_view> words = SplitWords(line);
      if (!words.empty()) handle(Words(words));
    }
  } catch (const BadInput& error) {
    throw BadInput(fmt::format("line {}: {}", lines.number(), error.what()));
  }
}

// The numbers between separators: "13:02:25.9".
std::array<double, 3> ParseTriple(std::string_view word, char separator) {
  const size_t first = word.find(separator, 1), second = word.rfind(separator);
  if (first == std::string_view::npos || second <= first) throw BadInput(fmt::format("'{}' is no date or time", word));
  return {ParseNumber<double>(word.substr(0, first)), ParseNumber<double>(word.substr(first + 1, second - first - 1)),
          ParseNumber<double>(word.substr(second + 1))};
}

// Days since 1970 of "2011-09-26".
double ParseDate(std::string_view word) {
  using boost::gregorian::date;
  const auto [year, month, day] = ParseTriple(word, '-');
  const auto is_whole = [](double value, int min, int max) {
    return value >= min && value <= max && value == std::floor(value);
  };
  if (!is_whole(year, 1970, 9999) || !is_whole(month, 1, 12) || !is_whole(day, 1, 31)) throw BadInput("no date");
  const auto month_number = static_cast<unsigned short>(month), day_number = static_cast<unsigned short>(day);
  if (day_number >
      boost::gregorian::gregorian_calendar::end_of_month_day(static_cast<unsigned short>(year), month_number))
    throw BadInput("no date");
  return static_cast<double>(
      (date(static_cast<unsigned short>(year), month_number, day_number) - date(1970, 1, 1)).days());
}

// utime from either form of a line.
int64_t ParseTime(Words words) {
  double days = 0.0, seconds = 0.0;
  if (words.size() == 1) {
    seconds = ParseNumber<double>(words[0]);
  } else if (words.size() == 2) {
    const auto [hour, minute, second] = ParseTriple(words[1], ':');
    days = ParseDate(words[0]);
    seconds = 3600.0 * hour + 60.0 * minute + second;
  } else {
    throw BadInput("no time");
  }
  if (!(std::abs(seconds) < kLatest_s)) throw BadInput("no time");
  return std::llround(days) * 86'400'000'000 + std::llround(1e6 * seconds);
}

Pose3 ParsePose(Words words) {
  if (words.size() != 12) throw BadInput(fmt::format("{} numbers where a pose has 12", words.size()));
  Eigen::Matrix<double, 3, 4> T;
  for (int i = 0; i < 12; ++i) T(i / 4, i % 4) = ParseNumber<double>(words[static_cast<size_t>(i)]);
  const Eigen::Matrix3d R = T.leftCols<3>();
  const bool is_rotation = (R * R.transpose() - Eigen::Matrix3d::Identity()).norm() < kRotationTolerance &&
                           R.determinant() > 0.0 && T.col(3).allFinite();
  if (!is_rotation) throw BadInput("no pose");
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(R, Eigen::ComputeFullU | Eigen::ComputeFullV);
  return {T.col(3), Eigen::Quaterniond(svd.matrixU() * svd.matrixV().transpose())};
}

}  // namespace

std::vector<SweepPoint> DecodeKittiPoints(std::span<const uint8_t> file) {
  if (file.size() % kPointBytes != 0) {
    throw BadInput(fmt::format("{} bytes are not a whole number of KITTI points", file.size()));
  }
  std::vector<SweepPoint> points;
  points.reserve(file.size() / kPointBytes);
  for (ByteReader reader(file); !reader.empty();) {
    SweepPoint& p = points.emplace_back();
    p.x = reader.Get<float>();
    p.y = reader.Get<float>();
    p.z = reader.Get<float>();
    p.intensity = reader.Get<float>();
  }
  return points;
}

std::vector<int64_t> ParseKittiTimes(std::string_view text) {
  std::vector<int64_t> utimes;
  ForEachLine(text, [&](Words words) { utimes.push_back(ParseTime(words)); });
  return utimes;
}

std::vector<Pose3> ParseKittiPoses(std::string_view text) {
  std::vector<Pose3> poses;
  ForEachLine(text, [&](Words words) { poses.push_back(ParsePose(words)); });
  return poses;
}

Pose3 ParseKittiCalibration(std::string_view text) {
  std::optional<Pose3> T_camera_lidar;
  ForEachLine(text, [&](Words words) {
    if (words[0] == "Tr:" || words[0] == "Tr_velo_cam:") T_camera_lidar = ParsePose(words.subspan(1));
  });
  if (!T_camera_lidar) throw BadInput("no line 'Tr:'");
  return *T_camera_lidar;
}

void SetTimesByAzimuth(double turn_s, std::span<SweepPoint> points) {
  for (SweepPoint& p : points) {
    const double turns_to_go = 0.5 + std::atan2(p.y, p.x) / (2.0 * std::numbers::pi);
    p.dt_us = p.IsFinite() ? -static_cast<int32_t>(std::lround(1e6 * turn_s * turns_to_go)) : 0;
  }
}

}  // namespace lcmslam

#include "sensors/carmen_log.h"

#include <cmath>
#include <numbers>
#include <span>

#include <fmt/format.h>

#include "geometry/angles.h"
#include "sensors/bad_input.h"
#include "sensors/input_file.h"
#include "sensors/text_lines.h"

namespace lcmslam {
namespace {

constexpr size_t kMaxLineBytes = size_t{4} << 20;
constexpr double kMaxStamp_s = 9e12;  // fits int64 microseconds

using Tokens = std::vector<std::string_view>;
using TokenSpan = std::span<const std::string_view>;

double Real(std::string_view token) { return ParseNumber<double>(token); }

Pose2 PoseAt(TokenSpan tokens, size_t i) { return {Real(tokens[i]), Real(tokens[i + 1]), Real(tokens[i + 2])}; }

// The ipc time is the third token from the end.
int64_t Stamp(TokenSpan tokens) {
  const double seconds = Real(tokens[tokens.size() - 3]);
  if (!(std::abs(seconds) < kMaxStamp_s)) throw BadInput(fmt::format("'{}' is no time", tokens[tokens.size() - 3]));
  return std::llround(seconds * 1e6);
}

void RequireTokens(TokenSpan tokens, size_t count) {
  if (tokens.size() != count) {
    throw BadInput(fmt::format("{} has {} values where {} are expected", tokens[0], tokens.size() - 1, count - 1));
  }
}

// The count at token i, checked against the tokens that are there.
size_t CountAt(TokenSpan tokens, size_t i) {
  if (i >= tokens.size()) throw BadInput(fmt::format("{} ends early", tokens[0]));
  const auto count = ParseNumber<uint32_t>(tokens[i]);
  if (count > tokens.size() - i - 1) {
    throw BadInput(fmt::format("{} announces {} values, but only {} follow", tokens[0], count, tokens.size() - i - 1));
  }
  return count;
}

std::vector<Beam> Beams(TokenSpan ranges, double first_rad, double step_rad, double max_range_m) {
  std::vector<Beam> beams;
  beams.reserve(ranges.size());
  for (const std::string_view token : ranges) {
    const double range_m = Real(token);
    const double angle_rad = first_rad + step_rad * static_cast<double>(beams.size());
    beams.push_back({range_m < max_range_m ? static_cast<float>(range_m) : 0.0F, static_cast<float>(angle_rad), 0});
  }
  return beams;
}

}  // namespace

std::string CarmenOptions::Validate() const {
  if (!(max_range_m > 0.0)) return "max_range_m: must be positive";
  if (front_laser_offset_m && !std::isfinite(*front_laser_offset_m)) return "front_laser_offset_m: must be finite";
  return "";
}

CarmenReader::CarmenReader(const std::filesystem::path& path, const CarmenOptions& options)
    : path_(path),
      stream_(OpenInput(path)),
      front_max_m_(options.max_range_m),
      rear_max_m_(options.max_range_m),
      front_offset_m_(options.front_laser_offset_m.value_or(0.0)),
      fixed_front_offset_(options.front_laser_offset_m.has_value()) {}

std::optional<CarmenRecord> CarmenReader::Next() {
  try {
    while (ReadLine()) {
      const Tokens tokens = SplitWords(line_);
      if (tokens.empty() || tokens[0].starts_with('#')) continue;
      if (auto record = Parse(tokens)) return record;
    }
    return {};
  } catch (const BadInput& error) {
    throw BadInput(fmt::format("{}:{}: {}", path_.string(), line_number_, error.what()));
  } catch (const std::ios_base::failure&) {
    throw BadInput(fmt::format("{}: damaged compression behind line {}", path_.string(), line_number_));
  }
}

bool CarmenReader::ReadLine() {
  line_.clear();
  std::streambuf& bytes = *stream_->rdbuf();
  for (int c = bytes.sbumpc(); c != std::char_traits<char>::eof(); c = bytes.sbumpc()) {
    if (line_.empty()) ++line_number_;
    if (c == '\n') return true;
    if (line_.size() == kMaxLineBytes) throw BadInput("longer than any line of a CARMEN log");
    line_.push_back(static_cast<char>(c));
  }
  return !line_.empty();
}

std::optional<CarmenRecord> CarmenReader::Parse(const Tokens& tokens) {
  const std::string_view name = tokens[0];
  if (name == "PARAM") {
    TakeParameter(tokens);
  } else if (name == "FLASER" || name == "RLASER") {
    return ParseSimpleLaser(tokens);
  } else if (name == "ROBOTLASER1" || name == "ROBOTLASER2") {
    return ParseRobotLaser(tokens);
  } else if (name == "ODOM") {  // x y theta tv rv accel
    RequireTokens(tokens, 10);
    return CarmenOdometry{Stamp(tokens), PoseAt(tokens, 1)};
  } else if (name == "TRUEPOS") {  // true_x true_y true_theta odom_x odom_y odom_theta
    RequireTokens(tokens, 10);
    return CarmenTruth{Stamp(tokens), PoseAt(tokens, 1)};
  }
  return {};
}

// PARAM name value; late loggers append times.
void CarmenReader::TakeParameter(const Tokens& tokens) {
  if (tokens.size() < 3) return;
  const std::string_view name = tokens[1];
  if (name == "robot_frontlaser_offset" && !fixed_front_offset_) front_offset_m_ = Real(tokens[2]);
  if (name == "robot_rearlaser_offset") rear_offset_m_ = Real(tokens[2]);
  if (name == "robot_front_laser_max") front_max_m_ = Real(tokens[2]);
  if (name == "robot_rear_laser_max") rear_max_m_ = Real(tokens[2]);
}

// FLASER num_readings [ranges] x y theta odom_x odom_y odom_theta: the first pose is the laser's.
CarmenScan CarmenReader::ParseSimpleLaser(const Tokens& tokens) const {
  const size_t n = CountAt(tokens, 1);
  RequireTokens(tokens, n + 11);
  const bool front = tokens[0] == "FLASER";
  const double step_rad = std::numbers::pi / static_cast<double>(std::max<size_t>(n - n % 2, 2));
  CarmenScan record;
  record.sensor = tokens[0];
  record.scan.utime = Stamp(tokens);
  record.scan.beams =
      Beams(TokenSpan(tokens).subspan(2, n), DegToRad(-90.0), step_rad, front ? front_max_m_ : rear_max_m_);
  record.T_robot_laser = front ? Pose2(front_offset_m_, 0.0, 0.0) : Pose2(rear_offset_m_, 0.0, std::numbers::pi);
  record.T_odom_robot = PoseAt(tokens, n + 5);
  return record;
}

// ROBOTLASER1 laser_type start_angle field_of_view angular_resolution maximum_range accuracy remission_mode
//   num_readings [ranges] num_remissions [remissions] laser_x laser_y laser_theta robot_x robot_y robot_theta
//   laser_tv laser_rv forward_safety_dist side_safety_dist turn_axis
CarmenScan CarmenReader::ParseRobotLaser(const Tokens& tokens) const {
  const size_t n = CountAt(tokens, 8);
  const size_t remissions = CountAt(tokens, 9 + n);
  const size_t poses = 10 + n + remissions;
  RequireTokens(tokens, poses + 14);
  CarmenScan record;
  record.sensor = tokens[0];
  record.scan.utime = Stamp(tokens);
  record.scan.beams = Beams(TokenSpan(tokens).subspan(9, n), Real(tokens[2]), Real(tokens[4]), Real(tokens[5]));
  record.T_odom_robot = PoseAt(tokens, poses + 3);
  record.T_robot_laser = record.T_odom_robot.inverse() * PoseAt(tokens, poses);
  return record;
}

}  // namespace lcmslam

#pragma once

#include <cstdint>
#include <filesystem>
#include <istream>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "geometry/pose2.h"
#include "lidar/planar_scan.h"

namespace lcmslam {

// A laser line. The scan is stamped with its ipc time; beams carry no times of their own.
struct CarmenScan {
  std::string sensor;  // the line's name: FLASER, RLASER, ROBOTLASER1, ROBOTLASER2
  PlanarScan scan;     // ranges at or beyond the sensor's maximum are 0
  Pose2 T_robot_laser;
  Pose2 T_odom_robot;  // odometry as the line gives it
};
struct CarmenOdometry {
  int64_t utime = 0;  // us
  Pose2 T_odom_robot;
};
struct CarmenTruth {
  int64_t utime = 0;  // us
  Pose2 T_world_robot;
};
using CarmenRecord = std::variant<CarmenScan, CarmenOdometry, CarmenTruth>;

struct CarmenOptions {
  // FLASER and RLASER: ranges from here on are no return, unless PARAM robot_front_laser_max (rear:
  // robot_rear_laser_max) says otherwise. SICK scanners report 50 m, or 81.8 m and more, where they see nothing.
  double max_range_m = 50.0;
  // Overrides PARAM robot_frontlaser_offset, the FLASER's position along the robot's x axis.
  std::optional<double> front_laser_offset_m = {};

  std::string Validate() const;  // "" or "field: reason"
};

// Reads a CARMEN log (plain, gzip, bzip2) record by record, in the order of the file: lines FLASER, RLASER,
// ROBOTLASER1, ROBOTLASER2, ODOM, TRUEPOS and the PARAMs that concern them; others are passed over. Format: CARMEN's
// logger, "message contents ipc_timestamp ipc_hostname logger_timestamp". FLASER and RLASER cover 180 degrees from -90
// (180 or 181 beams: 1 degree, 360 or 361: half a degree). Non-finite numbers pass in ranges and poses, not in stamps.
// Throws BadInput with file and line number. One thread.
class CarmenReader {
 public:
  // `path` must be readable.
  explicit CarmenReader(const std::filesystem::path& path, const CarmenOptions& options = {});

  // None at the end.
  [[nodiscard]] std::optional<CarmenRecord> Next();

 private:
  using Tokens = std::vector<std::string_view>;

  bool ReadLine();
  std::optional<CarmenRecord> Parse(const Tokens& tokens);
  CarmenScan ParseSimpleLaser(const Tokens& tokens) const;
  CarmenScan ParseRobotLaser(const Tokens& tokens) const;
  void TakeParameter(const Tokens& tokens);

  std::filesystem::path path_;
  std::unique_ptr<std::istream> stream_;
  std::string line_;
  int64_t line_number_ = 0;
  double front_max_m_, rear_max_m_;
  double front_offset_m_ = 0.0, rear_offset_m_ = 0.0;
  bool fixed_front_offset_ = false;
};

}  // namespace lcmslam

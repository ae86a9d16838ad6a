#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

#include "bus/service.h"
#include "common/scan_input.h"
#include "geometry/pose2.h"
#include "lidar/occupancy_grid.h"
#include "lidar/planar_scan.h"

namespace lcmslam {

class slam_diagnostics_t;

// What one scan did to a planar SLAM system, in the terms of the bus.
struct PlanarUpdate {
  bool has_pose = false;  // false: the scan was skipped
  int64_t utime = 0;      // us; of the pose, the scan's last beam
  Pose2 T_map_body;
  Eigen::Vector3d twist_body = Eigen::Vector3d::Zero();  // m/s, m/s, rad/s
};

// A planar SLAM algorithm as PlanarSlamService drives it: an adapter from a library's pipeline.
class PlanarSlam {
 public:
  virtual ~PlanarSlam() = default;
  // Fills status, iterations, counts, covariance and stages of `diagnostics`.
  virtual PlanarUpdate Process(const PlanarScan& scan, slam_diagnostics_t& diagnostics) = 0;
  virtual void AddOdometry(int64_t utime, const Pose2& T_odom_body) = 0;
  virtual void SetMounting(const Pose2& T_body_lidar) = 0;  // before the first scan
  virtual void Reset() = 0;
  virtual void SetPose(const Pose2& T_map_body) = 0;
  virtual void SetLocalizeOnly(bool localize_only) = 0;
  virtual OccupancyGrid Grid() const = 0;
  // The system's own map file. "" or the reason, which names the file.
  virtual std::string SaveMap(const std::string& stem) const = 0;
  virtual std::string LoadMap(const std::string& path) = 0;
  // Publishes what changed in the map since the last call. At most once a second.
  virtual void PublishMap(ServiceContext& context, int64_t utime) = 0;
};

struct PlanarSlamOptions {
  std::string lidar_channel;     // "": LIDAR_2D, else the first other channel with scans
  std::string odometry_channel;  // "": scans only
  std::string command_channel = "SLAM_COMMAND";
  std::string pose_channel;
  std::string diagnostics_channel;
  std::string grid_channel = "SLAM_MAP";
  double grid_period_s = 2.0;        // of input time, between grids; 0: none
  int max_grid_cells = 90'000;       // larger grids are published coarser, to fit default kernel buffers
  bool mounting_configured = false;  // else from <lidar>_EXTRINSICS

  std::string Validate() const;
};

// Everything around a planar SLAM algorithm: input channels, messages out, commands, trajectory and map files.
// Files in options().out: NAME_tum.txt as it goes, NAME_map.pgm, .yaml and the system's own map at the end.
class PlanarSlamService : public Service {
 public:
  PlanarSlamService(PlanarSlamOptions options, int64_t config_hash, std::unique_ptr<PlanarSlam> slam, std::string name,
                    ServiceContext& context);
  void Finish() override;

 private:
  void OnScan(const PlanarScan& scan);
  Handled OnOdometry(const Event& event);
  Handled OnCommand(const Event& event);
  std::string Obey(const class slam_command_t& command);
  void PublishMaps(int64_t utime);
  std::string SaveMaps(const std::string& stem) const;
  std::filesystem::path OutputStem(const std::string& suffix) const;

  PlanarSlamOptions options_;
  int64_t config_hash_;
  std::unique_ptr<PlanarSlam> slam_;
  std::string name_;
  ServiceContext& context_;
  ScanInput input_;
  std::ofstream trajectory_;
  int64_t sequence_ = 0;
  int64_t tiles_published_utime_ = INT64_MIN;
  int64_t grid_published_utime_ = INT64_MIN;
  int64_t last_utime_ = INT64_MIN;
};

}  // namespace lcmslam

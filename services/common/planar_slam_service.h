#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "common/scan_input.h"
#include "common/slam_service.h"
#include "geometry/pose2.h"
#include "lidar/occupancy_grid.h"
#include "lidar/planar_scan.h"

namespace lcmslam {

// What one scan did to a planar SLAM system, in the terms of the bus.
struct PlanarUpdate {
  bool has_pose = false;  // false: the scan was skipped
  int64_t utime = 0;      // us; of the pose, the scan's last beam
  Pose2 T_map_body;
  Eigen::Vector3d twist_body = Eigen::Vector3d::Zero();  // m/s, m/s, rad/s
};

// A planar SLAM algorithm as PlanarSlamService drives it: an adapter from a library's pipeline.
class PlanarSlam : public SlamSystem {
 public:
  // Fills status, iterations, counts, covariance and stages of `diagnostics`.
  virtual PlanarUpdate Process(const PlanarScan& scan, slam_diagnostics_t& diagnostics) = 0;
  virtual void AddOdometry(int64_t utime, const Pose2& T_odom_body) = 0;
  virtual void SetMounting(const Pose2& T_body_lidar) = 0;  // before the first scan
  virtual void SetPose(const Pose2& T_map_body) = 0;
  virtual OccupancyGrid Grid() const = 0;
};

// lidar_channel "": LIDAR_2D, else the first other channel with scans.
struct PlanarSlamOptions : SlamServiceOptions {
  std::string grid_channel = "SLAM_MAP";
  double grid_period_s = 2.0;   // of input time, between grids; 0: none
  int max_grid_cells = 90'000;  // larger grids are published coarser, to fit default kernel buffers

  std::string Validate() const;
};

// A planar SLAM algorithm on the bus. Its maps are NAME_map.pgm, .yaml and the system's own.
class PlanarSlamService : public SlamService {
 public:
  PlanarSlamService(const PlanarSlamOptions& options, int64_t config_hash, std::unique_ptr<PlanarSlam> slam,
                    std::string name, ServiceContext& context);

 protected:
  void Flush() override { input_.Flush(); }
  void SetPose(const Pose3& T_map_body) override { slam_->SetPose(ToPose2(T_map_body)); }
  void PublishMaps(int64_t utime) override;
  std::string SaveMaps(const std::string& stem) const override;

 private:
  void OnScan(const PlanarScan& scan);
  Handled OnOdometry(const Event& event);

  PlanarSlamOptions planar_options_;
  std::unique_ptr<PlanarSlam> slam_;
  ScanInput input_;
  int64_t grid_published_utime_ = INT64_MIN;
};

}  // namespace lcmslam

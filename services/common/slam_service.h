#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>

#include <Eigen/Core>

#include "bus/service.h"
#include "geometry/pose3.h"

namespace lcmslam {

class slam_command_t;
class slam_diagnostics_t;

// What a SLAM algorithm can do besides taking scans, whatever its sensor.
class SlamSystem {
 public:
  virtual ~SlamSystem() = default;
  virtual void Reset() = 0;
  virtual void SetLocalizeOnly(bool localize_only) = 0;
  // The system's own map files. "" or the reason, which names the file.
  virtual std::string SaveMap(const std::string& stem) const = 0;
  virtual std::string LoadMap(const std::string& path) = 0;
  // Publishes what changed in the map since the last call. At most once a second.
  virtual void PublishMap(ServiceContext& context, int64_t utime) = 0;
};

struct SlamServiceOptions {
  std::string lidar_channel;
  std::string odometry_channel;  // "": none
  std::string command_channel = "SLAM_COMMAND";
  std::string pose_channel;
  std::string diagnostics_channel;
  bool mounting_configured = false;  // else from <lidar>_EXTRINSICS

  std::string Validate() const;
};

struct PoseEstimate {
  int64_t utime = 0;  // us; the last point of the scan
  Pose3 T_map_body;
  Eigen::Vector3d velocity_map = Eigen::Vector3d::Zero();        // m/s
  Eigen::Vector3d rotation_rate_body = Eigen::Vector3d::Zero();  // rad/s
};

// What planar and spatial SLAM services share: messages out, commands, trajectory and map files.
// Files in options().out: NAME_tum.txt as it goes, the maps at the end.
class SlamService : public Service {
 public:
  void Finish() final;

 protected:
  // `slam` has to outlive this.
  SlamService(SlamServiceOptions options, int64_t config_hash, SlamSystem& slam, std::string name,
              ServiceContext& context);

  // The outcome of the scan stamped `input_utime`: pose, diagnostics (completed here), trajectory, maps when due.
  void Report(const std::optional<PoseEstimate>& estimate, int64_t input_utime, slam_diagnostics_t& diagnostics);

  // The input has ended: hand over what still waits.
  virtual void Flush() = 0;
  virtual void SetPose(const Pose3& T_map_body) = 0;
  virtual void Reset() { slam_.Reset(); }
  // Called for every estimate; publishes what is due.
  virtual void PublishMaps(int64_t utime);
  // "" or the reason.
  virtual std::string SaveMaps(const std::string& stem) const { return slam_.SaveMap(stem); }

  // Whether `period_us` have passed since `last`, or time has jumped back.
  static bool Due(int64_t utime, int64_t last, int64_t period_us);

  const SlamServiceOptions& options() const { return options_; }
  ServiceContext& context() { return context_; }

 private:
  Handled OnCommand(const Event& event);
  std::string Obey(const slam_command_t& command);
  std::filesystem::path OutputStem(const std::string& suffix) const;

  SlamServiceOptions options_;
  int64_t config_hash_;
  SlamSystem& slam_;
  std::string name_;
  ServiceContext& context_;
  std::ofstream trajectory_;
  int64_t sequence_ = 0;
  int64_t map_published_utime_ = INT64_MIN;
  int64_t last_utime_ = INT64_MIN;
};

}  // namespace lcmslam

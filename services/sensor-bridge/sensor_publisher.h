#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "geometry/trajectory.h"
#include "lidar/planar_scan.h"
#include "sensor-bridge/bridge_output.h"
#include "sensor-bridge/time_order.h"

namespace lcmslam {

// Publishes what sensors say as messages, in the order of their stamps, and keeps count. One thread.
class SensorPublisher {
 public:
  explicit SensorPublisher(BridgeOutput& output) : output_(output) {}

  // From now on rigid_transform_t goes out on <lidar_channel>_EXTRINSICS with the channel's first scan, then once a
  // second of data time.
  void SetMounting(const std::string& lidar_channel, const Pose3& T_body_sensor);
  void PublishScan(const std::string& channel, const PlanarScan& scan);
  // What is no pose (not finite, no unit quaternion) is counted and left out.
  void PublishPose(const std::string& channel, const StampedPose& pose);
  // Publishes what is still held back for the order of stamps.
  void Finish();

  // "213 scans on LIDAR_2D, 638 poses on ODOMETRY; 25.4 s".
  std::string Summary() const;

 private:
  struct Message {
    std::string channel;
    std::vector<uint8_t> data;
  };
  struct Mounting {
    Pose3 T_body_sensor;
    int64_t published_utime = 0;
    bool published = false;
  };
  struct Count {
    const char* what;
    int64_t messages = 0;
  };

  void Push(int64_t utime, const std::string& channel, const char* what, std::vector<uint8_t> data);
  void Emit(int64_t utime, const Message& message);
  void PublishMounting(int64_t utime, const std::string& lidar_channel);

  BridgeOutput& output_;
  TimeOrder<Message> order_{2'000'000};
  std::map<std::string, Mounting> mountings_;
  std::map<std::string, Count> counts_;  // by channel
  int64_t invalid_poses_ = 0;
  int64_t duration_us_ = 0;
  int64_t last_utime_ = 0;
  bool started_ = false;
};

}  // namespace lcmslam

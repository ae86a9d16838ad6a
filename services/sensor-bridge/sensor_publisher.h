#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "bus/progress.h"
#include "geometry/trajectory.h"
#include "lidar/imu_sample.h"
#include "lidar/planar_scan.h"
#include "lidar/sweep.h"
#include "sensor-bridge/bridge_output.h"
#include "sensor-bridge/time_order.h"

namespace lcmslam {

// Publishes what sensors say as messages, in the order of their stamps, and keeps count. One thread.
class SensorPublisher {
 public:
  SensorPublisher(BridgeOutput& output, bool quiet) : output_(output), quiet_(quiet) {}

  // From now on a progress bar shows how many of `scans`, planar ones and sweeps, have been published.
  void ExpectScans(int64_t scans);

  // From now on rigid_transform_t goes out on <lidar_channel>_EXTRINSICS with the channel's first scan, then once a
  // second of data time.
  void SetMounting(const std::string& lidar_channel, const Pose3& T_body_sensor);
  void PublishScan(const std::string& channel, const PlanarScan& scan);
  // In chunks, each at the time of its last point as a sensor would send it; where the points' times are unknown,
  // spread over the 0.1 s before the sweep's stamp.
  void PublishSweep(const std::string& channel, const Sweep& sweep);
  // What is not finite is counted and left out.
  void PublishImu(const std::string& channel, const ImuSample& sample);
  // What is no pose (not finite, no unit quaternion) is counted and left out.
  void PublishPose(const std::string& channel, const StampedPose& pose);
  // What a lidar sent in one datagram, as it came.
  void PublishPacket(const std::string& channel, int64_t received_utime, uint16_t port,
                     std::span<const uint8_t> payload);
  // A message of another log.
  void PublishAsIs(const std::string& channel, int64_t utime, std::vector<uint8_t> message);
  // Publishes what is still held back for the order of stamps.
  void Flush();
  // Flush, when nothing follows.
  void Finish();

  // "213 scans on LIDAR_2D, 638 poses on ODOMETRY; 25.4 s".
  std::string Summary() const;

 private:
  enum class Kind { kScan, kPose, kSweep, kImu, kPacket, kOther };
  struct Message {
    Kind kind;
    std::string channel;
    std::vector<uint8_t> data;
    bool counts = true;  // not so the chunks of a sweep, except the last
  };
  struct Mounting {
    Pose3 T_body_sensor;
    int64_t published_utime = 0;
    bool published = false;
  };
  struct Count {
    Kind kind;
    int64_t messages = 0;
  };

  void Push(int64_t utime, Message message);
  void Emit(int64_t utime, const Message& message);
  void ShowProgress(Kind kind);
  void PublishMounting(int64_t utime, const std::string& lidar_channel);

  BridgeOutput& output_;
  bool quiet_;
  std::optional<Progress> progress_;
  uint64_t scans_published_ = 0;
  TimeOrder<Message> order_{2'000'000};
  std::map<std::string, Mounting> mountings_;
  std::map<std::string, Count> counts_;           // by channel
  std::map<std::string, int32_t> sweep_numbers_;  // of the channel's next one
  int64_t invalid_poses_ = 0;
  int64_t invalid_samples_ = 0;
  int64_t duration_us_ = 0;
  int64_t last_utime_ = 0;
  bool started_ = false;
};

}  // namespace lcmslam

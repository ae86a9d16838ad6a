#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "lidar/angle_sense.h"
#include "sensor-bridge/sensor_publisher.h"
#include "sensors/carmen_log.h"

namespace lcmslam {

// Every importer goes through its file twice: first to learn what there is, then to publish it. They stop early on
// SIGTERM or SIGINT. Malformed files end in BadInput (CommandError for LCM logs), after all that came before was handed
// to the publisher. What a person should know goes to `note`, line by line.
using Note = std::function<void(const std::string& line)>;

struct CarmenImportOptions {
  std::filesystem::path file;
  CarmenOptions log;
  std::string scan_line;  // FLASER, ...; the one for LIDAR_2D; "": the most frequent

  // How long before its stamp a scan was measured. Scans keep their stamps, which relations and other people's results
  // refer to; odometry and truth are moved to later instead.
  double scan_delay_s = 0.0;

  std::string Validate() const;
};
void ImportCarmen(const CarmenImportOptions& options, SensorPublisher& publisher, const Note& note);

struct RosbagImportOptions {
  std::filesystem::path file;
  std::string scan_topic;          // for LIDAR_2D; "": the LaserScan with most messages
  std::string cloud_topic;         // for LIDAR_3D; "": the PointCloud2 with most messages
  std::string imu_topic;           // for IMU; "": the one with most messages
  std::string odometry_topic;      // "": the nav_msgs/Odometry with most messages, else tf
  std::string ground_truth_topic;  // "": a pose topic whose name says so
  std::string base_frame;          // of the body; "": the odometry's child frame, base_footprint, base_link
};
void ImportRosbag(const RosbagImportOptions& options, SensorPublisher& publisher, const Note& note);

struct MbotImportOptions {
  std::filesystem::path file;
  std::string scan_channel;                        // for LIDAR_2D; "": the one with most scans
  std::string odometry_channel = "ODOMETRY";       // poses from here go to ODOMETRY
  std::string ground_truth_channel = "TRUE_POSE";  // and from here to GROUND_TRUTH; others keep their channel
  std::optional<AngleSense> sense;                 // of the scans' angles; none: DetectAngleSense
};
void ImportMbot(const MbotImportOptions& options, SensorPublisher& publisher, const Note& note);

struct VelodyneImportOptions {
  std::filesystem::path file;  // capture, bare payloads, or an LCM log with LIDAR_3D_PACKET
  uint16_t port = 0;           // only datagrams to this one; 0: to any
  bool keep_packets = false;   // the payloads go to LIDAR_3D_PACKET as well
};
void ImportVelodyne(const VelodyneImportOptions& options, SensorPublisher& publisher, const Note& note);

// A folder with one file of points a sweep.
struct CloudImportOptions {
  std::filesystem::path file;        // the folder
  std::filesystem::path times_file;  // "": as the layout has it, else by rate_hz
  std::filesystem::path poses_file;  // "": as the layout has it
  double rate_hz = 10.0;             // where there are no times; the first sweep is then at 0
  std::optional<double> turn_s;      // points get times by azimuth, stamps are of half the turn; 0: times as they are
  std::string lidar;                 // "vlp16", ...: points without a ring get it by elevation

  std::string Validate() const;
};
// The KITTI layouts: a sequence of the odometry benchmark, a raw drive, or scans side by side in a folder.
void ImportKitti(const CloudImportOptions& options, SensorPublisher& publisher, const Note& note);
// `*.pcd` or `*.ply`, in the order of their names.
void ImportPcd(const CloudImportOptions& options, SensorPublisher& publisher, const Note& note);
void ImportPly(const CloudImportOptions& options, SensorPublisher& publisher, const Note& note);

}  // namespace lcmslam

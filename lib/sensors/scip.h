#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lidar/planar_scan.h"

namespace lcmslam {

// Hokuyo's protocol SCIP 2.0 (URG Series Communication Protocol Specification, C-42-03320B): the host sends a line, the
// sensor answers with that line, a status, and lines of data, each with a checksum, up to an empty line.

struct ScipReply {
  std::string command;             // as it was sent, or for scans with the number of those still to come
  std::string status;              // "00": done, "99": a scan
  std::vector<std::string> lines;  // without checksums
};

// Cuts what a sensor sends into replies. One thread.
class ScipReplyReader {
 public:
  void Append(std::string_view bytes) { bytes_ += bytes; }
  // None until one is whole. What has a wrong checksum, as the rest of a scan that was under way when the host came, is
  // counted and passed over.
  [[nodiscard]] std::optional<ScipReply> Next();

  int64_t refused() const { return refused_; }

 private:
  std::string bytes_;
  int64_t refused_ = 0;
};

// Of the answer to PP.
struct ScipParameters {
  int first_step = 0;      // AMIN
  int last_step = 0;       // AMAX
  int front_step = 0;      // AFRT; angle 0
  int steps_per_turn = 0;  // ARES; counter-clockwise
  double turn_s = 0.0;     // SCAN, in turns a minute
  double min_range_m = 0.0, max_range_m = 0.0;
};
// Throws BadInput when one is missing or absurd. Pure.
[[nodiscard]] ScipParameters ParseScipParameters(const ScipReply& reply);

// The commands for endless scans with 3 characters a range, and for no more.
[[nodiscard]] std::string ScipScanCommand(const ScipParameters& parameters);
inline constexpr const char* kScipStop = "QT\n";

// The scan in the answer to ScipScanCommand (status 99), stamped `utime` at its last beam; ranges beyond the sensor's
// limits, which are its error codes, are 0. Throws BadInput when it holds another number of ranges. Pure.
[[nodiscard]] PlanarScan DecodeScipScan(const ScipReply& reply, const ScipParameters& parameters, int64_t utime);

}  // namespace lcmslam

#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "sensors/byte_reader.h"

namespace lcmslam {

struct RosbagConnection {
  std::string topic;
  std::string type;  // "sensor_msgs/LaserScan"
};

struct RosbagMessage {
  const RosbagConnection* connection = nullptr;  // lives as long as the reader
  int64_t received_utime = 0;                    // us; the recorder's clock
  uint64_t offset = 0;                           // of its chunk in the file
  std::span<const uint8_t> data;                 // serialized; valid until the next call
};

// A record header: values are views of its bytes.
using RosbagFields = std::map<std::string, std::span<const uint8_t>, std::less<>>;

// Reads a ROS 1 bag (format 2.0; chunks plain, bz2 or lz4) message by message in the order of the file. It goes from
// front to back and needs no index, so bags of a recorder that died can be read up to where they end; memory is one
// chunk. http://wiki.ros.org/Bags/Format/2.0
// Not librosbag_storage: it ends the process on damaged uncompressed bags (17 of 2000 mutated ones).
// Throws BadInput with file and byte offset. One thread.
class RosbagReader {
 public:
  explicit RosbagReader(const std::filesystem::path& path);
  RosbagReader(const RosbagReader&) = delete;
  RosbagReader& operator=(const RosbagReader&) = delete;

  // None at the end.
  [[nodiscard]] std::optional<RosbagMessage> Next();

 private:
  void ReadVersion();
  // The next record of the file: its header's fields (views of header_) and the length of its data; none at the end.
  std::optional<uint32_t> ReadRecordHeader(RosbagFields& fields);
  std::vector<uint8_t> ReadBytes(uint64_t count);
  // Moves to the next chunk; false at the end of the file.
  bool EnterChunk();
  std::optional<RosbagMessage> NextInChunk();
  void AddConnection(const RosbagFields& fields, std::span<const uint8_t> data);

  std::filesystem::path path_;
  std::ifstream file_;
  uint64_t remaining_bytes_ = 0;
  uint64_t size_bytes_ = 0;
  uint64_t record_offset_ = 0;
  std::vector<uint8_t> header_;
  std::vector<uint8_t> chunk_;
  ByteReader in_chunk_{{}};
  std::map<uint32_t, RosbagConnection> connections_;
};

}  // namespace lcmslam

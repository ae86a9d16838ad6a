#pragma once

#include <cstdint>
#include <map>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <boost/iostreams/filter/bzip2.hpp>
#include <boost/iostreams/filtering_stream.hpp>
#include <lz4frame.h>

#include "support/ros_bytes.h"

namespace lcmslam {

// Makes the bytes of a ROS 1 bag of format 2.0.
class RosbagBuilder {
 public:
  explicit RosbagBuilder(std::string compression = "none") : compression_(std::move(compression)) {
    bag_ = "#ROSBAG V2.0\n" + Record({{"op", "\x03"}, {"index_pos", std::string(8, '\0')}}, std::string(100, ' '));
  }

  RosbagBuilder& Message(const std::string& topic, const std::string& type, int64_t received_utime,
                         const std::string& data) {
    const auto [connection, is_new] = connections_.try_emplace(topic, static_cast<uint32_t>(connections_.size()));
    const std::string id = RosBytes().Put(connection->second).data();
    if (is_new) {
      chunk_ += Record({{"op", "\x07"}, {"conn", id}, {"topic", topic}},
                       HeaderOf({{"topic", topic}, {"type", type}, {"md5sum", "*"}}));
    }
    chunk_ += Record({{"op", "\x02"}, {"conn", id}, {"time", RosBytes().PutTime(received_utime).data()}}, data);
    return *this;
  }
  // Ends the chunk; the next message starts another.
  RosbagBuilder& EndChunk() {
    if (chunk_.empty()) return *this;
    const std::string size = RosBytes().Put(static_cast<uint32_t>(chunk_.size())).data();
    bag_ += Record({{"op", "\x05"}, {"compression", compression_}, {"size", size}}, Pack(chunk_));
    bag_ += Record({{"op", "\x04"}}, "index");
    chunk_.clear();
    return *this;
  }
  std::string Bytes() {
    EndChunk();
    return bag_;
  }

 private:
  using Fields = std::vector<std::pair<std::string, std::string>>;

  static std::string HeaderOf(const Fields& fields) {
    RosBytes bytes;
    for (const auto& [name, value] : fields) bytes.PutString(name + "=" + value);
    return bytes.data();
  }
  static std::string Record(const Fields& fields, const std::string& data) {
    return RosBytes().PutString(HeaderOf(fields)).PutString(data).data();
  }
  std::string Pack(const std::string& chunk) const {
    if (compression_ == "bz2") {
      std::ostringstream out;
      boost::iostreams::filtering_ostream stream;
      stream.push(boost::iostreams::bzip2_compressor());
      stream.push(out);
      stream << chunk;
      stream.reset();
      return out.str();
    }
    if (compression_ == "lz4") {
      std::string packed(LZ4F_compressFrameBound(chunk.size(), nullptr), '\0');
      packed.resize(LZ4F_compressFrame(packed.data(), packed.size(), chunk.data(), chunk.size(), nullptr));
      return packed;
    }
    return chunk;
  }

  std::string compression_;
  std::string bag_;
  std::string chunk_;
  std::map<std::string, uint32_t> connections_;
};

}  // namespace lcmslam

#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "bus/wire.h"
#include "lidar/imu_sample.h"
#include "lidar/sweep.h"

namespace lcmslam {

class imu_t;
class point_cloud_chunk_t;

// The sweep in chunks of at most 22 kB, at least one.
std::vector<point_cloud_chunk_t> ToChunks(const Sweep& sweep, int32_t sweep_number);

// None unless a well-formed point_cloud_chunk_t whose chunk lies below num_chunks and whose stamp is reasonable.
std::optional<point_cloud_chunk_t> DecodeChunk(Bytes message);

// None unless a well-formed, finite imu_t.
std::optional<ImuSample> DecodeImu(Bytes message);
imu_t ToMessage(const ImuSample& sample);

// Puts chunks together to sweeps. Chunks may come in any order, may repeat, and may stay away: a sweep is given up on
// when a later one is whole or two later ones have begun, and then comes with the points that arrived. Points stand in
// the order of their chunks. One thread.
class SweepAssembler {
 public:
  // The sweeps that this chunk completes or ends, in their order.
  [[nodiscard]] std::vector<Sweep> Add(const point_cloud_chunk_t& chunk);
  // What is left when nothing follows.
  [[nodiscard]] std::vector<Sweep> Finish();

  int64_t missing() const { return missing_; }  // chunks that never came, those of whole sweeps among them
  int64_t late() const { return late_; }        // chunks that came twice, or after their sweep was given up on

 private:
  struct Begun {
    int32_t number = 0;
    Sweep sweep;  // points stay empty until it ends
    std::vector<std::optional<std::vector<SweepPoint>>> chunks;
    size_t arrived = 0;
    bool IsWhole() const { return arrived == chunks.size(); }
  };
  Begun* BegunSweepOf(const point_cloud_chunk_t& chunk, std::vector<Sweep>& ended);
  Sweep EndFirst();

  std::deque<Begun> begun_;            // by rising number, at most two
  std::optional<int32_t> last_ended_;  // its number
  size_t usual_chunks_ = 1;            // a sweep
  int64_t missing_ = 0, late_ = 0;
};

}  // namespace lcmslam

#include "bus/sweep_chunks.h"

#include <algorithm>
#include <cmath>

#include <lcmslam/imu_t.hpp>
#include <lcmslam/point_cloud_chunk_t.hpp>

#include "geometry/utime.h"

namespace lcmslam {
namespace {

// 15 Ethernet packets: fewer would get lost less often, but a turn of a VLP-16 has to fit LCM's queue of 30 messages.
constexpr size_t kMaxChunkBytes = 22'000;
constexpr size_t kHeaderBytes = 32;
constexpr size_t kPointBytes = 22;
constexpr size_t kPointsPerChunk = (kMaxChunkBytes - kHeaderBytes) / kPointBytes;

// A sender whose numbers step further than this, ahead or back, has started anew: it did not lose that many sweeps,
// nor does the bus deliver that late.
constexpr int64_t kMaxStepAhead = 100, kMaxStepBack = 3;

// Offsets beyond this are not times of points.
constexpr int32_t kMaxOffsetUs = 10'000'000;

point_cloud_chunk_t ToChunk(int64_t utime, std::span<const SweepPoint> points) {
  point_cloud_chunk_t message{};
  message.utime = utime;
  message.num_points = static_cast<int32_t>(points.size());
  for (const SweepPoint& p : points) {
    message.x.push_back(p.x);
    message.y.push_back(p.y);
    message.z.push_back(p.z);
    message.intensity.push_back(p.intensity);
    message.ring.push_back(p.ring);
    message.time_offset.push_back(p.dt_us);
  }
  return message;
}

std::vector<SweepPoint> PointsOf(const point_cloud_chunk_t& message) {
  std::vector<SweepPoint> points(message.x.size());
  for (size_t i = 0; i < points.size(); ++i) {
    const int32_t dt_us = message.time_offset[i];
    const bool timed = dt_us >= -kMaxOffsetUs && dt_us <= kMaxOffsetUs;
    points[i] = {message.x[i], message.y[i], message.z[i], message.intensity[i], message.ring[i], timed ? dt_us : 0};
  }
  return points;
}

// Drivers that stamp the first point send positive offsets: moves the stamp to the last one.
void StampLastPoint(Sweep& sweep) {
  int32_t latest_us = 0;
  for (const SweepPoint& p : sweep.points) latest_us = std::max(latest_us, p.dt_us);
  if (latest_us == 0) return;
  for (SweepPoint& p : sweep.points) p.dt_us -= latest_us;
  sweep.utime += latest_us;
}

}  // namespace

std::vector<point_cloud_chunk_t> ToChunks(const Sweep& sweep, int32_t sweep_number) {
  const size_t num_chunks = std::max<size_t>(1, (sweep.points.size() + kPointsPerChunk - 1) / kPointsPerChunk);
  std::vector<point_cloud_chunk_t> chunks;
  std::span<const SweepPoint> rest = sweep.points;
  for (size_t i = 0; i < num_chunks; ++i) {
    const size_t n = rest.size() / (num_chunks - i);
    chunks.push_back(ToChunk(sweep.utime, rest.first(n)));
    chunks.back().sweep = sweep_number;
    chunks.back().chunk = static_cast<int16_t>(i);
    chunks.back().num_chunks = static_cast<int16_t>(num_chunks);
    rest = rest.subspan(n);
  }
  return chunks;
}

std::optional<point_cloud_chunk_t> DecodeChunk(Bytes message) {
  auto chunk = Decode<point_cloud_chunk_t>(message);
  if (!chunk || chunk->chunk < 0 || chunk->chunk >= chunk->num_chunks || !IsReasonableUtime(chunk->utime)) return {};
  return chunk;
}

std::optional<ImuSample> DecodeImu(Bytes message) {
  const auto imu = Decode<imu_t>(message);
  if (!imu) return {};
  ImuSample sample{imu->utime, Eigen::Vector3d(imu->angular_velocity), Eigen::Vector3d(imu->specific_force)};
  if (!sample.angular_velocity_radps.allFinite() || !sample.specific_force_mps2.allFinite()) return {};
  return sample;
}

imu_t ToMessage(const ImuSample& sample) {
  imu_t message{};
  message.utime = sample.utime;
  std::copy_n(sample.angular_velocity_radps.data(), 3, message.angular_velocity);
  std::copy_n(sample.specific_force_mps2.data(), 3, message.specific_force);
  return message;
}

std::vector<Sweep> SweepAssembler::Add(const point_cloud_chunk_t& chunk) {
  std::vector<Sweep> ended;
  Begun* begun = BegunSweepOf(chunk, ended);
  if (begun == nullptr || begun->chunks[static_cast<size_t>(chunk.chunk)]) {
    ++late_;
    return ended;
  }
  begun->chunks[static_cast<size_t>(chunk.chunk)] = PointsOf(chunk);
  ++begun->arrived;
  if (begun->IsWhole()) {
    const int32_t number = begun->number;
    while (!begun_.empty() && begun_.front().number <= number) ended.push_back(EndFirst());
  }
  return ended;
}

std::vector<Sweep> SweepAssembler::Finish() {
  std::vector<Sweep> ended;
  while (!begun_.empty()) ended.push_back(EndFirst());
  return ended;
}

// The sweep that the chunk belongs to, begun if it is new; none when it has ended.
SweepAssembler::Begun* SweepAssembler::BegunSweepOf(const point_cloud_chunk_t& chunk, std::vector<Sweep>& ended) {
  const auto num_chunks = static_cast<size_t>(chunk.num_chunks);
  for (Begun& begun : begun_) {
    if (begun.number != chunk.sweep) continue;
    if (begun.sweep.utime == chunk.utime && begun.chunks.size() == num_chunks) return &begun;
    return nullptr;
  }
  const std::optional<int32_t> newest = begun_.empty() ? last_ended_ : begun_.back().number;
  const int64_t step = newest ? int64_t{chunk.sweep} - *newest : 1;
  if (step > kMaxStepAhead || step < -kMaxStepBack) {
    for (Sweep& sweep : Finish()) ended.push_back(std::move(sweep));
    last_ended_.reset();
  } else if (step <= 0) {
    return nullptr;
  }
  begun_.push_back({chunk.sweep, {chunk.utime, {}}, {}, 0});
  begun_.back().chunks.resize(num_chunks);
  if (begun_.size() > 2) ended.push_back(EndFirst());
  return &begun_.back();
}

Sweep SweepAssembler::EndFirst() {
  Begun begun = std::move(begun_.front());
  begun_.pop_front();
  if (last_ended_) missing_ += (int64_t{begun.number} - *last_ended_ - 1) * static_cast<int64_t>(usual_chunks_);
  missing_ += static_cast<int64_t>(begun.chunks.size() - begun.arrived);
  last_ended_ = begun.number;
  usual_chunks_ = begun.chunks.size();
  for (auto& chunk : begun.chunks) {
    if (chunk) begun.sweep.points.insert(begun.sweep.points.end(), chunk->begin(), chunk->end());
  }
  StampLastPoint(begun.sweep);
  return std::move(begun.sweep);
}

}  // namespace lcmslam

#include "trajectory/write.h"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>

#include <fmt/format.h>

namespace lcmslam {
namespace {

std::string FormatSeconds(int64_t utime) {
  const char* sign = utime < 0 ? "-" : "";
  const uint64_t us = utime < 0 ? -static_cast<uint64_t>(utime) : static_cast<uint64_t>(utime);
  return fmt::format("{}{}.{:06d}000", sign, us / 1'000'000, us % 1'000'000);
}

std::string FormatEuroc(const StampedPose& p) {
  const auto& t = p.pose.translation;
  const auto& q = p.pose.rotation;
  return fmt::format("{}000,{:.9f},{:.9f},{:.9f},{:.9f},{:.9f},{:.9f},{:.9f}\n", p.utime, t.x(), t.y(), t.z(), q.w(),
                     q.x(), q.y(), q.z());
}

std::string FormatKitti(const StampedPose& p) {
  Eigen::Matrix<double, 3, 4, Eigen::RowMajor> matrix;
  matrix << p.pose.rotation.toRotationMatrix(), p.pose.translation;
  return fmt::format("{:.9f}\n", fmt::join(matrix.data(), matrix.data() + matrix.size(), " "));
}

template <typename Format>
std::string WriteLines(const std::filesystem::path& path, const char* header, std::span<const StampedPose> trajectory,
                       Format format) {
  std::ofstream file(path, std::ios::binary);
  file << header;
  for (const StampedPose& pose : trajectory) file << format(pose);
  file.close();
  return file ? "" : fmt::format("{}: cannot write: {}", path.string(), std::strerror(errno));
}

}  // namespace

std::string FormatTum(const StampedPose& p) {
  const auto& t = p.pose.translation;
  const auto& q = p.pose.rotation;
  return fmt::format("{} {:.9f} {:.9f} {:.9f} {:.9f} {:.9f} {:.9f} {:.9f}\n", FormatSeconds(p.utime), t.x(), t.y(),
                     t.z(), q.x(), q.y(), q.z(), q.w());
}

std::string WriteTum(const std::filesystem::path& path, std::span<const StampedPose> trajectory) {
  return WriteLines(path, "", trajectory, FormatTum);
}

std::string WriteEuroc(const std::filesystem::path& path, std::span<const StampedPose> trajectory) {
  const char* header = "#timestamp [ns],p_x [m],p_y [m],p_z [m],q_w [],q_x [],q_y [],q_z []\n";
  return WriteLines(path, header, trajectory, FormatEuroc);
}

std::string WriteKitti(const std::filesystem::path& path, std::span<const StampedPose> trajectory,
                       const std::filesystem::path& times) {
  const std::string error = WriteLines(path, "", trajectory, FormatKitti);
  if (!error.empty() || times.empty()) return error;
  return WriteLines(times, "", trajectory, [](const StampedPose& pose) { return FormatSeconds(pose.utime) + "\n"; });
}

}  // namespace lcmslam

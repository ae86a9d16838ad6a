#include "common/spatial_slam_service.h"

#include <lcmslam/slam_diagnostics_t.hpp>

#include "bus/messages.h"
#include "bus/sweep_chunks.h"
#include "common/diagnostics.h"

namespace lcmslam {

std::string SpatialSlamOptions::Validate() const {
  return lidar_channel.empty() ? "channels.lidar: needs a name" : SlamServiceOptions::Validate();
}

SpatialSlamService::SpatialSlamService(const SpatialSlamOptions& options, int64_t config_hash,
                                       std::unique_ptr<SpatialSlam> slam, std::string name, ServiceContext& context)
    : SlamService(options, config_hash, *slam, std::move(name), context),
      T_map_body_initial_(options.T_map_body_initial),
      slam_(std::move(slam)),
      input_(
          options.lidar_channel, options.mounting_configured, [this](const Pose3& T) { SetMounting(T); },
          [this](const Sweep& sweep) { OnSweep(sweep); }, context.health()) {
  if (!options.load_map.empty()) {
    const std::string error = slam_->LoadMap(options.load_map);
    if (!error.empty()) throw CommandError(ExitCode::kBadInput, error);
  }
  slam_->SetLocalizeOnly(options.localize_only);
  SetMounting(options.T_body_lidar);
  context.Subscribe(options.lidar_channel + "(_EXTRINSICS)?",
                    [this](const Event& event) { return input_.Offer(event); });
  if (!options.odometry_channel.empty())
    context.Subscribe(options.odometry_channel, [this](const Event& event) { return OnOdometry(event); });
  if (!options.imu_channel.empty())
    context.Subscribe(options.imu_channel, [this](const Event& event) { return OnImu(event); });
}

// The first sweep is taken at the initial pose of the body.
void SpatialSlamService::SetMounting(const Pose3& T_body_lidar) {
  T_body_lidar_ = T_body_lidar;
  motion_.SetMounting(T_body_lidar);
  SetPose(T_map_body_initial_);
}

void SpatialSlamService::Reset() {
  SlamService::Reset();
  SetPose(T_map_body_initial_);
}

void SpatialSlamService::OnSweep(const Sweep& sweep) {
  const LidarMotion motion = motion_.Between(last_sweep_utime_, sweep.utime);
  slam_diagnostics_t diagnostics{};
  const SpatialUpdate update = slam_->Process(sweep, motion, diagnostics);
  SetCovariance(CovarianceOfBody(update), diagnostics);
  if (update.has_pose) last_sweep_utime_ = update.utime;
  Report(update.has_pose ? std::optional(ToBody(update)) : std::nullopt, sweep.utime, diagnostics);
}

PoseEstimate SpatialSlamService::ToBody(const SpatialUpdate& update) const {
  const Pose3 T_map_body = update.T_map_lidar * T_body_lidar_.inverse();
  const Eigen::Vector3d lever = T_map_body.translation - update.T_map_lidar.translation;
  return {update.utime, T_map_body, update.velocity + update.angular_velocity.cross(lever),
          T_map_body.rotation.conjugate() * update.angular_velocity};
}

// A turn of the lidar by w moves the body by w x lever.
Eigen::Matrix<double, 6, 6> SpatialSlamService::CovarianceOfBody(const SpatialUpdate& update) const {
  const Eigen::Vector3d lever = update.T_map_lidar.rotation * T_body_lidar_.inverse().translation;
  Eigen::Matrix<double, 6, 6> J = Eigen::Matrix<double, 6, 6>::Identity();
  for (int axis = 0; axis < 3; ++axis) J.block<3, 1>(0, 3 + axis) = Eigen::Vector3d::Unit(axis).cross(lever);
  return J * update.covariance * J.transpose();
}

Handled SpatialSlamService::OnOdometry(const Event& event) {
  const auto T_odom_body = DecodePose(event.data);
  if (!T_odom_body) return Handled::kRefused;
  motion_.AddOdometry(*T_odom_body);
  return Handled::kAccepted;
}

Handled SpatialSlamService::OnImu(const Event& event) {
  const auto sample = DecodeImu(event.data);
  if (!sample) return Handled::kRefused;
  motion_.AddImu(*sample);
  return Handled::kAccepted;
}

}  // namespace lcmslam

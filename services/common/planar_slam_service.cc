#include "common/planar_slam_service.h"

#include <lcmslam/occupancy_grid_t.hpp>
#include <lcmslam/slam_diagnostics_t.hpp>

#include "bus/messages.h"

namespace lcmslam {
namespace {

PoseEstimate ToEstimate(const PlanarUpdate& update) {
  PoseEstimate estimate{update.utime, ToPose3(update.T_map_body)};
  estimate.velocity_map.head<2>() = update.T_map_body.rotation() * update.twist_body.head<2>();
  estimate.rotation_rate_body.z() = update.twist_body.z();
  return estimate;
}

occupancy_grid_t GridMessage(int64_t utime, const OccupancyGrid& grid) {
  occupancy_grid_t message{};
  message.utime = utime;
  message.origin_x = static_cast<float>(grid.origin_m.x());
  message.origin_y = static_cast<float>(grid.origin_m.y());
  message.meters_per_cell = static_cast<float>(grid.cell_m);
  message.width = grid.width;
  message.height = grid.height;
  message.num_cells = grid.width * grid.height;
  message.cells = grid.cells;
  return message;
}

}  // namespace

std::string PlanarSlamOptions::Validate() const {
  if (!(grid_period_s >= 0.0)) return "channels.grid_period_s: must not be negative";
  if (max_grid_cells < 100) return "channels.max_grid_cells: must be at least 100";
  return SlamServiceOptions::Validate();
}

PlanarSlamService::PlanarSlamService(const PlanarSlamOptions& options, int64_t config_hash,
                                     std::unique_ptr<PlanarSlam> slam, std::string name, ServiceContext& context)
    : SlamService(options, config_hash, *slam, std::move(name), context),
      planar_options_(options),
      slam_(std::move(slam)),
      input_(
          options.lidar_channel, options.mounting_configured, [this](const Pose2& T) { slam_->SetMounting(T); },
          [this](const PlanarScan& scan) { OnScan(scan); }) {
  context.Subscribe(options.lidar_channel.empty() ? ".*" : options.lidar_channel + "(_EXTRINSICS)?",
                    [this](const Event& event) { return input_.Offer(event); });
  if (!options.odometry_channel.empty())
    context.Subscribe(options.odometry_channel, [this](const Event& event) { return OnOdometry(event); });
}

void PlanarSlamService::OnScan(const PlanarScan& scan) {
  slam_diagnostics_t diagnostics{};
  const PlanarUpdate update = slam_->Process(scan, diagnostics);
  context().health().NoteInput(input_.channel(), scan.utime);
  Report(update.has_pose ? std::optional(ToEstimate(update)) : std::nullopt, scan.utime, diagnostics);
}

void PlanarSlamService::PublishMaps(int64_t utime) {
  SlamService::PublishMaps(utime);
  const auto grid_period_us = static_cast<int64_t>(planar_options_.grid_period_s * 1e6);
  if (grid_period_us > 0 && Due(utime, grid_published_utime_, grid_period_us)) {
    grid_published_utime_ = utime;
    const OccupancyGrid grid = CoarsenedTo(slam_->Grid(), planar_options_.max_grid_cells);
    if (grid.width > 0) context().Publish(planar_options_.grid_channel, GridMessage(utime, grid));
  }
}

Handled PlanarSlamService::OnOdometry(const Event& event) {
  const auto pose = DecodePose(event.data);
  if (!pose) return Handled::kRefused;
  slam_->AddOdometry(pose->utime, ToPose2(pose->pose));
  return Handled::kAccepted;
}

std::string PlanarSlamService::SaveMaps(const std::string& stem) const {
  const std::string error = WriteMapFiles(slam_->Grid(), stem);
  return error.empty() ? SlamService::SaveMaps(stem) : error;
}

}  // namespace lcmslam

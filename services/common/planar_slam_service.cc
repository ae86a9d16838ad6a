#include "common/planar_slam_service.h"

#include <cmath>
#include <cstdlib>

#include <fmt/format.h>
#include <lcmslam/occupancy_grid_t.hpp>
#include <lcmslam/pose_t.hpp>
#include <lcmslam/slam_command_t.hpp>
#include <lcmslam/slam_diagnostics_t.hpp>

#include "bus/messages.h"
#include "geometry/utime.h"
#include "trajectory/write.h"

namespace lcmslam {
namespace {

constexpr int64_t kMapPeriodUs = 1'000'000;

// Whether `period_us` have passed since `last`, or time has jumped back.
bool Due(int64_t utime, int64_t last, int64_t period_us) {
  return last == INT64_MIN || utime < last || UtimeDifference(utime, last) >= period_us;
}

pose_t PoseMessage(const PlanarUpdate& update) {
  pose_t message = ToMessage(StampedPose{update.utime, ToPose3(update.T_map_body)});
  const Eigen::Vector2d velocity = update.T_map_body.rotation() * update.twist_body.head<2>();
  message.vel[0] = velocity.x();
  message.vel[1] = velocity.y();
  message.rotation_rate[2] = update.twist_body.z();
  return message;
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
  if (pose_channel.empty() || diagnostics_channel.empty()) return "channels: pose and diagnostics need names";
  return "";
}

PlanarSlamService::PlanarSlamService(PlanarSlamOptions options, int64_t config_hash, std::unique_ptr<PlanarSlam> slam,
                                     std::string name, ServiceContext& context)
    : options_(std::move(options)),
      config_hash_(config_hash),
      slam_(std::move(slam)),
      name_(std::move(name)),
      context_(context),
      input_(
          options_.lidar_channel, options_.mounting_configured, [this](const Pose2& T) { slam_->SetMounting(T); },
          [this](const PlanarScan& scan) { OnScan(scan); }) {
  context.Subscribe(options_.lidar_channel.empty() ? ".*" : options_.lidar_channel + "(_EXTRINSICS)?",
                    [this](const Event& event) { return input_.Offer(event); });
  if (!options_.odometry_channel.empty())
    context.Subscribe(options_.odometry_channel, [this](const Event& event) { return OnOdometry(event); });
  if (!options_.command_channel.empty())
    context.Subscribe(options_.command_channel, [this](const Event& event) { return OnCommand(event); });
  if (!context.options().out.empty()) {
    trajectory_.open(OutputStem("_tum.txt"));
    if (!trajectory_)
      throw CommandError(ExitCode::kRuntime, fmt::format("{}: cannot be written", OutputStem("_tum.txt").string()));
    context.EverySecond([this](int64_t) { trajectory_.flush(); });
  }
}

std::filesystem::path PlanarSlamService::OutputStem(const std::string& suffix) const {
  return context_.options().out / (name_ + suffix);
}

void PlanarSlamService::OnScan(const PlanarScan& scan) {
  slam_diagnostics_t diagnostics{};
  const PlanarUpdate update = slam_->Process(scan, diagnostics);
  diagnostics.utime = update.utime;
  diagnostics.input_utime = scan.utime;
  diagnostics.sequence = sequence_++;
  diagnostics.config_hash = config_hash_;
  if (!context_.wall_clock()) std::ranges::fill(diagnostics.stage_ms, 0.0F);

  context_.health().NoteInput(input_.channel(), scan.utime);
  if (update.has_pose) {
    context_.Publish(options_.pose_channel, PoseMessage(update));
    if (trajectory_.is_open()) trajectory_ << FormatTum({update.utime, ToPose3(update.T_map_body)});
    last_utime_ = update.utime;
  }
  context_.Publish(options_.diagnostics_channel, diagnostics);
  if (update.has_pose) PublishMaps(update.utime);
}

void PlanarSlamService::PublishMaps(int64_t utime) {
  if (Due(utime, tiles_published_utime_, kMapPeriodUs)) {
    tiles_published_utime_ = utime;
    slam_->PublishMap(context_, utime);
  }
  const auto grid_period_us = static_cast<int64_t>(options_.grid_period_s * 1e6);
  if (grid_period_us > 0 && Due(utime, grid_published_utime_, grid_period_us)) {
    grid_published_utime_ = utime;
    const OccupancyGrid grid = CoarsenedTo(slam_->Grid(), options_.max_grid_cells);
    if (grid.width > 0) context_.Publish(options_.grid_channel, GridMessage(utime, grid));
  }
}

Handled PlanarSlamService::OnOdometry(const Event& event) {
  const auto pose = DecodePose(event.data);
  if (!pose) return Handled::kRefused;
  slam_->AddOdometry(pose->utime, ToPose2(pose->pose));
  return Handled::kAccepted;
}

Handled PlanarSlamService::OnCommand(const Event& event) {
  const auto command = Decode<slam_command_t>(event.data);
  if (!command) return Handled::kRefused;
  if (!command->service.empty() && command->service != name_) return Handled::kIgnored;
  context_.health().SetText(Obey(*command));
  return Handled::kAccepted;
}

// Answers with one line for the status.
std::string PlanarSlamService::Obey(const slam_command_t& command) {
  const auto outcome = [](const std::string& done, const std::string& error) { return error.empty() ? done : error; };
  const std::string stem = command.path.empty() ? OutputStem("_map").string() : command.path;
  switch (command.command) {
    case slam_command_t::SAVE:
      return outcome("saved " + stem, SaveMaps(stem));
    case slam_command_t::LOAD:
      return outcome("loaded " + command.path, slam_->LoadMap(command.path));
    case slam_command_t::RESET:
      slam_->Reset();
      return "reset";
    case slam_command_t::SET_POSE: {
      const Pose3 pose{{command.pos[0], command.pos[1], command.pos[2]},
                       {command.quat[0], command.quat[1], command.quat[2], command.quat[3]}};
      if (!pose.IsFinite() || std::abs(pose.rotation.norm() - 1.0) > 0.01) return "set pose: not a pose";
      slam_->SetPose(ToPose2(pose));
      return "pose set";
    }
    case slam_command_t::LOCALIZE_ONLY:
      slam_->SetLocalizeOnly(true);
      return "localizing only";
    case slam_command_t::MAP_AND_LOCALIZE:
      slam_->SetLocalizeOnly(false);
      return "mapping";
    default:
      return fmt::format("unknown command {}", command.command);
  }
}

std::string PlanarSlamService::SaveMaps(const std::string& stem) const {
  const std::string error = WriteMapFiles(slam_->Grid(), stem);
  return error.empty() ? slam_->SaveMap(stem) : error;
}

void PlanarSlamService::Finish() {
  input_.Flush();
  if (last_utime_ != INT64_MIN) slam_->PublishMap(context_, last_utime_);
  if (!trajectory_.is_open()) return;
  trajectory_.flush();
  const std::string error =
      trajectory_ ? SaveMaps(OutputStem("_map").string()) : OutputStem("_tum.txt").string() + ": cannot be written";
  if (!error.empty()) throw CommandError(ExitCode::kRuntime, error);
}

}  // namespace lcmslam

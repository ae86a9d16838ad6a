#include "common/slam_service.h"

#include <algorithm>

#include <fmt/format.h>
#include <lcmslam/pose_t.hpp>
#include <lcmslam/slam_command_t.hpp>
#include <lcmslam/slam_diagnostics_t.hpp>

#include "bus/messages.h"
#include "geometry/utime.h"
#include "trajectory/write.h"

namespace lcmslam {
namespace {

constexpr int64_t kMapPeriodUs = 1'000'000;

pose_t PoseMessage(const PoseEstimate& estimate) {
  pose_t message = ToMessage(StampedPose{estimate.utime, estimate.T_map_body});
  std::copy_n(estimate.velocity_map.data(), 3, message.vel);
  std::copy_n(estimate.rotation_rate_body.data(), 3, message.rotation_rate);
  return message;
}

}  // namespace

std::string SlamServiceOptions::Validate() const {
  return pose_channel.empty() || diagnostics_channel.empty() ? "channels: pose and diagnostics need names" : "";
}

SlamService::SlamService(SlamServiceOptions options, int64_t config_hash, SlamSystem& slam, std::string name,
                         ServiceContext& context)
    : options_(std::move(options)), config_hash_(config_hash), slam_(slam), name_(std::move(name)), context_(context) {
  if (!options_.command_channel.empty())
    context.Subscribe(options_.command_channel, [this](const Event& event) { return OnCommand(event); });
  if (context.options().out.empty()) return;
  trajectory_.open(OutputStem("_tum.txt"));
  if (!trajectory_)
    throw CommandError(ExitCode::kRuntime, fmt::format("{}: cannot be written", OutputStem("_tum.txt").string()));
  context.EverySecond([this](int64_t) { trajectory_.flush(); });
}

std::filesystem::path SlamService::OutputStem(const std::string& suffix) const {
  return context_.options().out / (name_ + suffix);
}

bool SlamService::Due(int64_t utime, int64_t last, int64_t period_us) {
  return last == INT64_MIN || utime < last || UtimeDifference(utime, last) >= period_us;
}

void SlamService::Report(const std::optional<PoseEstimate>& estimate, int64_t input_utime,
                         slam_diagnostics_t& diagnostics) {
  diagnostics.utime = estimate ? estimate->utime : input_utime;
  diagnostics.input_utime = input_utime;
  diagnostics.sequence = sequence_++;
  diagnostics.config_hash = config_hash_;
  if (!context_.wall_clock()) std::ranges::fill(diagnostics.stage_ms, 0.0F);

  if (estimate) {
    context_.Publish(options_.pose_channel, PoseMessage(*estimate));
    if (trajectory_.is_open()) trajectory_ << FormatTum({estimate->utime, estimate->T_map_body});
    last_utime_ = estimate->utime;
  }
  context_.Publish(options_.diagnostics_channel, diagnostics);
  if (estimate) PublishMaps(estimate->utime);
}

void SlamService::PublishMaps(int64_t utime) {
  if (!Due(utime, map_published_utime_, kMapPeriodUs)) return;
  map_published_utime_ = utime;
  slam_.PublishMap(context_, utime);
}

Handled SlamService::OnCommand(const Event& event) {
  const auto command = Decode<slam_command_t>(event.data);
  if (!command) return Handled::kRefused;
  if (!command->service.empty() && command->service != name_) return Handled::kIgnored;
  context_.health().SetText(Obey(*command));
  return Handled::kAccepted;
}

// Answers with one line for the status.
std::string SlamService::Obey(const slam_command_t& command) {
  const auto outcome = [](const std::string& done, const std::string& error) { return error.empty() ? done : error; };
  const std::string stem = command.path.empty() ? OutputStem("_map").string() : command.path;
  switch (command.command) {
    case slam_command_t::SAVE:
      return outcome("saved " + stem, SaveMaps(stem));
    case slam_command_t::LOAD:
      return outcome("loaded " + command.path, slam_.LoadMap(command.path));
    case slam_command_t::RESET:
      Reset();
      return "reset";
    case slam_command_t::SET_POSE: {
      Pose3 pose{{command.pos[0], command.pos[1], command.pos[2]},
                 {command.quat[0], command.quat[1], command.quat[2], command.quat[3]}};
      if (!pose.IsRigid()) return "set pose: not a pose";
      pose.rotation.normalize();
      SetPose(pose);
      return "pose set";
    }
    case slam_command_t::LOCALIZE_ONLY:
      slam_.SetLocalizeOnly(true);
      return "localizing only";
    case slam_command_t::MAP_AND_LOCALIZE:
      slam_.SetLocalizeOnly(false);
      return "mapping";
    default:
      return fmt::format("unknown command {}", command.command);
  }
}

void SlamService::Finish() {
  Flush();
  if (last_utime_ != INT64_MIN) slam_.PublishMap(context_, last_utime_);
  if (!trajectory_.is_open()) return;
  trajectory_.flush();
  const std::string error =
      trajectory_ ? SaveMaps(OutputStem("_map").string()) : OutputStem("_tum.txt").string() + ": cannot be written";
  if (!error.empty()) throw CommandError(ExitCode::kRuntime, error);
}

}  // namespace lcmslam

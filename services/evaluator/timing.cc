#include "evaluator/timing.h"

#include <algorithm>
#include <numeric>

#include <lcmslam/service_status_t.hpp>
#include <lcmslam/slam_diagnostics_t.hpp>

#include "evaluator/evaluation.pb.h"
#include "evaluator/result.h"
#include "trajectory/summary.h"

namespace lcmslam {
namespace {

// "SDF2D" of "SDF2D_POSE" and the suffix "_POSE"; "" when the channel does not end so.
std::string PrefixBefore(const std::string& suffix, const std::string& channel) {
  return channel.ends_with(suffix) ? channel.substr(0, channel.size() - suffix.size()) : "";
}

}  // namespace

void TimingCollector::Add(const Event& event) {
  if (const std::string prefix = PrefixBefore("_DIAGNOSTICS", event.channel); !prefix.empty()) {
    const auto diagnostics = Decode<slam_diagnostics_t>(event.data);
    if (!diagnostics) return;
    const auto& stages = diagnostics->stage_ms;
    const double step_ms = std::accumulate(stages.begin(), stages.end(), 0.0);
    if (!(step_ms > 0.0)) return;
    System& system = systems_[prefix];
    system.step_ms.push_back(step_ms);
    system.iterations.push_back(diagnostics->iterations);
    for (size_t i = 0; i < stages.size(); ++i) system.stages_ms[diagnostics->stage_name[i]].push_back(stages[i]);
  } else if (const std::string service = PrefixBefore("_SLAM_STATUS", event.channel); !service.empty()) {
    const auto status = Decode<service_status_t>(event.data);
    if (!status || !(status->latency_p50_ms > 0.0F)) return;
    systems_[service].latency_p50_ms.push_back(status->latency_p50_ms);
    systems_[service].latency_p99_ms.push_back(status->latency_p99_ms);
  }
}

bool TimingCollector::Report(const std::string& pose_channel, result::Timing& message) const {
  const auto entry = systems_.find(PrefixBefore("_POSE", pose_channel));
  if (entry == systems_.end()) return false;
  const System& system = entry->second;
  if (!system.step_ms.empty()) *message.mutable_step_ms() = ToMessage(Summarize(system.step_ms));
  if (!system.iterations.empty()) *message.mutable_iterations() = ToMessage(Summarize(system.iterations));
  for (const auto& [name, ms] : system.stages_ms) {
    result::Timing::Stage& stage = *message.add_stages();
    stage.set_name(name);
    *stage.mutable_ms() = ToMessage(Summarize(ms));
  }
  if (!system.latency_p50_ms.empty()) {
    message.set_latency_p50_ms(Percentile(system.latency_p50_ms, 0.5));
    message.set_latency_p99_ms(*std::ranges::max_element(system.latency_p99_ms));
  }
  return true;
}

}  // namespace lcmslam

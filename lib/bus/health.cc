#include "bus/health.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

#include <fmt/format.h>
#include <lcmslam/service_status_t.hpp>
#include <unistd.h>

#include "geometry/utime.h"

namespace lcmslam {
namespace {

double ResidentMegabytes() {
  std::ifstream statm("/proc/self/statm");
  int64_t total = 0, resident = 0;
  statm >> total >> resident;
  return static_cast<double>(resident * sysconf(_SC_PAGESIZE)) / 1e6;
}

// Datagrams this host has dropped since it started because a socket's buffer was full (RcvbufErrors of /proc/net/snmp);
// 0 where unknown.
int64_t KernelDroppedDatagrams() {
  std::ifstream snmp("/proc/net/snmp");
  std::string names, values;
  while (std::getline(snmp, names) && std::getline(snmp, values)) {
    if (!names.starts_with("Udp:")) continue;
    std::istringstream name(names), value(values);
    for (std::string n, v; name >> n && value >> v;) {
      if (n == "RcvbufErrors") return std::stoll(v);
    }
  }
  return 0;
}

// The q-quantile by nearest rank; `values` sorted.
float Quantile(const std::vector<double>& values, double q) {
  if (values.empty()) return 0.0F;
  const auto rank = static_cast<size_t>(std::ceil(q * static_cast<double>(values.size())));
  return static_cast<float>(values[std::max<size_t>(rank, 1) - 1]);
}

}  // namespace

Health::Health(std::string name) : name_(std::move(name)), kernel_dropped_before_(KernelDroppedDatagrams()) {}

int64_t GapCounter::Missing(int64_t utime) {
  const int64_t step_us = UtimeDifference(utime, last_utime_);
  const bool first = !started_;
  started_ = true;
  last_utime_ = utime;
  if (first || step_us <= 0) return 0;
  int64_t missing = 0;
  const size_t known = std::min(seen_, kWindow);
  if (known >= 5) {
    std::array<int64_t, kWindow> sorted = periods_us_;
    std::sort(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(known));
    const auto period_us = static_cast<double>(sorted[known / 2]);
    missing = std::max<int64_t>(0, std::llround(static_cast<double>(step_us) / period_us) - 1);
  }
  periods_us_[seen_++ % kWindow] = step_us;
  return missing;
}

void Health::CountMissing(std::string_view channel, int64_t messages) {
  if (messages == 0) return;
  missing_ += messages;
  auto missing = missing_on_.find(channel);
  if (missing == missing_on_.end()) missing = missing_on_.emplace(std::string(channel), 0).first;
  missing->second += messages;
}

void Health::NoteInput(std::string_view channel, int64_t utime) {
  Input& input = InputOf(channel);
  CountMissing(channel, input.gap.Missing(utime));
  NoteStamp(input, utime);
}

void Health::NoteStamp(int64_t utime) { NoteStamp(InputOf(""), utime); }

Health::Input& Health::InputOf(std::string_view channel) {
  auto input = inputs_.find(channel);
  if (input == inputs_.end()) input = inputs_.emplace(std::string(channel), Input()).first;
  return input->second;
}

void Health::NoteStamp(Input& input, int64_t utime) {
  input_utime_ = utime;
  input.pace.Note(utime, arrival_utime_, now_utime_);
}

void Health::BeginEvent(int64_t arrival_utime, int64_t now_utime) {
  arrival_utime_ = arrival_utime;
  now_utime_ = now_utime;
}

void Health::NoteLatency(double latency_ms, double busy_ms) {
  latencies_ms_.push_back(latency_ms);
  busy_ms_ += busy_ms;
}

// Silence of all inputs, else of those that come the first that is slow or fast.
InputPaceReport Health::ReportPace(int64_t now_utime) {
  InputPaceReport noteworthy, least_silent;
  size_t silent = 0;
  for (auto& [channel, input] : inputs_) {
    const InputPaceReport report = input.pace.Report(now_utime);
    if (report.silent_s > 0.0) {
      if (silent == 0 || report.silent_s < least_silent.silent_s) least_silent = report;
      ++silent;
    } else if ((report.IsSlow() || report.IsFast()) && !(noteworthy.IsSlow() || noteworthy.IsFast())) {
      noteworthy = report;
    }
  }
  return silent == inputs_.size() ? least_silent : noteworthy;
}

int8_t Health::State() const {
  if (processed_ == 0 || pace_report_.silent_s > 0.0) return service_status_t::WAITING;
  const bool lost = dropped_ + refused_ + missing_ > reported_loss_;
  return lost || pace_report_.IsSlow() ? service_status_t::DEGRADED : service_status_t::OK;
}

std::string Health::MissingByChannel() const {
  std::string list;
  for (const auto& [channel, missing] : missing_on_) {
    list += fmt::format("{}{} missing on {}", list.empty() ? "" : ", ", missing, channel);
  }
  return list;
}

std::string Health::PaceComplaint() const {
  const InputPaceReport& input = pace_report_;
  if (input.silent_s > 0.0) return fmt::format("no input for {:.1f} s", input.silent_s);
  if (input.IsSlow()) return fmt::format("input at {:.2f} of real time, {:.1f} Hz", input.pace, input.rate_hz);
  if (input.IsFast()) return fmt::format("input at {:.1f} times real time, {:.0f} Hz", input.pace, input.rate_hz);
  return "";
}

std::string Health::Complaint() const {
  const std::string pace = PaceComplaint(), missing = MissingByChannel();
  return pace.empty() || missing.empty() ? pace + missing : pace + ", " + missing;
}

service_status_t Health::Report(int64_t utime, bool wall_clock) {
  if (wall_clock) pace_report_ = ReportPace(utime);
  service_status_t status{};
  status.utime = utime;
  status.input_utime = input_utime_;
  status.received = received_;
  status.processed = processed_;
  status.dropped = dropped_;
  status.refused = refused_;
  status.missing = missing_;
  status.state = State();
  status.name = name_;
  const std::string complaint = Complaint();
  status.text = text_.empty() || complaint.empty() ? text_ + complaint : complaint + "; " + text_;
  if (wall_clock) {
    std::ranges::sort(latencies_ms_);
    status.latency_p50_ms = Quantile(latencies_ms_, 0.50);
    status.latency_p95_ms = Quantile(latencies_ms_, 0.95);
    status.latency_p99_ms = Quantile(latencies_ms_, 0.99);
    const double input_ms = static_cast<double>(UtimeDifference(input_utime_, reported_input_utime_)) / 1e3;
    const bool comparable = reported_input_utime_ > 0 && input_ms > 0.0 && busy_ms_ > 0.0;
    status.real_time_factor = comparable ? static_cast<float>(input_ms / busy_ms_) : 0.0F;
    status.rss_mb = static_cast<float>(ResidentMegabytes());
    status.kernel_dropped = KernelDroppedDatagrams() - kernel_dropped_before_;
  }
  reported_loss_ = dropped_ + refused_ + missing_;
  reported_input_utime_ = input_utime_;
  latencies_ms_.clear();
  busy_ms_ = 0.0;
  return status;
}

std::string Health::Summary() const {
  std::string line = fmt::format("{}: {} received, {} processed", name_, received_, processed_);
  if (dropped_ > 0) line += fmt::format(", {} dropped", dropped_);
  if (refused_ > 0) line += fmt::format(", {} refused", refused_);
  if (missing_ > 0) line += ", " + MissingByChannel();
  return text_.empty() ? line : line + "; " + text_;
}

}  // namespace lcmslam

#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "bus/input_pace.h"

namespace lcmslam {

class service_status_t;

// Notices from the stamps of one channel that a sender skipped messages: a step of k median periods means k - 1
// missing.
class GapCounter {
 public:
  // The number of messages that should have come between the last stamp and this one.
  int64_t Missing(int64_t utime);

 private:
  static constexpr size_t kWindow = 15;
  std::array<int64_t, kWindow> periods_us_{};
  size_t seen_ = 0;
  int64_t last_utime_ = 0;
  bool started_ = false;
};

// The counters behind service_status_t. One thread; the live runner adds what its receiving thread dropped.
class Health {
 public:
  explicit Health(std::string name);

  void CountReceived() { ++received_; }
  void CountProcessed() { ++processed_; }
  void CountRefused() { ++refused_; }
  void CountMissing(std::string_view channel, int64_t messages);
  void SetDropped(int64_t messages) { dropped_ = messages; }
  // An event that arrived at `arrival_utime` is now being handled; wall clock. Inputs noted until the next one came
  // with it.
  void BeginEvent(int64_t arrival_utime, int64_t now_utime);
  // A periodic input was accepted: looks for gaps, remembers the stamp.
  void NoteInput(std::string_view channel, int64_t utime);
  // The same for an input whose gaps are counted elsewhere.
  void NoteStamp(int64_t utime);
  void NoteLatency(double latency_ms, double busy_ms);
  void SetText(std::string text) { text_ = std::move(text); }

  int64_t received() const { return received_; }
  int64_t processed() const { return processed_; }
  int64_t refused() const { return refused_; }
  int64_t missing() const { return missing_; }
  int64_t dropped() const { return dropped_; }

  // The status of the second that ends now; starts the next one. Without wall clock all that differs between two runs
  // over the same input (latencies, memory, the kernel's counters) stays 0.
  service_status_t Report(int64_t utime, bool wall_clock);
  // One line for people: counts, and what was lost.
  std::string Summary() const;

 private:
  // Of one channel, or of all whose gaps are counted elsewhere.
  struct Input {
    GapCounter gap;
    InputPace pace;
  };

  Input& InputOf(std::string_view channel);
  void NoteStamp(Input& input, int64_t utime);
  InputPaceReport ReportPace(int64_t now_utime);
  int8_t State() const;
  // What State() is about, for people: "4 missing on LIDAR_2D"; empty when there is nothing to say.
  std::string Complaint() const;
  std::string PaceComplaint() const;
  std::string MissingByChannel() const;

  std::string name_;
  std::string text_;
  int64_t kernel_dropped_before_;  // this service started
  int64_t received_ = 0, processed_ = 0, dropped_ = 0, refused_ = 0, missing_ = 0;
  int64_t reported_loss_ = 0;
  int64_t input_utime_ = 0, reported_input_utime_ = 0;
  int64_t arrival_utime_ = 0, now_utime_ = 0;  // of the event in hand
  InputPaceReport pace_report_;
  double busy_ms_ = 0.0;
  std::vector<double> latencies_ms_;
  std::map<std::string, Input, std::less<>> inputs_;        // by channel; those without a name under ""
  std::map<std::string, int64_t, std::less<>> missing_on_;  // by channel; only where some are
};

}  // namespace lcmslam

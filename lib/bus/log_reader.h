#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "bus/wire.h"

namespace lcmslam {

// One message with where and when it was heard.
struct Event {
  int64_t utime = 0;  // us; log time, or time of arrival when live
  std::string channel;
  std::vector<uint8_t> data;
};

// Reads an LCM log event by event. Unlike lcm-logplayer it finds the next event behind damage, and counts what it
// skipped. Throws CommandError (kBadInput) when the file cannot be opened or holds no event at all. One thread.
class LogReader {
 public:
  explicit LogReader(const std::filesystem::path& path);

  // False at the end.
  bool Next(Event& event);

  uint64_t size_bytes() const { return size_bytes_; }
  uint64_t position_bytes() const { return position_; }
  // Bytes in the middle of the file that belong to no event.
  uint64_t damaged_bytes() const { return damaged_bytes_; }
  // Bytes of a last event that was cut off, as a killed logger leaves it.
  uint64_t cut_bytes() const { return cut_bytes_; }
  // "" or one line that says what is wrong with the file so far.
  std::string DamageReport() const;

 private:
  bool ReadEventHere(Event& event);
  bool LengthIsDamaged(const Event& event, uint64_t end);
  void Resynchronize();

  std::filesystem::path path_;
  std::ifstream file_;
  uint64_t size_bytes_ = 0;
  uint64_t position_ = 0;
  uint64_t damaged_bytes_ = 0;
  uint64_t first_damage_ = 0;
  uint64_t cut_bytes_ = 0;
  bool any_event_ = false;
};

}  // namespace lcmslam

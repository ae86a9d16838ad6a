#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <string>

#include "bus/wire.h"

namespace lcmslam {

// Writes an LCM log. Throws CommandError (kRuntime) when the file cannot be made or written. One thread.
class LogWriter {
 public:
  explicit LogWriter(const std::filesystem::path& path);
  ~LogWriter();
  LogWriter(const LogWriter&) = delete;
  LogWriter& operator=(const LogWriter&) = delete;

  void Write(int64_t utime, const std::string& channel, Bytes data);
  template <LcmMessage M>
  void Write(int64_t utime, const std::string& channel, const M& message) {
    Write(utime, channel, Bytes(Encode(message)));
  }
  // Hands what was written to the operating system, so that it survives the death of this process.
  void Flush();

 private:
  std::filesystem::path path_;
  std::FILE* file_;
  int64_t event_number_ = 0;
};

}  // namespace lcmslam

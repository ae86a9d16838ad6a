#include "bus/log_writer.h"

#include <array>
#include <cerrno>
#include <cstring>

#include <fmt/format.h>

#include "bus/errors.h"

namespace lcmslam {
namespace {

[[noreturn]] void Fail(const std::filesystem::path& path) {
  throw CommandError(ExitCode::kRuntime, fmt::format("{}: {}", path.string(), std::strerror(errno)));
}

template <class T>
char* PutBigEndian(char* out, T value) {
  for (size_t i = sizeof(T); i-- > 0;) *out++ = static_cast<char>(static_cast<uint64_t>(value) >> (8 * i));
  return out;
}

}  // namespace

// Not lcm::LogFile: it reports neither a full disk nor when bytes have left the process.
LogWriter::LogWriter(const std::filesystem::path& path) : path_(path), file_(std::fopen(path.c_str(), "wb")) {
  if (file_ == nullptr) Fail(path);
}

LogWriter::~LogWriter() { std::fclose(file_); }

void LogWriter::Write(int64_t utime, const std::string& channel, Bytes data) {
  std::array<char, 28> header;
  char* out = PutBigEndian(header.data(), uint32_t{0xEDA1DA01});
  out = PutBigEndian(out, event_number_++);
  out = PutBigEndian(out, utime);
  out = PutBigEndian(out, static_cast<int32_t>(channel.size()));
  PutBigEndian(out, static_cast<int32_t>(data.size()));
  const bool written = std::fwrite(header.data(), header.size(), 1, file_) == 1 &&
                       std::fwrite(channel.data(), 1, channel.size(), file_) == channel.size() &&
                       std::fwrite(data.data(), 1, data.size(), file_) == data.size();
  if (!written) Fail(path_);
}

void LogWriter::Flush() {
  if (std::fflush(file_) != 0) Fail(path_);
}

}  // namespace lcmslam

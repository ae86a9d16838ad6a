#include "bus/log_reader.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "bus/errors.h"
#include "bus/lcm_log.h"

namespace lcmslam {
namespace {

constexpr size_t kHeaderBytes = 28;
constexpr size_t kMaxChannelBytes = 256;

uint64_t BigEndian(const char* bytes, size_t size) {
  uint64_t value = 0;
  for (size_t i = 0; i < size; ++i) value = value << 8 | static_cast<uint8_t>(bytes[i]);
  return value;
}

}  // namespace

LogReader::LogReader(const std::filesystem::path& path) : path_(path), file_(path, std::ios::binary) {
  std::error_code error;
  size_bytes_ = std::filesystem::file_size(path, error);
  if (error || !file_) throw CommandError(ExitCode::kBadInput, fmt::format("{}: cannot be read", path.string()));
}

bool LogReader::Next(Event& event) {
  while (position_ < size_bytes_) {
    if (ReadEventHere(event)) {
      any_event_ = true;
      return true;
    }
    Resynchronize();
  }
  if (!any_event_)
    throw CommandError(ExitCode::kBadInput,
                       fmt::format("{}: not an LCM log (no event in {} bytes)", path_.string(), size_bytes_));
  return false;
}

bool LogReader::ReadEventHere(Event& event) {
  std::array<char, kHeaderBytes> header;
  file_.clear();
  file_.seekg(static_cast<std::streamoff>(position_));
  if (!file_.read(header.data(), header.size())) return false;
  if (!std::equal(kLcmLogSync.begin(), kLcmLogSync.end(), header.begin())) return false;
  const uint64_t channel_bytes = BigEndian(&header[20], 4);
  const uint64_t data_bytes = BigEndian(&header[24], 4);
  if (channel_bytes == 0 || channel_bytes > kMaxChannelBytes || data_bytes > size_bytes_) return false;
  const uint64_t end = position_ + kHeaderBytes + channel_bytes + data_bytes;
  if (end > size_bytes_) return false;
  event.utime = static_cast<int64_t>(BigEndian(&header[12], 8));
  event.channel.resize(channel_bytes);
  event.data.resize(data_bytes);
  file_.read(event.channel.data(), static_cast<std::streamsize>(channel_bytes));
  file_.read(reinterpret_cast<char*>(event.data.data()), static_cast<std::streamsize>(data_bytes));
  if (!file_ || LengthIsDamaged(event, end)) return false;
  position_ = end;
  return true;
}

// A length that is too large leads to a place where no event starts, and swallows events whole.
bool LogReader::LengthIsDamaged(const Event& event, uint64_t end) {
  std::array<char, kLcmLogSync.size()> next;
  if (end == size_bytes_ || (file_.read(next.data(), next.size()) && next == kLcmLogSync)) return false;
  return !std::ranges::search(event.data, kLcmLogSync, {}, [](uint8_t byte) { return static_cast<char>(byte); }).empty();
}

// Moves to the next sync word behind the present position.
void LogReader::Resynchronize() {
  const uint64_t start = position_;
  uint64_t search = start + 1;
  std::array<char, 1 << 16> buffer;
  while (search + kLcmLogSync.size() <= size_bytes_) {
    file_.clear();
    file_.seekg(static_cast<std::streamoff>(search));
    file_.read(buffer.data(), buffer.size());
    const std::string_view window(buffer.data(), static_cast<size_t>(file_.gcount()));
    const size_t found = window.find(std::string_view(kLcmLogSync.data(), kLcmLogSync.size()));
    if (found != std::string_view::npos) {
      position_ = search + found;
      if (damaged_bytes_ == 0) first_damage_ = start;
      damaged_bytes_ += position_ - start;
      return;
    }
    if (window.size() < kLcmLogSync.size()) break;
    search += window.size() - (kLcmLogSync.size() - 1);
  }
  cut_bytes_ = size_bytes_ - start;
  position_ = size_bytes_;
}

std::string LogReader::DamageReport() const {
  std::string report;
  if (damaged_bytes_ > 0)
    report = fmt::format("{}: {} damaged bytes skipped, the first at offset {}", path_.string(), damaged_bytes_,
                         first_damage_);
  if (cut_bytes_ > 0) {
    report += report.empty() ? fmt::format("{}: ", path_.string()) : std::string("; ");
    report += fmt::format("the last event is cut off ({} bytes)", cut_bytes_);
  }
  return report;
}

}  // namespace lcmslam

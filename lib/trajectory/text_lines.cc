#include "trajectory/text_lines.h"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>

#include <fmt/format.h>

namespace lcmslam {
namespace {

constexpr size_t kMaxLineBytes = 65536;  // longer "lines" are binary rubbish
constexpr size_t kBlockBytes = 1 << 20;  // read at once

bool IsSeparator(char c) { return c == ' ' || c == '\t' || c == ',' || c == '\r'; }

void Split(std::string_view line, std::vector<std::string_view>& fields) {
  fields.clear();
  for (auto begin = std::ranges::find_if_not(line, IsSeparator); begin != line.end();) {
    const auto end = std::find_if(begin, line.end(), IsSeparator);
    fields.emplace_back(begin, end);
    begin = std::find_if_not(end, line.end(), IsSeparator);
  }
}

std::string_view WithoutPlus(std::string_view text) {
  return text.size() > 1 && text[0] == '+' && text[1] != '-' ? text.substr(1) : text;
}

bool IsDigit(char c) { return c >= '0' && c <= '9'; }

}  // namespace

TextLines::TextLines(const std::filesystem::path& path) : path_(path), block_(kBlockBytes), buffer_(kMaxLineBytes) {
  file_.rdbuf()->pubsetbuf(block_.data(), static_cast<std::streamsize>(block_.size()));  // before it is opened
  file_.open(path, std::ios::binary);
  if (!file_) error_ = fmt::format("{}: cannot open: {}", path_.string(), std::strerror(errno));
}

bool TextLines::Next() {
  if (!error_.empty()) return false;
  while (file_.getline(buffer_.data(), static_cast<std::streamsize>(buffer_.size()))) {
    ++number_;
    const auto end_of_line = file_.eof() ? 0 : 1;
    line_ = {buffer_.data(), static_cast<size_t>(file_.gcount() - end_of_line)};
    Split(line_, fields_);
    if (!fields_.empty() && !fields_.front().starts_with('#')) return true;
  }
  if (file_.eof()) return false;
  ++number_;
  error_ = file_.gcount() > 0 ? Complain("line too long: not a text file") : path_.string() + ": cannot read";
  return false;
}

size_t TextLines::EstimateCount() {
  std::error_code failed;
  const auto file_bytes = std::filesystem::file_size(path_, failed);
  if (failed || !file_) return 0;
  file_.read(buffer_.data(), static_cast<std::streamsize>(buffer_.size()));
  const auto read_bytes = static_cast<size_t>(file_.gcount());
  file_.clear();
  file_.seekg(0);
  const auto read_lines = static_cast<size_t>(std::count(buffer_.begin(), buffer_.begin() + file_.gcount(), '\n'));
  return read_bytes == 0 ? 0
                         : static_cast<size_t>(1.05 * static_cast<double>(read_lines) * file_bytes / read_bytes) + 1;
}

std::string TextLines::Complain(const std::string& reason) const {
  return fmt::format("{}:{}: {}", path_.string(), number_, reason);
}

std::optional<int64_t> ParseSecondsAsMicroseconds(std::string_view text) {
  text = WithoutPlus(text);
  if (text.find_first_of("eE") != std::string_view::npos) {
    const auto seconds = ParseFinite(text);
    if (!seconds || std::abs(*seconds) > 9e12) return std::nullopt;
    const double whole_s = std::floor(*seconds);  // apart, so that no digit of a large stamp is lost
    return std::llround(whole_s) * 1'000'000 + std::llround((*seconds - whole_s) * 1e6);
  }
  const bool negative = text.starts_with('-');
  if (negative) text.remove_prefix(1);
  const size_t point = std::min(text.find('.'), text.size());
  const std::string_view whole = text.substr(0, point);
  const std::string_view fraction = text.substr(std::min(point + 1, text.size()));
  if (whole.empty() && fraction.empty()) return std::nullopt;
  int64_t us = 0;
  for (const char c : whole) {
    if (!IsDigit(c) || us > INT64_MAX / 10 - 10) return std::nullopt;
    us = us * 10 + (c - '0');
  }
  if (us > INT64_MAX / 1'000'000 - 1) return std::nullopt;
  us *= 1'000'000;
  for (int64_t digit_us = 100'000; const char c : fraction) {
    if (!IsDigit(c)) return std::nullopt;
    us += digit_us * (c - '0');
    digit_us /= 10;
  }
  if (fraction.size() > 6 && fraction[6] >= '5') ++us;
  return negative ? -us : us;
}

std::optional<double> ParseFinite(std::string_view text) {
  text = WithoutPlus(text);
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

std::string Quote(std::string_view text) {
  std::string shown;
  for (const char c : text.substr(0, 24)) shown += c >= ' ' && c <= '~' ? c : '?';
  return fmt::format("'{}{}'", shown, text.size() > 24 ? "..." : "");
}

}  // namespace lcmslam

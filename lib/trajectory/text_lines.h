#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace lcmslam {

// The lines of a text file that carry data: blank lines and # comments are passed over. One thread.
class TextLines {
 public:
  explicit TextLines(const std::filesystem::path& path);

  // Moves to the next line with data; false at the end of the file or when it cannot be read.
  bool Next();
  // Fields of the current line, split at blanks, tabs and commas.
  std::span<const std::string_view> fields() const { return fields_; }
  bool has_comma() const { return line_.find(',') != std::string_view::npos; }
  int64_t number() const { return number_; }  // of the current line, from 1

  // About how many lines the file has, from its size and its first lines; 0 when unknown.
  size_t EstimateCount();

  // "" or "FILE: cannot open: REASON" after Next() returned false.
  const std::string& error() const { return error_; }
  // "FILE:LINE: reason".
  std::string Complain(const std::string& reason) const;

 private:
  std::filesystem::path path_;
  std::vector<char> block_;  // of the file, as read from the disk
  std::ifstream file_;
  std::vector<char> buffer_;  // one line
  std::string_view line_;     // in buffer_
  std::vector<std::string_view> fields_;
  int64_t number_ = 0;
  std::string error_;
};

// Decimal seconds as microseconds, rounded half away from zero; exact for plain decimals of any length, as exact as a
// double for numbers with an exponent. None for anything that is not a finite number or beyond int64.
[[nodiscard]] std::optional<int64_t> ParseSecondsAsMicroseconds(std::string_view text);

// None for anything that is not a finite number as a whole.
[[nodiscard]] std::optional<double> ParseFinite(std::string_view text);

// The text in quotes, short and printable whatever it holds, for error messages.
[[nodiscard]] std::string Quote(std::string_view text);

}  // namespace lcmslam

#pragma once

#include <algorithm>
#include <charconv>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "sensors/bad_input.h"

namespace lcmslam {

// The words of a line, parted by spaces and tabs.
inline std::vector<std::string_view> SplitWords(std::string_view line) {
  constexpr std::string_view kSpace = " \t\r";
  std::vector<std::string_view> words;
  for (size_t begin = line.find_first_not_of(kSpace); begin != std::string_view::npos;) {
    const size_t end = std::min(line.find_first_of(kSpace, begin), line.size());
    words.push_back(line.substr(begin, end - begin));
    begin = line.find_first_not_of(kSpace, end);
  }
  return words;
}

// The whole word as a number; throws BadInput.
template <class Number>
Number ParseNumber(std::string_view word) {
  Number value{};
  const char* end = word.data() + word.size();
  const auto [stop, error] = std::from_chars(word.data(), end, value);
  if (error != std::errc() || stop != end) throw BadInput(fmt::format("'{}' is not a number", word));
  return value;
}

// Takes text line by line.
class LineReader {
 public:
  explicit LineReader(std::string_view text) : rest_(text) {}

  // False at the end. `line` is without its end of line.
  bool Next(std::string_view& line) {
    if (rest_.empty()) return false;
    const size_t end = rest_.find('\n');
    line = rest_.substr(0, end);
    rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
    ++number_;
    return true;
  }

  int number() const { return number_; }           // of the line last taken, from 1
  std::string_view rest() const { return rest_; }  // behind it

 private:
  std::string_view rest_;
  int number_ = 0;
};

}  // namespace lcmslam

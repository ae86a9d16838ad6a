#pragma once

#include <string>
#include <vector>

namespace lcmslam::report {

// A table of text; numbers stand in it as they are shown, units in the header.
struct Table {
  std::string name;     // of the CSV file
  std::string caption;  // what stands above it, with units and what was counted
  std::vector<std::string> header;
  std::vector<std::vector<std::string>> rows;
  size_t text_columns = 1;  // the first ones are text, the others numbers
};

std::string ToHtml(const Table& table);
std::string ToCsv(const Table& table);
// Caption and aligned columns.
std::string ToText(const Table& table);

// & < > " as entities.
std::string EscapeHtml(std::string_view text);

}  // namespace lcmslam::report

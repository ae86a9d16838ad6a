#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "evaluator/report/study.h"

namespace lcmslam::report {

struct PageOptions {
  std::string title;
  std::string note;                             // below the title
  std::string command;                          // as it was typed
  std::vector<std::filesystem::path> pictures;  // SVG, shown too
  std::filesystem::path file;                   // the page; pictures and tables go one by one to STEM_files/ beside it
};

// Writes the report: one HTML file that needs nothing else. Throws CommandError.
void WritePage(const Study& study, const PageOptions& options);

}  // namespace lcmslam::report

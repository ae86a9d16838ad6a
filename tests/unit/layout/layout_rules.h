#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace lcmslam {

// The house rules that can be read off file names and #include lines.

// Why `file` must not include `included`; "" when it may. `file` is relative to the project ("lib/lidar/sweep.cc");
// `included` keeps its delimiters ("<cmath>"): quotes are for the project's own files, brackets for all others.
std::string WhyForbidden(std::string_view file, std::string_view included);

// "FILE:LINE: reason" for each forbidden #include of lib/, services/ and replay/ below `root`, in order.
std::vector<std::string> ForbiddenIncludes(const std::filesystem::path& root);

// Names at the top of `root` that have no place there, in order. Dot-files and build and result folders are passed
// over.
std::vector<std::string> ForeignTopLevelEntries(const std::filesystem::path& root);

}  // namespace lcmslam

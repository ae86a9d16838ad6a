#include "unit/layout/layout_rules.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <regex>
#include <set>

namespace lcmslam {
namespace {

namespace fs = std::filesystem;

// The folders of lib/ in order. A folder may include the one it builds on and all that stands above that.
struct LibFolder {
  std::string_view name;
  std::string_view builds_on;
};
constexpr std::array<LibFolder, 10> kLibFolders{{
    {"geometry", ""},
    {"lidar", "geometry"},
    {"sensors", "lidar"},
    {"sdf2d", "lidar"},
    {"octo3d", "lidar"},
    {"baselines", "lidar"},
    {"refine", "geometry"},
    {"trajectory", "geometry"},
    {"simulation", "lidar"},
    {"bus", "lidar"},
}};

// External headers that only some areas may see. An area is a folder of lib/ ("lib/bus") or another top folder.
struct Guarded {
  const char* what;
  std::regex header;
  std::set<std::string> areas;
};
const std::vector<Guarded>& GuardedHeaders() {
  static const std::vector<Guarded> guarded{
      {"LCM and its messages", std::regex("lcm/.*|lcmslam/.*"), {"lib/bus", "services", "replay"}},
      {"Protobuf", std::regex("google/protobuf/.*|.*\\.pb\\.h"), {"services", "replay"}},
      {"the clock", std::regex("chrono|ctime|time\\.h|sys/time\\.h"), {"lib/bus", "services", "replay"}},
      {"the standard streams", std::regex("iostream"), {"services", "replay"}},
      {"a logger", std::regex("spdlog/.*|glog/.*"), {"services", "replay"}},
      {"libpcap", std::regex("pcap.*"), {"lib/sensors"}},
      {"ROS", std::regex("(rosbag|ros|tf|tf2|[a-z]+_msgs)/.*"), {"lib/sensors"}},
      {"OctoMap", std::regex("octomap/.*|octomath/.*"), {"lib/octo3d"}},
      {"nanoflann", std::regex("nanoflann.*"), {"lib/baselines", "lib/trajectory"}},
      {"Embree", std::regex("embree3/.*"), {"lib/simulation"}},
      {"Ceres", std::regex("ceres/.*"), {"lib/refine", "lib/trajectory"}},
  };
  return guarded;
}

size_t Rank(std::string_view lib_folder) {
  const auto* at = std::find_if(kLibFolders.begin(), kLibFolders.end(), [&](auto& f) { return f.name == lib_folder; });
  return static_cast<size_t>(at - kLibFolders.begin());
}

bool IsLibFolder(std::string_view folder) { return Rank(folder) < kLibFolders.size(); }

bool LibMaySee(const std::string& folder, const std::string& other) {
  if (other == folder) return true;
  const std::string_view builds_on = kLibFolders[Rank(folder)].builds_on;
  return IsLibFolder(builds_on) && Rank(other) <= Rank(builds_on);
}

// services/common is the command line and configuration that all services share.
bool ServiceMaySee(const std::string& folder, const std::string& other) {
  return other == folder || other == "common" || IsLibFolder(other);
}

std::string WhyForbiddenFolder(const std::string& top, const std::string& folder, const std::string& other) {
  if (top == "lib" && !IsLibFolder(folder)) return "lib/" + folder + " is not in the table of lib folders";
  const bool allowed = top == "lib" ? LibMaySee(folder, other) : ServiceMaySee(folder, other);
  return allowed ? "" : top + "/" + folder + " must not include " + other + "/";
}

std::string WhyForbiddenHeader(const std::string& area, const std::string& header) {
  for (const Guarded& guarded : GuardedHeaders()) {
    if (std::regex_match(header, guarded.header) && !guarded.areas.contains(area))
      return area + " must not see " + guarded.what;
  }
  return "";
}

bool IsSource(const fs::path& file) {
  static const std::set<std::string> extensions{".h", ".hpp", ".cc", ".cpp"};
  return extensions.contains(file.extension().string());
}

void CheckFile(const fs::path& root, const fs::path& file, std::vector<std::string>& found) {
  static const std::regex include(R"(\s*#\s*include\s*(<[^>]+>|"[^"]+").*)");
  const std::string name = file.lexically_relative(root).generic_string();
  std::ifstream lines(file);
  std::smatch match;
  int number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    if (!std::regex_match(line, match, include)) continue;
    const std::string why = WhyForbidden(name, match[1].str());
    if (!why.empty()) found.push_back(name + ":" + std::to_string(number) + ": " + why);
  }
}

}  // namespace

std::string WhyForbidden(std::string_view file, std::string_view included) {
  const fs::path path(file);
  const std::vector<std::string> place(path.begin(), path.end());
  const std::string top = place.at(0), folder = place.size() > 2 ? place[1] : "";
  const std::string target(included.substr(1, included.size() - 2));
  const std::string area = top == "lib" ? top + "/" + folder : top;
  const std::string why = WhyForbiddenHeader(area, target);
  if (!why.empty() || included.front() == '<') return why;
  const size_t slash = target.find('/');
  return WhyForbiddenFolder(top, folder, slash == std::string::npos ? folder : target.substr(0, slash));
}

std::vector<std::string> ForbiddenIncludes(const fs::path& root) {
  std::vector<fs::path> files;
  for (const char* top : {"lib", "services", "replay"}) {
    if (!fs::exists(root / top)) continue;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(root / top)) {
      if (entry.is_regular_file() && IsSource(entry.path())) files.push_back(entry.path());
    }
  }
  std::sort(files.begin(), files.end());
  std::vector<std::string> found;
  for (const fs::path& file : files) CheckFile(root, file, found);
  return found;
}

std::vector<std::string> ForeignTopLevelEntries(const fs::path& root) {
  static const std::set<std::string> allowed{"CMakeLists.txt", "README.md", "LICENSE", "lcmtypes", "lib",
                                             "services",       "replay",    "tests"};
  std::vector<std::string> foreign;
  for (const fs::directory_entry& entry : fs::directory_iterator(root)) {
    const std::string name = entry.path().filename().string();
    const bool ignored_by_git = name.starts_with(".") || name.starts_with("build") || name.starts_with("out");
    if (!ignored_by_git && !allowed.contains(name)) foreign.push_back(name);
  }
  std::sort(foreign.begin(), foreign.end());
  return foreign;
}

}  // namespace lcmslam

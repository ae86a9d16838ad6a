#pragma once

#include <atomic>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include <unistd.h>

namespace lcmslam {

// A file in the system's temporary folder that goes with this object.
class TemporaryFile {
 public:
  explicit TemporaryFile(std::string_view bytes = {}, const std::string& suffix = "") {
    static std::atomic<int> count = 0;
    path_ = std::filesystem::temp_directory_path() /
            ("lcmslam_" + std::to_string(getpid()) + "_" + std::to_string(count++) + suffix);
    std::ofstream(path_, std::ios::binary) << bytes;
  }
  ~TemporaryFile() {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace lcmslam

#pragma once

#include <atomic>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include <unistd.h>

namespace lcmslam {

// A name in the system's temporary folder that no other test uses, in this process or one beside it; what stands there
// goes with this object.
class TemporaryPath {
 public:
  TemporaryPath(const TemporaryPath&) = delete;
  TemporaryPath& operator=(const TemporaryPath&) = delete;

  const std::filesystem::path& path() const { return path_; }

 protected:
  explicit TemporaryPath(const std::string& suffix) {
    static std::atomic<int> count = 0;
    path_ = std::filesystem::temp_directory_path() /
            ("lcmslam_" + std::to_string(getpid()) + "_" + std::to_string(count++) + suffix);
  }
  ~TemporaryPath() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }

 private:
  std::filesystem::path path_;
};

class TemporaryFile : public TemporaryPath {
 public:
  explicit TemporaryFile(std::string_view bytes = {}, const std::string& suffix = "") : TemporaryPath(suffix) {
    std::ofstream(path(), std::ios::binary) << bytes;
  }
};

class TemporaryFolder : public TemporaryPath {
 public:
  TemporaryFolder() : TemporaryPath("") { std::filesystem::create_directories(path()); }
};

}  // namespace lcmslam

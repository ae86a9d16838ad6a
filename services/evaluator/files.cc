#include "evaluator/files.h"

#include <fstream>
#include <sstream>

#include <fmt/format.h>

#include "bus/errors.h"

namespace lcmslam {

void WriteFile(const std::filesystem::path& path, std::string_view bytes) {
  std::ofstream file(path, std::ios::binary);
  file << bytes;
  if (!file.flush()) throw CommandError(ExitCode::kRuntime, fmt::format("{}: cannot be written", path.string()));
}

std::string ReadFile(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::stringstream bytes;
  bytes << file.rdbuf();
  if (!file || std::filesystem::is_directory(path))
    throw CommandError(ExitCode::kBadInput, fmt::format("{}: cannot be read", path.string()));
  return bytes.str();
}

}  // namespace lcmslam

#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace lcmslam {

// Writes a file or throws CommandError (kRuntime).
void WriteFile(const std::filesystem::path& path, std::string_view bytes);
// The bytes of a file; CommandError (kBadInput) when it cannot be read.
[[nodiscard]] std::string ReadFile(const std::filesystem::path& path);

}  // namespace lcmslam

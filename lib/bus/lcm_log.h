#pragma once

#include <array>
#include <filesystem>

namespace lcmslam {

// Every event of an LCM log begins with these bytes.
inline constexpr std::array<char, 4> kLcmLogSync = {'\xED', '\xA1', '\xDA', '\x01'};

// Whether a file begins with an event of an LCM log. Not so when it cannot be read.
[[nodiscard]] bool BeginsAsLcmLog(const std::filesystem::path& path);

}  // namespace lcmslam

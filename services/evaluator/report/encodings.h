#pragma once

#include <string>
#include <string_view>

namespace lcmslam::report {

// In hexadecimal.
std::string Sha256(std::string_view bytes);

std::string Base64(std::string_view bytes);

}  // namespace lcmslam::report

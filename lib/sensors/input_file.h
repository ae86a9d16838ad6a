#pragma once

#include <filesystem>
#include <istream>
#include <memory>
#include <string>

namespace lcmslam {

// The bytes of a file; gzip and bzip2 are recognized by their first bytes and unpacked on the way. Throws BadInput when
// the file cannot be opened; damaged compression ends in boost::iostreams errors, which derive from
// std::ios_base::failure, thrown while reading.
[[nodiscard]] std::unique_ptr<std::istream> OpenInput(const std::filesystem::path& path);

// All of it at once. Throws BadInput when it cannot be read or unpacked.
[[nodiscard]] std::string ReadInput(const std::filesystem::path& path);

}  // namespace lcmslam

#include "sensors/input_file.h"

#include <array>
#include <fstream>
#include <iterator>
#include <string_view>

#include <boost/iostreams/filter/bzip2.hpp>
#include <boost/iostreams/filter/gzip.hpp>
#include <boost/iostreams/filtering_stream.hpp>
#include <fmt/format.h>

#include "sensors/bad_input.h"

namespace lcmslam {
namespace {

namespace io = boost::iostreams;

// A filtering stream reads from the file, so the file has to live as long.
class FilteredFile : public io::filtering_istream {
 public:
  template <class Filter>
  FilteredFile(std::unique_ptr<std::ifstream> file, const Filter& filter) : file_(std::move(file)) {
    push(filter);
    push(*file_);
    exceptions(std::ios::badbit);  // otherwise damage looks like the end
  }
  ~FilteredFile() override {
    exceptions(std::ios::goodbit);
    reset();
  }

 private:
  std::unique_ptr<std::ifstream> file_;
};

}  // namespace

std::unique_ptr<std::istream> OpenInput(const std::filesystem::path& path) {
  auto file = std::make_unique<std::ifstream>(path, std::ios::binary);
  if (!*file || std::filesystem::is_directory(path)) throw BadInput(fmt::format("{}: cannot be read", path.string()));
  std::array<char, 3> start{};
  file->read(start.data(), start.size());
  file->clear();
  file->seekg(0);
  const std::string_view magic(start.data(), start.size());
  if (magic.starts_with("\x1f\x8b")) return std::make_unique<FilteredFile>(std::move(file), io::gzip_decompressor());
  if (magic == "BZh") return std::make_unique<FilteredFile>(std::move(file), io::bzip2_decompressor());
  return file;
}

std::string ReadInput(const std::filesystem::path& path) {
  const std::unique_ptr<std::istream> input = OpenInput(path);
  try {
    return {std::istreambuf_iterator<char>(*input), {}};
  } catch (const std::ios_base::failure& error) {
    throw BadInput(fmt::format("{}: damaged: {}", path.string(), error.what()));
  }
}

}  // namespace lcmslam

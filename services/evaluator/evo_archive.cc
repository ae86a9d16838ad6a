#include "evaluator/evo_archive.h"

#include <bit>
#include <cstring>
#include <map>
#include <memory>
#include <string>

#include <fmt/format.h>
#include <google/protobuf/struct.pb.h>
#include <google/protobuf/util/json_util.h>
#include <zip.h>

#include "bus/errors.h"
#include "evaluator/evaluation.pb.h"
#include "trajectory/write.h"

namespace lcmslam {
namespace {

using Entries = std::map<std::string, std::string>;  // contents by name
using Values = std::vector<double>;

google::protobuf::Value JsonValue(const std::string& text) {
  google::protobuf::Value value;
  value.set_string_value(text);
  return value;
}

google::protobuf::Value JsonValue(double number) {
  google::protobuf::Value value;
  value.set_number_value(number);
  return value;
}

// Member by member: the fields of a Protobuf Struct come in another order in every run.
std::string ToJson(const std::map<std::string, google::protobuf::Value>& object) {
  std::string members;
  for (const auto& [key, value] : object) {
    std::string json;
    (void)google::protobuf::util::MessageToJsonString(value, &json);
    members += fmt::format("{}\"{}\":{}", members.empty() ? "" : ",", key, json);
  }
  return "{" + members + "}";
}

std::string InfoJson(const Evaluation& evaluation, const result::Evaluation& message) {
  const std::string alignment(Name(evaluation.alignment.kind));
  return ToJson({{"title", JsonValue("APE w.r.t. translation part (m)\n(alignment: " + alignment + ", no scale)")},
                 {"label", JsonValue("APE (m)")},
                 {"ref_name", JsonValue(message.reference().name())},
                 {"est_name", JsonValue(message.estimate().name())}});
}

std::string StatsJson(const Summary& s) {
  return ToJson({{"rmse", JsonValue(s.rmse)},
                 {"mean", JsonValue(s.mean)},
                 {"median", JsonValue(s.median)},
                 {"std", JsonValue(s.sd)},
                 {"min", JsonValue(s.min)},
                 {"max", JsonValue(s.max)},
                 {"sse", JsonValue(s.rmse * s.rmse * static_cast<double>(s.count))}});
}

// NumPy's format 1.0: magic, length of the header, header padded to 64 bytes, little-endian doubles.
std::string Npy(const Values& values) {
  static_assert(std::endian::native == std::endian::little);
  constexpr size_t kMagicBytes = 10, kAlignment = 64;
  std::string header = fmt::format("{{'descr': '<f8', 'fortran_order': False, 'shape': ({},), }}", values.size());
  header.append(kAlignment - 1 - (kMagicBytes + header.size()) % kAlignment, ' ');
  header += '\n';
  std::string npy("\x93NUMPY\x01\x00", 8);
  npy += static_cast<char>(header.size() & 0xff);
  npy += static_cast<char>(header.size() >> 8);
  npy += header;
  const size_t data = npy.size();
  npy.resize(data + values.size() * sizeof(double));
  if (!values.empty()) std::memcpy(npy.data() + data, values.data(), values.size() * sizeof(double));
  return npy;
}

void AddArrays(const Evaluation& evaluation, Entries& entries) {
  const std::vector<PosePair>& pairs = evaluation.association.pairs;
  Values timestamps_s, since_start_s;
  for (const PosePair& pair : pairs) {
    timestamps_s.push_back(static_cast<double>(pair.utime) * 1e-6);
    since_start_s.push_back(static_cast<double>(pair.utime - pairs.front().utime) * 1e-6);
  }
  entries["error_array.npy"] = Npy(evaluation.absolute_errors.translation_m);
  entries["timestamps.npy"] = Npy(timestamps_s);
  entries["seconds_from_start.npy"] = Npy(since_start_s);
  entries["distances_from_start.npy"] = Npy(PathLengths(pairs));
  entries["distances.npy"] = Npy(PathLengths(pairs, &PosePair::estimate));
}

void AddTrajectories(const Evaluation& evaluation, Entries& entries) {
  std::string &estimate = entries["estimate.tum"], &reference = entries["reference.tum"];
  for (const PosePair& pair : evaluation.association.pairs) {
    estimate += FormatTum({pair.utime, pair.estimate});
    reference += FormatTum({pair.utime, pair.reference});
  }
}

[[noreturn]] void Fail(const std::filesystem::path& path, const char* reason) {
  throw CommandError(ExitCode::kRuntime, fmt::format("{}: cannot write: {}", path.string(), reason));
}

// `entries` must outlive the call: libzip reads them when it closes the archive.
void WriteZip(const Entries& entries, const std::filesystem::path& path) {
  constexpr uint16_t kDosDate = (1 << 5) | 1, kDosTime = 0;  // 1980-01-01, so that the bytes do not tell the day
  int code = 0;
  std::unique_ptr<zip_t, decltype(&zip_discard)> archive(zip_open(path.c_str(), ZIP_CREATE | ZIP_TRUNCATE, &code),
                                                         zip_discard);
  if (!archive) {
    zip_error_t error;
    zip_error_init_with_code(&error, code);
    const std::string reason = zip_error_strerror(&error);
    zip_error_fini(&error);
    Fail(path, reason.c_str());
  }
  for (const auto& [name, bytes] : entries) {
    zip_source_t* source = zip_source_buffer(archive.get(), bytes.data(), bytes.size(), /*freep=*/0);
    const zip_int64_t index = source == nullptr ? -1 : zip_file_add(archive.get(), name.c_str(), source, 0);
    if (index < 0) {
      zip_source_free(source);
      Fail(path, zip_strerror(archive.get()));
    }
    zip_file_set_dostime(archive.get(), static_cast<zip_uint64_t>(index), kDosTime, kDosDate, 0);
  }
  if (zip_close(archive.get()) != 0) Fail(path, zip_strerror(archive.get()));
  (void)archive.release();  // closed and gone
}

}  // namespace

void WriteEvoArchive(const Evaluation& evaluation, const result::Evaluation& message,
                     const std::filesystem::path& path) {
  Entries entries = {{"info.json", InfoJson(evaluation, message)},
                     {"stats.json", StatsJson(evaluation.absolute.translation_m)}};
  AddArrays(evaluation, entries);
  AddTrajectories(evaluation, entries);
  WriteZip(entries, path);
}

}  // namespace lcmslam

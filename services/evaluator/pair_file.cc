#include "evaluator/pair_file.h"

#include <algorithm>
#include <array>
#include <bit>

namespace lcmslam {
namespace {

// utime, then position and quaternion of both sides.
using Record = std::array<double, 15>;

Record ToRecord(const PosePair& pair) {
  Record record = {std::bit_cast<double>(pair.utime)};
  double* next = record.data() + 1;
  for (const Pose3* pose : {&pair.estimate, &pair.reference}) {
    next = std::copy_n(pose->translation.data(), 3, next);
    next = std::copy_n(pose->rotation.coeffs().data(), 4, next);
  }
  return record;
}

PosePair FromRecord(const Record& record) {
  PosePair pair;
  pair.utime = std::bit_cast<int64_t>(record[0]);
  const double* next = record.data() + 1;
  for (Pose3* pose : {&pair.estimate, &pair.reference}) {
    std::copy_n(next, 3, pose->translation.data());
    std::copy_n(next + 3, 4, pose->rotation.coeffs().data());
    next += 7;
  }
  return pair;
}

}  // namespace

PairFile::PairFile() : file_(std::tmpfile()), is_complete_(file_ != nullptr) {}

void PairFile::Add(std::span<const PosePair> pairs) {
  for (const PosePair& pair : pairs) {
    if (!is_complete_) return;
    const Record record = ToRecord(pair);
    is_complete_ = std::fwrite(&record, sizeof record, 1, file_.get()) == 1;
    ++count_;
  }
}

void PairFile::Clear() {
  if (file_ == nullptr) return;
  std::rewind(file_.get());
  count_ = 0;
  is_complete_ = true;
}

std::optional<std::vector<PosePair>> PairFile::ReadAll() {
  if (!is_complete_ || std::fflush(file_.get()) != 0) return std::nullopt;
  std::rewind(file_.get());
  std::vector<PosePair> pairs;
  pairs.reserve(count_);
  for (Record record; pairs.size() < count_;) {
    if (std::fread(&record, sizeof record, 1, file_.get()) != 1) return std::nullopt;
    pairs.push_back(FromRecord(record));
  }
  return pairs;
}

}  // namespace lcmslam

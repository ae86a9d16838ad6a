#include "trajectory/relations.h"

#include <array>

#include <fmt/format.h>

#include "trajectory/text_lines.h"

namespace lcmslam {
namespace {

Eigen::Quaterniond FromRollPitchYaw(double roll, double pitch, double yaw) {
  return Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()) * Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitY()) *
         Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitX());
}

// "" or what is wrong with the fields.
std::string ParseRelation(std::span<const std::string_view> fields, Relation& relation) {
  if (fields.size() != 8) {
    return fmt::format("8 numbers expected (t1 t2 x y z roll pitch yaw), found {}", fields.size());
  }
  std::array<double, 8> v;
  for (size_t i = 0; i < v.size(); ++i) {
    const auto number = ParseFinite(fields[i]);
    if (!number) return fmt::format("not a finite number: {}", Quote(fields[i]));
    v[i] = *number;
  }
  const auto utime1 = ParseSecondsAsMicroseconds(fields[0]);
  const auto utime2 = ParseSecondsAsMicroseconds(fields[1]);
  if (!utime1 || !utime2) return fmt::format("not a stamp in seconds: {}", Quote(fields[utime1 ? 1 : 0]));
  relation = {*utime1, *utime2, {{v[2], v[3], v[4]}, FromRollPitchYaw(v[5], v[6], v[7])}};
  return "";
}

}  // namespace

RelationFile ReadRelations(const std::filesystem::path& path) {
  RelationFile file;
  TextLines lines(path);
  while (lines.Next()) {
    Relation relation;
    const std::string reason = ParseRelation(lines.fields(), relation);
    if (!reason.empty()) return {{}, lines.Complain(reason)};
    file.relations.push_back(relation);
  }
  if (!lines.error().empty()) return {{}, lines.error()};
  if (file.relations.empty()) file.error = fmt::format("{}: no relations", path.string());
  return file;
}

RelationErrors EvaluateRelations(std::span<const StampedPose> estimate, std::span<const Relation> relations,
                                 int64_t max_gap_us) {
  RelationErrors result;
  for (const Relation& relation : relations) {
    const auto T_map_1 = InterpolateAt(estimate, relation.utime1, max_gap_us);
    const auto T_map_2 = InterpolateAt(estimate, relation.utime2, max_gap_us);
    if (T_map_1 && T_map_2) {
      result.errors.Add(relation.T_1_2, T_map_1->inverse() * *T_map_2);
    } else {
      ++result.unmatched;
    }
  }
  return result;
}

}  // namespace lcmslam

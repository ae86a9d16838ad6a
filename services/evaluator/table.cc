#include "evaluator/table.h"

#include <cmath>
#include <iterator>

#include <fmt/format.h>

#include "evaluator/evaluation.pb.h"
#include "geometry/angles.h"

namespace lcmslam {
namespace {

using result::PoseError;
using result::Summary;
using Message = result::Evaluation;
using Text = fmt::memory_buffer;

template <typename... Arguments>
void Print(Text& text, fmt::format_string<Arguments...> format, Arguments&&... arguments) {
  fmt::format_to(std::back_inserter(text), format, std::forward<Arguments>(arguments)...);
}

void PrintSource(Text& text, const char* role, const char* what, const Message::Source& source) {
  Print(text, "{:<12} {}, {} {}", role, source.name(), source.poses(), what);
  if (source.refused() > 0) Print(text, ", {} malformed refused", source.refused());
  if (source.out_of_order() > 0) Print(text, ", {} out of order left out", source.out_of_order());
  Print(text, "\n");
}

void PrintAssociation(Text& text, const Message::Association& a) {
  Print(text, "association  reference interpolated (linear, SLERP) across gaps of up to {} s, time offset {:.6f} s\n",
        a.max_gap_s(), a.time_offset_s());
  Print(text, "             {} matched, {} before the reference, {} after it, {} in gaps: coverage {:.2f} %\n",
        a.matched(), a.before(), a.after(), a.in_gap(), 100.0 * a.coverage());
  Print(text, "             {:.2f} s, path {:.3f} m\n", a.duration_s(), a.path_length_m());
}

// Roll, pitch and yaw in degrees.
void PrintRotation(Text& text, const Message::Pose& p) {
  const double roll = std::atan2(2 * (p.qw() * p.qx() + p.qy() * p.qz()), 1 - 2 * (p.qx() * p.qx() + p.qy() * p.qy()));
  const double pitch = std::asin(std::clamp(2 * (p.qw() * p.qy() - p.qz() * p.qx()), -1.0, 1.0));
  const double yaw = std::atan2(2 * (p.qw() * p.qz() + p.qx() * p.qy()), 1 - 2 * (p.qy() * p.qy() + p.qz() * p.qz()));
  Print(text, "roll {:.3f}, pitch {:.3f}, yaw {:.3f} deg", RadToDeg(roll), RadToDeg(pitch), RadToDeg(yaw));
}

void PrintAlignment(Text& text, const Message::Alignment& a, bool is_joint) {
  const auto& T = a.t_world_map();
  Print(text, "alignment    {}{}, no scale: x {:.4f}, y {:.4f}, z {:.4f} m, ", a.kind(),
        is_joint ? " with calibration" : "", T.x_m(), T.y_m(), T.z_m());
  PrintRotation(text, T);
  Print(text, "\n");
  if (!a.unobservable().empty()) Print(text, "             {}; taken from the orientations\n", a.unobservable());
}

void PrintCalibration(Text& text, const Message::Calibration& c) {
  const auto& marker = c.t_body_marker();
  Print(text, "calibration  time offset {:.5f} s", c.time_offset_s());
  if (c.has_time_offset_sd_s()) Print(text, " (SD {:.5f})", c.time_offset_sd_s());
  Print(text, "\n             lever arm x {:.4f}, y {:.4f}, z {:.4f} m", marker.x_m(), marker.y_m(), marker.z_m());
  if (c.lever_arm_sd_m_size() == 3) {
    Print(text, " (SD {:.4f}, {:.4f}, {:.4f})", c.lever_arm_sd_m(0), c.lever_arm_sd_m(1), c.lever_arm_sd_m(2));
  }
  Print(text, "\n             marker ");
  PrintRotation(text, marker);
  if (c.rotation_sd_rad_size() == 3) {
    Print(text, " (SD {:.3f}, {:.3f}, {:.3f})", RadToDeg(c.rotation_sd_rad(0)), RadToDeg(c.rotation_sd_rad(1)),
          RadToDeg(c.rotation_sd_rad(2)));
  }
  Print(text, "\n");
  if (c.unexcited_size() > 0) {
    Print(text, "             WARNING: the motion does not excite {}\n", fmt::join(c.unexcited(), ", "));
  }
}

void PrintHead(Text& text, const char* what) {
  Print(text, "\n{:<20} {:<6}{:>11}{:>11}{:>11}{:>11}{:>11}{:>11}{:>9}\n", what, "unit", "mean", "RMSE", "median", "SD",
        "p95", "max", "n");
}

void PrintSummary(Text& text, const std::string& name, const char* unit, const Summary& s, int digits) {
  Print(text, "{:<20} {:<6}", name, unit);
  if (!s.has_mean()) {
    Print(text, "{:>66}{:>9}\n", "not enough data", 0);
    return;
  }
  for (const double value : {s.mean(), s.rmse(), s.median(), s.sd(), s.p95(), s.max()}) {
    Print(text, "{:>11.{}f}", value, digits);
  }
  Print(text, "{:>9}\n", s.count());
}

void PrintError(Text& text, const std::string& name, const PoseError& error) {
  PrintSummary(text, name, "m", error.translation_m(), 5);
  if (!error.translation_m().has_mean()) return;
  PrintSummary(text, "", "rad", error.rotation_rad(), 5);
  PrintSummary(text, "", "deg", error.rotation_deg(), 4);
}

void PrintRelations(Text& text, const Message::Relations& r) {
  Print(text, "\nrelations: {} matched, {} without pose\n", r.matched(), r.unmatched());
  const auto print = [&](const char* name, const char* unit, const Summary& s) {
    Print(text, "{:<24} {:<6}{:>12.6f} +- {:.6f}\n", name, unit, s.mean(), s.sd());
  };
  print("translation, absolute", "m", r.error().translation_m());
  print("translation, squared", "m^2", r.squared_translation_m2());
  print("rotation, absolute", "deg", r.error().rotation_deg());
  print("rotation, squared", "deg^2", r.squared_rotation_deg2());
  print("rotation, absolute", "rad", r.error().rotation_rad());
  print("rotation, squared", "rad^2", r.squared_rotation_rad2());
}

void PrintTiming(Text& text, const result::Timing& timing) {
  PrintHead(text, "timing");
  if (timing.has_step_ms()) PrintSummary(text, "one scan", "ms", timing.step_ms(), 3);
  for (const auto& stage : timing.stages()) PrintSummary(text, "  " + stage.name(), "ms", stage.ms(), 3);
  if (timing.has_latency_p50_ms()) {
    Print(text, "latency: median {:.3f} ms, largest p99 of a second {:.3f} ms\n", timing.latency_p50_ms(),
          timing.latency_p99_ms());
  }
}

void PrintThresholds(Text& text, const Message& m) {
  if (m.thresholds_size() > 0) Print(text, "\n");
  for (const auto& t : m.thresholds()) {
    const std::string value = t.has_value() ? fmt::format("{:.6g}", t.value()) : "not measured";
    Print(text, "{} {}: {}, limit {:.6g}\n", t.met() ? "met   " : "MISSED", t.name(), value, t.limit());
  }
}

}  // namespace

std::string FormatTable(const Message& m) {
  Text text;
  PrintSource(text, "estimate", "poses", m.estimate());
  if (m.has_reference()) PrintSource(text, "reference", "poses", m.reference());
  if (m.has_relation_file()) PrintSource(text, "relations", "relations", m.relation_file());
  if (m.has_association()) PrintAssociation(text, m.association());
  if (m.has_alignment()) PrintAlignment(text, m.alignment(), m.has_calibration());
  if (m.has_calibration()) PrintCalibration(text, m.calibration());
  for (const std::string& note : m.notes()) Print(text, "note         {}\n", note);
  if (m.has_absolute()) {
    PrintHead(text, "error");
    PrintError(text, "absolute", m.absolute());
    for (const auto& relative : m.relative()) {
      const std::string step =
          relative.has_step_s() ? fmt::format("{} s", relative.step_s()) : fmt::format("{} m", relative.step_m());
      PrintError(text, "relative over " + step, relative.error());
    }
  }
  if (m.has_kitti()) {
    PrintSummary(text, "KITTI segments", "%", m.kitti().translation_percent(), 4);
    PrintSummary(text, "", "deg/m", m.kitti().rotation_deg_per_m(), 5);
  }
  if (m.has_drift()) {
    Print(text, "drift, first to last pose: {:.6f} m/m, {:.6f} rad/m\n", m.drift().translation_m_per_m(),
          m.drift().rotation_rad_per_m());
  }
  if (m.has_relations()) PrintRelations(text, m.relations());
  if (m.has_timing()) PrintTiming(text, m.timing());
  PrintThresholds(text, m);
  return fmt::to_string(text);
}

}  // namespace lcmslam

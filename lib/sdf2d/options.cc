#include "sdf2d/options.h"

#include <cmath>

namespace lcmslam::sdf2d {
namespace {

// Collects the first complaint.
class Checker {
 public:
  Checker& Positive(const char* field, double value) {
    return Demand(std::isfinite(value) && value > 0.0, field, "must be > 0");
  }
  Checker& NotNegative(const char* field, double value) {
    return Demand(std::isfinite(value) && value >= 0.0, field, "must be >= 0");
  }
  Checker& Fraction(const char* field, double value) {
    return Demand(value >= 0.0 && value <= 1.0, field, "must lie in [0, 1]");
  }
  Checker& Demand(bool good, const char* field, const char* reason) {
    if (!good && complaint_.empty()) complaint_ = std::string(field) + ": " + reason;
    return *this;
  }
  Checker& Part(const char* field, const std::string& complaint) {
    if (!complaint.empty() && complaint_.empty()) complaint_ = std::string(field) + "." + complaint;
    return *this;
  }
  std::string Complaint() const { return complaint_; }

 private:
  std::string complaint_;
};

}  // namespace

std::string NoiseOptions::Validate() const {
  return Checker()
      .NotNegative("constant_m", constant_m)
      .NotNegative("proportional", proportional)
      .Positive("floor_m", floor_m)
      .Complaint();
}

std::string MotionOptions::Validate() const {
  return Checker()
      .Positive("acceleration", acceleration)
      .Positive("angular_acceleration", angular_acceleration)
      .Positive("start_speed", start_speed)
      .Positive("start_turn_rate", start_turn_rate)
      .Positive("start_sigma_m", start_sigma_m)
      .Positive("start_sigma_rad", start_sigma_rad)
      .Positive("max_gap_s", max_gap_s)
      .NotNegative("odometry_slip", odometry_slip)
      .Positive("odometry_sigma_m", odometry_sigma_m)
      .Positive("odometry_sigma_rad", odometry_sigma_rad)
      .NotNegative("max_odometry_gap_s", max_odometry_gap_s)
      .Complaint();
}

std::string RegistrationOptions::Validate() const {
  return Checker()
      .Demand(max_iterations >= 1, "max_iterations", "must be >= 1")
      .Positive("huber_sigmas", huber_sigmas)
      .Demand(inlier_sigmas >= huber_sigmas, "inlier_sigmas", "must be >= huber_sigmas")
      .Positive("map_sigma_m", map_sigma_m)
      .Fraction("min_cos_incidence", min_cos_incidence)
      .NotNegative("shared_sigma_m", shared_sigma_m)
      .NotNegative("shared_length_m", shared_length_m)
      .Demand(independence > 0.0 && independence <= 1.0, "independence", "must lie in (0, 1]")
      .Positive("max_skew_rad", max_skew_rad)
      .Positive("stop_sigmas", stop_sigmas)
      .Fraction("min_eigenvalue", min_eigenvalue)
      .Demand(min_points >= 3, "min_points", "must be >= 3")
      .Complaint();
}

std::string SurfaceOptions::Validate() const {
  return Checker()
      .Positive("split_chi2", split_chi2)
      .Demand(min_beams >= 2, "min_beams", "must be >= 2")
      .Demand(max_incidence_rad > 0.0 && max_incidence_rad < 1.57, "max_incidence_rad", "must lie in (0, 1.57)")
      .Positive("max_gap_m", max_gap_m)
      .NotNegative("max_piece_m", max_piece_m)
      .Complaint();
}

std::string FusionOptions::Validate() const {
  return Checker()
      .Demand(band_cells >= 1.0 && band_cells <= 100.0, "band_cells", "must lie in [1, 100]")
      .NotNegative("band_sigmas", band_sigmas)
      .NotNegative("max_band_m", max_band_m)
      .NotNegative("distance_sigma", distance_sigma)
      .NotNegative("end_sigma", end_sigma)
      .NotNegative("end_cells", end_cells)
      .Positive("sigma_floor_m", sigma_floor_m)
      .Positive("max_information", max_information)
      .Positive("change_sigmas", change_sigmas)
      .NotNegative("change_m", change_m)
      .Fraction("change_keep", change_keep)
      .NotNegative("update_distance_m", update_distance_m)
      .NotNegative("update_angle_rad", update_angle_rad)
      .Demand(carve_every >= 1, "carve_every", "must be >= 1")
      .Fraction("carve_keep", carve_keep)
      .Complaint();
}

std::string RecoveryOptions::Validate() const {
  return Checker()
      .Fraction("min_inlier_ratio", min_inlier_ratio)
      .Fraction("min_overlap", min_overlap)
      .Fraction("min_found_ratio", min_found_ratio)
      .Fraction("suspicious_drop", suspicious_drop)
      .Positive("max_surprise_sigmas", max_surprise_sigmas)
      .NotNegative("max_turn_rate", max_turn_rate)
      .NotNegative("search_m", search_m)
      .NotNegative("search_rad", search_rad)
      .Demand(max_search_m >= search_m, "max_search_m", "must be >= search_m")
      .Demand(patience >= 0, "patience", "must be >= 0")
      .Complaint();
}

std::string Options::Validate() const {
  return Checker()
      .Positive("cell_m", cell_m)
      .Demand(coarse_cell_m > cell_m && std::isfinite(coarse_cell_m), "coarse_cell_m", "must be > cell_m")
      .NotNegative("min_range_m", min_range_m)
      .Demand(max_range_m > min_range_m && std::isfinite(max_range_m), "max_range_m", "must be > min_range_m")
      .Demand(T_body_lidar.IsFinite(), "T_body_lidar", "must be finite")
      .Demand(T_map_body_initial.IsFinite(), "T_map_body_initial", "must be finite")
      .Part("noise", noise.Validate())
      .Part("motion", motion.Validate())
      .Part("registration", registration.Validate())
      .Part("surface", surface.Validate())
      .Part("fusion", fusion.Validate())
      .Part("recovery", recovery.Validate())
      .Complaint();
}

}  // namespace lcmslam::sdf2d

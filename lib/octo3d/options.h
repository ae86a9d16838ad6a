#pragma once

#include <cstdint>
#include <string>

namespace lcmslam::octo3d {

// The surfel octree.
struct MapOptions {
  double leaf_m = 0.2;            // edge of the finest cells
  int levels = 4;                 // depths that hold surfels: leaf_m, 2 leaf_m, ... 2^(levels-1) leaf_m
  double range_noise_m = 0.03;    // standard deviation of one point along its beam
  int min_points = 6;             // fewer points make no surfel
  double max_thickness = 1.4;     // a surfel's spread across its plane, in range_noise_m
  double min_flatness = 3.0;      // variance along the plane over variance across it
  double curvature_per_m = 0.01;  // a cell of edge e is off by curvature_per_m e^2: small cells win when well known
  double refit_growth = 1.2;      // a surfel is fitted anew when its points have multiplied by this
  std::string Validate() const;   // "" or "field: reason"
};

// How a sweep is condensed into the patches that registration aligns.
struct PatchOptions {
  double min_range_m = 0.3;  // nearer points are the carrier itself
  double max_range_m = 120.0;
  double cell_m = 0.3;     // patches are planar pieces of octree cells of this edge ...
  int levels = 3;          // ... or, where those are not planar, of halves of it: cell_m / 2^(levels-1) at last
  int time_slices = 16;    // a patch spans at most this fraction of the sweep's time
  int max_patches = 3000;  // more are thinned evenly
  std::string Validate() const;
};

// Continuous-time point-to-plane registration of one sweep.
struct RegistrationOptions {
  int max_iterations = 12;
  double kernel = 1.0;             // residuals beyond this many standard deviations lose their weight (Geman-McClure)
  double model_error_m = 0.01;     // per patch, uncorrelated between patches: what the map never models
  double step_sigmas = 0.25;       // converged when a step is shorter, in standard deviations of the motion
  double acceleration_mps2 = 0.5;  // expected changes of velocity: the motion prior
  double angular_acceleration_radps2 = 0.5;
  double min_direction_share = 1e-3;  // directions with less of the information are unobservable
  std::string Validate() const;
};

// The search from a rough guess, when registration from the prediction is not believed.
struct CoarseSearchOptions {
  int max_patches = 300;
  int iterations = 25;
  double reach_m = 1.6;  // a patch looks for its surfel about this far away
  std::string Validate() const;
};

// When a registration is believed and what it may do to the map.
struct TrustOptions {
  int min_patches = 60;            // matched patches
  double min_inlier_ratio = 0.75;  // of the patches that met a surfel
  double max_residual = 2.0;       // weighted rms residual over its prediction
  double initial_speed_mps = 0.3;  // standard deviation of the velocity before the first sweep
  double initial_rate_radps = 0.3;
  double set_pose_m = 0.3;  // standard deviations of a pose that was set over an existing map
  double set_pose_rad = 0.1;
  double hint_rotation_rad = 0.005;  // standard deviation of an IMU's rotation between two sweeps
  double hint_translation_m = 0.05;  // and of odometry's translation; its rotation counts as hint_odometry_rad
  double hint_odometry_rad = 0.02;
  double max_gap_s = 1.0;  // after a longer silence the old velocity is forgotten
  std::string Validate() const;
};

struct Options {
  MapOptions map;
  PatchOptions patches;
  RegistrationOptions registration;
  CoarseSearchOptions search;
  TrustOptions trust;
  bool localize_only = false;      // the map stays as it is
  int max_points = 20000;          // of a sweep; more are thinned evenly: they add time, not accuracy
  double update_distance_m = 0.2;  // past its first ten sweeps the map takes one in after so much motion ...
  double update_angle_rad = 0.1;   // ... or so much rotation: a still lidar shows it nothing new
  int threads = 1;                 // 2: another one takes a sweep into the map while the next is prepared
  std::string Validate() const;    // "" or "group.field: reason"
};

}  // namespace lcmslam::octo3d

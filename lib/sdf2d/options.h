#pragma once

#include <string>

#include "geometry/pose2.h"

namespace lcmslam::sdf2d {

// Range noise along a beam: sigma(r)^2 = constant_m^2 + (proportional * r)^2, never below floor_m.
struct NoiseOptions {
  bool estimate = true;       // from the scans themselves; then the two values below are only the first guess
  double constant_m = 0.01;   // m
  double proportional = 0.0;  // m per m
  double floor_m = 0.001;     // m; also what a noise-free simulation gets

  std::string Validate() const;
};

// Constant velocity, disturbed by white acceleration noise; odometry replaces the velocity where it is known.
struct MotionOptions {
  bool predict = true;                // false: every scan starts where the last one ended, as far off as start_sigma
  double acceleration = 1.0;          // m/s^2 held for 0.1 s, one sigma
  double angular_acceleration = 2.0;  // rad/s^2 held for 0.1 s, one sigma
  double start_speed = 1.0;           // m/s, one sigma, when nothing is known
  double start_turn_rate = 1.0;       // rad/s, one sigma, when nothing is known
  double start_sigma_m = 0.3;         // m, one sigma, of a pose given by hand
  double start_sigma_rad = 0.2;       // rad, the same
  double max_gap_s = 1.0;             // a longer pause between scans forgets the velocity
  double odometry_slip = 0.1;         // of the motion (m per m, rad per rad), one sigma
  double odometry_sigma_m = 0.03;     // m per increment, one sigma; stamps that jitter are in it, too
  double odometry_sigma_rad = 0.015;  // rad per increment, one sigma
  double max_odometry_gap_s = 0.25;   // odometry farther from a scan than this is not used for it

  std::string Validate() const;
};

// Gauss-Newton with Levenberg-Marquardt damping on the signed distances of the end points.
struct RegistrationOptions {
  int max_iterations = 12;
  double huber_sigmas = 2.5;       // larger residuals lose weight
  double inlier_sigmas = 3.0;      // residuals below count as inliers
  double map_sigma_m = 0.003;      // m; the map's own error, added to every beam's
  double min_cos_incidence = 0.3;  // grazing beams weigh no more than this one
  // Beams do not err independently: neighbours share errors of the map and of the sensor, which would otherwise pass
  // for certainty.
  double shared_sigma_m = 0.005;  // m; the beams that fall on shared_length_m of surface share an error of this size
  double shared_length_m = 0.1;
  double independence = 0.2;   // of what is left: one beam counts as this part of an independent one
  double max_skew_rad = 0.02;  // a scan skewed by more than this by a wrong velocity is deskewed and registered again
  double stop_sigmas = 1.0;    // stop after a step that is shorter than this part of the pose's own sigma
  double min_eigenvalue = 0.006;  // a direction seen by less than this part of the beams is called unobservable
  int min_points = 20;

  std::string Validate() const;
};

// Splitting the scan into straight pieces of surface.
struct SurfaceOptions {
  double split_chi2 = 24.0;         // a corner must lower the sum of squares (in sigmas) by this much
  int min_beams = 3;                // shorter pieces are not written into the map
  double max_incidence_rad = 1.43;  // pieces seen more obliquely are not written (82 deg)
  double max_gap_m = 0.5;           // no piece spans a larger gap between neighbouring end points
  double max_piece_m = 0.0;         // longer pieces are cut, however straight; 0: never

  std::string Validate() const;
};

// Writing surfaces into the map.
struct FusionOptions {
  double band_cells = 1.6;         // half width of the band around a surface that one scan may write, at least
  double band_sigmas = 3.0;        // ... and at least this many sigmas of the beam
  double max_band_m = 0.3;         // ... and at most
  double distance_sigma = 0.3;     // m per m: uncertainty that grows with the distance to the surface
  double end_sigma = 1.0;          // m per m: ... and with the distance past a piece's end
  double end_cells = 0.5;          // a piece may write this far past its ends
  double sigma_floor_m = 0.001;    // m; no measurement counts as better than this
  double max_information = 1e9;    // 1/m^2; forgets: old evidence weighs no more than this
  double change_sigmas = 4.0;      // a vertex that contradicts by more than this is forgotten ...
  double change_m = 0.06;          // ... if it contradicts by more than this, too
  double change_keep = 0.5;        // ... to this part of its information
  double update_distance_m = 0.0;  // the map is written after the body moved this far ...
  double update_angle_rad = 0.0;   // ... or turned by this; 0: with every scan
  bool carve = true;               // clear what beams pass through
  int carve_every = 8;             // beams; each scan takes the next ones
  double carve_keep = 0.6;         // part of a vertex's information that survives a beam passing through

  std::string Validate() const;
};

// Judging a registration, and finding the way back.
struct RecoveryOptions {
  double min_inlier_ratio = 0.4;  // of the beams that fell on mapped surface
  double min_overlap = 0.25;      // of the beams must fall on mapped surface
  double min_found_ratio = 0.5;   // of all beams must be inliers where the search says it found the pose
  double suspicious_drop = 0.25;  // a fall of the inlier share below its running mean by this starts the coarse level
  double max_surprise_sigmas = 5.0;  // ... and it may not lie farther from the prediction than this
  double max_turn_rate = 5.0;  // rad/s; sudden turns up to this are tried where the prediction does not fit; 0: none
  double search_m = 1.0;       // half width of the correlative search around the prediction
  double search_rad = 0.6;     // ... and in yaw
  double max_search_m = 4.0;   // the window doubles with every scan that stays lost, up to this
  int patience = 50;           // scans lost before mapping starts afresh from the predicted pose; 0: never

  std::string Validate() const;
};

struct Options {
  double cell_m = 0.05;           // distance between map vertices
  double coarse_cell_m = 0.20;    // the same on the coarse level
  double min_range_m = 0.02;      // nearer returns are ignored
  double max_range_m = 79.0;      // farther ones, too
  Pose2 T_body_lidar = {};        // where the lidar sits
  Pose2 T_map_body_initial = {};  // the first scan's pose
  bool deskew = true;             // use each beam's own time
  bool localize_only = false;     // never write into the map
  NoiseOptions noise = {};
  MotionOptions motion = {};
  RegistrationOptions registration = {};
  SurfaceOptions surface = {};
  FusionOptions fusion = {};
  RecoveryOptions recovery = {};

  // "" or "field: reason", parts included.
  std::string Validate() const;
};

}  // namespace lcmslam::sdf2d

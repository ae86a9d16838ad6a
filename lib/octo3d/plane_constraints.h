#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "lidar/pose_table.h"
#include "octo3d/options.h"
#include "octo3d/patches.h"
#include "octo3d/surfel_map.h"
#include "octo3d/sweep_information.h"

namespace lcmslam::octo3d {

// How well the patches lie on their planes. Inlier: residual within 3 standard deviations of a point, or the floor.
struct ConstraintFit {
  int matched = 0;  // patches that met a surfel
  int inliers = 0;
  double squares = 0.0;     // m^2, over the inliers: sum of the squared residuals
  double normalized = 0.0;  // and in standard deviations of a point
};

// The patches of one sweep, each with the plane of the map it is measured against. Keeps a plane until its patch has
// moved on. Single precision, relative to an origin near the lidar: good to micrometres. Not thread-safe.
class PlaneConstraints {
 public:
  // map and patches must outlive the constraints. origin: map frame, within about 100 m of the lidar.
  PlaneConstraints(const SurfelMap& map, std::span<const Patch> patches, const RegistrationOptions& options,
                   const Eigen::Vector3d& origin);

  // Linearizes all constraints at these poses. Weight: information of the patch's height times Geman-McClure of the
  // residual, whose kernel is wider by kernel_floor_m than the noise asks for.
  ConstraintFit AddTo(SweepInformation& information, const PoseTable& poses, double kernel_floor_m);

  // How much of the information of the last AddTo() to expect from the noise of the planes' normals alone: the walls of
  // a room, a little tilted each in its own way, seem to tell of height.
  Matrix6 NoiseOfNormals(double kernel_floor_m);

 private:
  // One cache line.
  struct alignas(64) Constraint {
    Eigen::Vector4f plane = Eigen::Vector4f::Zero();          // normal, minus its height over the origin
    Eigen::Vector3f mean = Eigen::Vector3f::Zero();           // of the patch, lidar frame
    Eigen::Vector3f asked = Eigen::Vector3f::Constant(1e9F);  // where the map was asked
    float mean_var = 0.0F;                                    // m^2, of the patch's mean along the beam
    float max_across_var = 0.0F;  // m^2, of the patch's points across a plane that it lies flat on
    float sigma = 0.0F;           // m, of a single point over the plane
    float information = 0.0F;     // 1/m^2, of the patch's height over the plane; 0: no plane
    float tilt_var = 0.0F;        // rad^2, of the plane's normal
    uint16_t slot = 0;
  };
  static_assert(sizeof(Constraint) == 64);

  // Homogeneous, relative to the origin and to the lidar: the fourth component is 1 and 0.
  struct Place {
    Eigen::Vector4f local, lever;
  };
  struct Equation {
    Eigen::Vector4f normal, moment;
    float residual, weight;
    int slot;
  };

  void SetPoses(const PoseTable& poses);
  void Locate(std::span<const Constraint> batch);
  void AssociateMoved(std::span<Constraint> batch, std::span<const Patch> patches);
  void Associate(Constraint& constraint, const Patch& patch, const PlaneMatch& plane) const;
  float Weight(const Constraint& constraint, float residual, float kernel_floor_m) const;
  size_t Linearize(std::span<const Constraint> batch, float kernel_floor_m, ConstraintFit& fit);

  static constexpr size_t kBatch = 64;  // stays in the fastest cache

  const SurfelMap& map_;
  const std::span<const Patch> patches_;
  const Eigen::Vector3d origin_;
  const float kernel_;     // standard deviations
  const float range_var_;  // m^2, of a point along its beam
  const float model_var_;  // m^2
  std::vector<Constraint> constraints_;
  std::vector<Eigen::Matrix4f> T_local_lidar_;  // by time slot; map axes, about the origin

  // Of the batch in hand.
  std::array<Place, kBatch> places_;
  std::array<size_t, kBatch> moved_;  // those to be associated anew, where they are (map frame), what they meet there
  std::array<Eigen::Vector3d, kBatch> asked_;
  std::array<PlaneMatch, kBatch> planes_;
  std::array<Equation, kBatch> equations_;
};

}  // namespace lcmslam::octo3d

#include "common/run_service.h"
#include "sdf2d-slam/sdf2d_slam.h"
#include "sdf2d-slam/sdf2d_slam.pb.h"

int main(int argc, char** argv) {
  return lcmslam::RunService<lcmslam::Sdf2dSlam>(argc, argv, "2D-SDF-SLAM on planar scans");
}

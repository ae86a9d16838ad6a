#include "common/run_service.h"
#include "octo3d-slam/octo3d_slam.h"
#include "octo3d-slam/octo3d_slam.pb.h"

int main(int argc, char** argv) {
  return lcmslam::RunService<lcmslam::Octo3dSlam>(argc, argv, "NOctoSLAM on sweeps of a multi-line lidar");
}

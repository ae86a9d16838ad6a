#include "cloud3d-slam/cloud3d_slam.h"
#include "cloud3d-slam/cloud3d_slam.pb.h"
#include "common/run_service.h"

int main(int argc, char** argv) {
  return lcmslam::RunService<lcmslam::Cloud3dSlam>(argc, argv,
                                                   "point cloud SLAM after libpointmatcher, the baseline of NOctoSLAM");
}

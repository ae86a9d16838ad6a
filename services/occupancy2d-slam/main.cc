#include "common/run_service.h"
#include "occupancy2d-slam/occupancy2d_slam.h"
#include "occupancy2d-slam/occupancy2d_slam.pb.h"

int main(int argc, char** argv) {
  return lcmslam::RunService<lcmslam::Occupancy2dSlam>(argc, argv, "Occupancy grid SLAM on planar scans, the baseline");
}

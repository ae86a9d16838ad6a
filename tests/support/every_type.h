#pragma once

#include <tuple>

#include <lcmslam/evaluation_t.hpp>
#include <lcmslam/imu_t.hpp>
#include <lcmslam/lidar_packet_t.hpp>
#include <lcmslam/occupancy_grid_t.hpp>
#include <lcmslam/planar_lidar_t.hpp>
#include <lcmslam/planar_scan_t.hpp>
#include <lcmslam/point_cloud_chunk_t.hpp>
#include <lcmslam/pose_t.hpp>
#include <lcmslam/pose_xyt_t.hpp>
#include <lcmslam/rigid_transform_t.hpp>
#include <lcmslam/sdf_tile_t.hpp>
#include <lcmslam/service_status_t.hpp>
#include <lcmslam/slam_command_t.hpp>
#include <lcmslam/slam_diagnostics_t.hpp>
#include <lcmslam/surfel_chunk_t.hpp>

namespace lcmslam {

// Every type of lcmtypes, each with its RandomMessage.
using EveryType = std::tuple<planar_scan_t, planar_lidar_t, pose_t, pose_xyt_t, rigid_transform_t, occupancy_grid_t,
                             sdf_tile_t, point_cloud_chunk_t, lidar_packet_t, imu_t, surfel_chunk_t, slam_diagnostics_t,
                             slam_command_t, service_status_t, evaluation_t>;

}  // namespace lcmslam

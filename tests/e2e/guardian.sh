#!/usr/bin/env bash
# A tracked robot with two cheap lidars on one rigid mount, run separately: both have to tell the same way of the body.
set -euo pipefail
. "$(dirname "$0")/../support/script.sh"
need_data guardian/guardian_3.bag

"$bin/sensor-bridge" import rosbag "$data/guardian/guardian_3.bag" --quiet --log-out guardian.lcm
for lidar in LIDAR_2D LIDAR_2D_SCAN; do
  "$bin/sdf2d-slam" --log-in guardian.lcm --set channels.lidar=$lidar --out $lidar
done
check "front and back agree to 0.10 m mean" \
  "$bin/evaluator" --estimate LIDAR_2D/sdf2d-slam_tum.txt --reference LIDAR_2D_SCAN/sdf2d-slam_tum.txt \
  --max-mean 0.10 --min-coverage 0.95
finish_test

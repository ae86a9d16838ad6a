#!/usr/bin/env bash
# replay/spy on a screen of its own during a live run: it decodes every channel, and each view shows what it is for.
set -euo pipefail
. "$(dirname "$0")/../support/script.sh"
. "$root/replay/support/desktop.sh"
. "$root/replay/support/live_run.sh"
. "$root/tests/support/pictures.sh"
need_desktop

main() {
  claim_bus
  open_desktop
  open_spy spy
  start_run sdf2d-slam demo 300 --speed 2
  wait_until sensor-bridge has_poses sdf2d-slam 250
  check "spy does as it is told" do_in_spy spy table "open SDF2D_MAP map" "wheel map_near" "drag map_aside" close \
    "open SDF2D_SLAM_STATUS health" close "open EVALUATION error" close
  check_channels spy LIDAR_2D LIDAR_2D_EXTRINSICS GROUND_TRUTH SDF2D_POSE SDF2D_DIAGNOSTICS SDF2D_MAP SLAM_MAP EVALUATION \
    SDF2D_SLAM_STATUS EVALUATOR_STATUS GROUND_TRUTH_LOGGER_STATUS
  check_map
  check_health
  check_error
  finish_test
}

check_map() {
  local truth scan estimate=0072b2
  truth=$(color GROUND_TRUTH) scan=$(color SCAN)
  check "map: free space" at_least "$(pixels count spy/map.png fafafa)" 20000
  check "map: ground truth" at_least "$(pixels count spy/map.png "$truth")" 300
  check "map: estimate" at_least "$(pixels count spy/map.png $estimate)" 300
  check "map: ground truth lies by the estimate" at_least "$(pixels near spy/map.png "$truth" $estimate 12)" 70
  check "map: scan" at_least "$(pixels count spy/map.png "$scan")" 200
  check "map: the scan lies on walls" at_least "$(pixels near spy/map.png "$scan" 262626 8)" 50
  check "the wheel zooms" at_least "$(pixels count spy/map_near.png "$scan")" 200
  check "dragging moves the map" at_least "$(pixels differ spy/map_near.png spy/map_aside.png)" 5000
}

check_health() {
  check "health: all services are well" test "$(pixels rows spy/health.png "$(color GOOD)")" = 4
}

check_error() {
  check "error: mean, over the time so far" at_least "$(pixels wide spy/error.png 0072b2)" 400
  check "error: latest pose" at_least "$(pixels wide spy/error.png cc79a7)" 400
}

main "$@"

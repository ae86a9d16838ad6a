#!/usr/bin/env bash
# lcm-spy's 3D view during a live run of octo3d-slam on a VLP-16: sweep, surfels and way are where they belong, and the mouse
# turns, moves and enlarges them.
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
  start_run octo3d-slam hall10_low 300
  wait_until sensor-bridge has_poses octo3d-slam 60
  check "spy does as it is told" do_in_spy spy table "open OCTO3D_POSE pose" "wheel near" "drag turned" close \
    "open LIDAR_3D sweep" close "open OCTO3D_MAP surfels" close
  check_channels spy LIDAR_3D OCTO3D_POSE OCTO3D_DIAGNOSTICS OCTO3D_MAP OCTO3D_SLAM_STATUS
  check_space
  finish_test
}

check_space() {
  local name
  for name in pose sweep surfels; do
    check "$name: sweep" at_least "$(pixels count spy/$name.png "$(color SCAN)")" 2000
    check "$name: way of the estimate" at_least "$(pixels count spy/$name.png 0072b2)" 40
    check "$name: background around the hall" at_least "$(pixels count spy/$name.png "$(color BACKGROUND)")" 20000
    check "$name: surfels of the floor" at_least "$(pixels count spy/$name.png 96a9c6)" 5000
    check "$name: the sweep lies on surfels" at_least "$(pixels near spy/$name.png "$(color SCAN)" 96a9c6 10)" 30
  done
  check "the wheel zooms" at_least "$(pixels differ spy/pose.png spy/near.png)" 50000
  check "dragging turns" at_least "$(pixels differ spy/near.png spy/turned.png)" 50000
}

main "$@"

#!/usr/bin/env bash
# replay/spy on a screen of its own during a live run: it decodes every channel, and each view shows what it is for.
set -euo pipefail
. "$(dirname "$0")/../support/script.sh"
. "$root/tests/support/desktop.sh"
need_desktop

main() {
  claim_bus
  open_desktop
  open_spy
  start_planar_run
  wait_until sensor-bridge has_poses 250
  check "spy does as it is told" do_in_spy table "open SDF2D_MAP map" "wheel map_near" "drag map_aside" close \
    "open SDF2D_SLAM_STATUS health" close "open EVALUATION error" close
  cp shots/*.png "${LCMSLAM_SHOTS:-shots}/" 2>/dev/null || true
  check_channels
  check_map
  check_health
  check_error
  finish_test
}

start_planar_run() {
  local service
  mkdir out
  for service in ground-truth-logger sdf2d-slam; do
    start "$service" "$service.log" "$bin/$service" --out out --lcm-url "$lcm_url"
    wait_until "$service" says_ready "$service"
  done
  start evaluator evaluator.log "$bin/evaluator" --estimate SDF2D_POSE --lcm-url "$lcm_url"
  wait_until evaluator says_ready evaluator
  start sensor-bridge sensor-bridge.log "$bin/sensor-bridge" simulate --episode "$root/replay/episodes/demo.pbtxt" \
    --set duration_s=300 --speed 2 --lcm-url "$lcm_url" --quiet
}

has_poses() { [[ -e out/sdf2d-slam_tum.txt && $(wc -l <out/sdf2d-slam_tum.txt) -ge $1 ]]; }

check_channels() {
  local channel
  for channel in LIDAR_2D LIDAR_2D_EXTRINSICS GROUND_TRUTH SDF2D_POSE SDF2D_DIAGNOSTICS SDF2D_MAP SLAM_MAP EVALUATION \
    SDF2D_SLAM_STATUS EVALUATOR_STATUS GROUND_TRUTH_LOGGER_STATUS; do
    check "$channel is listed" grep -P "^$channel\t" shots/channels.tsv
  done
  # LCM_SELF_TEST is text that LCM sends to itself.
  # shellcheck disable=SC2016  # for awk to expand
  check "all are decoded" awk -F '\t' '{ print } $1 != "LCM_SELF_TEST" && $NF != 0 { bad = 1 } END { exit bad }' shots/channels.tsv
}

check_map() {
  local truth scan estimate=cc79a7
  truth=$(color GROUND_TRUTH) scan=$(color SCAN)
  check "map: free space" at_least "$(pixels count shots/map.png fafafa)" 20000
  check "map: ground truth" at_least "$(pixels count shots/map.png "$truth")" 300
  check "map: estimate" at_least "$(pixels count shots/map.png $estimate)" 300
  check "map: ground truth lies by the estimate" at_least "$(pixels near shots/map.png "$truth" $estimate 12)" 70
  check "map: scan" at_least "$(pixels count shots/map.png "$scan")" 200
  check "map: the scan lies on walls" at_least "$(pixels near shots/map.png "$scan" 262626 8)" 50
  check "the wheel zooms" at_least "$(pixels count shots/map_near.png "$scan")" 200
  check "dragging moves the map" at_least "$(pixels differ shots/map_near.png shots/map_aside.png)" 5000
}

check_health() {
  check "health: all services are well" test "$(pixels rows shots/health.png "$(color GOOD)")" = 4
}

check_error() {
  check "error: mean, over the time so far" at_least "$(pixels wide shots/error.png 0072b2)" 400
  check "error: latest pose" at_least "$(pixels wide shots/error.png cc79a7)" 400
}

at_least() { at_most "$2" "$1"; }

main "$@"

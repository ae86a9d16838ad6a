#!/usr/bin/env bash
# Real multi-line sensors through import, octo3d-slam and evaluator, all by default.
set -euo pipefail
. "$(dirname "$0")/../support/script.sh"
need_data hilti2021_uzh_run2 kitti_raw_0005 packets/einride_vlp16.bin packets/vlp16_gps.pcap

main() {
  hand_held_in_a_hall
  car_on_a_street
  sensor_at_rest
  finish_test
}

# track NAME IMPORT_ARGUMENT...: what the sensor sent, then what the service made of it, as NAME/.
track() {
  local name=$1
  shift
  "$bin/sensor-bridge" import "$@" --quiet --log-out "$name.lcm"
  "$bin/octo3d-slam" --quiet --log-in "$name.lcm" --log-out "$name-run.lcm" --out "$name"
}

hand_held_in_a_hall() {
  track hilti kitti "$data/hilti2021_uzh_run2" --rate 2 --poses "$data/hilti2021_uzh_run2/gt_lidar_kitti.txt"
  "$bin/evaluator" --quiet --log-in hilti-run.lcm --estimate OCTO3D_POSE --reference GROUND_TRUTH --json hilti.json >/dev/null
  check "Hilti: 40 poses judged" jq -e '.association.matched == 40' hilti.json
  check "Hilti: ATE" at_most "$(jq .absolute.translation_m.rmse hilti.json)" 0.018
}

# No truth: at 10 Hz the car moves 0.3 m or so a sweep, ahead, and hardly up.
car_on_a_street() {
  track kitti kitti "$data/kitti_raw_0005" --rate 10 --turn 0.1
  check "KITTI: 8 poses" test "$(wc -l <kitti/octo3d-slam_tum.txt)" = 8
  check "KITTI: ahead with every sweep" goes_ahead
  check "KITTI: on the ground" stays_on_the_ground
}

goes_ahead() { awk 'NR > 1 && !($2 > x + 0.1 && $2 < x + 0.6) { exit 1 } { x = $2 }' kitti/octo3d-slam_tum.txt; }

stays_on_the_ground() { awk '$4 > 0.1 || $4 < -0.1 { exit 1 }' kitti/octo3d-slam_tum.txt; }

sensor_at_rest() {
  stays_where_it_began einride_vlp16.bin 10
  stays_where_it_began vlp16_gps.pcap 3
}

# stays_where_it_began FILE SWEEPS
stays_where_it_began() {
  track rest velodyne "$data/packets/$1"
  check "$1 at rest: poses" test "$(wc -l <rest/octo3d-slam_tum.txt)" -ge "$2"
  check "$1 at rest: drift" at_most "$(largest_distance)" 0.003
}

largest_distance() { awk '{ d = sqrt($2^2 + $3^2 + $4^2) } d > worst { worst = d } END { print worst }' rest/octo3d-slam_tum.txt; }

main "$@"

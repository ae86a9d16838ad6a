#!/usr/bin/env bash
# The baseline of NOctoSLAM through the programs: as accurate as libpointmatcher on a simulated episode and on real scans.
set -euo pipefail
. "$(dirname "$0")/../support/script.sh"

seed=5 # not tuned on

main() {
  "$bin/sensor-bridge" simulate --episode "$root/replay/episodes/hall10_low.pbtxt" --seed $seed --set duration_s=20 --quiet \
    --log-out hall.lcm >/dev/null
  judge hall 0.004 "a furnished hall"
  judge filtered 0.05 "the same at the run time of octo3d-slam" --config "$root/services/cloud3d-slam/cloud3d-slam-filtered.pbtxt"
  finish_test
  need_data hilti2021_uzh_run2
  "$bin/sensor-bridge" import kitti "$data/hilti2021_uzh_run2" --rate 2 --poses "$data/hilti2021_uzh_run2/gt_lidar_kitti.txt" \
    --quiet --log-out hilti.lcm
  judge hilti 0.0225 "Hilti"
  finish_test
}

# judge NAME LIMIT_M DESCRIPTION OPTION...: NAME.lcm, or else hall.lcm.
judge() {
  local name=$1 limit=$2 description=$3 log=hall.lcm
  shift 3
  [[ -e $name.lcm ]] && log=$name.lcm
  "$bin/cloud3d-slam" "$@" --quiet --log-in "$log" --log-out "$name-run.lcm" --out "$name"
  "$bin/evaluator" --quiet --log-in "$name-run.lcm" --estimate CLOUD3D_POSE --reference GROUND_TRUTH --json "$name.json" >/dev/null
  check "$description: every sweep judged" jq -e '.association.coverage >= 0.99' "$name.json"
  check "$description: ATE" at_most "$(jq .absolute.translation_m.rmse "$name.json")" "$limit"
  check "$description: a map" grep -qa '^element vertex [1-9]' "$name/cloud3d-slam_map.ply"
  jq -r --arg name "$name" '"\($name): rmse \(.absolute.translation_m.rmse) m, mean \(.absolute.rotation_rad.mean) rad"' "$name.json"
}

main "$@"

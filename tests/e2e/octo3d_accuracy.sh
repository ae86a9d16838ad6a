#!/usr/bin/env bash
# NOctoSLAM on simulated episodes, through the programs: error against the truth, and no failure under stress.
set -euo pipefail
. "$(dirname "$0")/../support/script.sh"

seed=5 # not tuned on

main() {
  judge hall10_rated_distortion 0.004 0.002
  judge hall10_low 0.0018 0.002
  judge hall10_stress 0.02 0.01
  judge hall10_moving_start 0.03 0.02
  judge corridor40 0.10 0.02
  judge bare_room 0.01 0.005
  finish_test
}

# judge EPISODE LIMIT_M LIMIT_RAD: 30 s of it.
judge() {
  "$bin/sensor-bridge" simulate --episode "$root/replay/episodes/$1.pbtxt" --seed $seed --set duration_s=30 --quiet --log-out "$1.lcm" >/dev/null
  "$bin/octo3d-slam" --quiet --log-in "$1.lcm" --log-out "$1-run.lcm"
  "$bin/evaluator" --quiet --log-in "$1-run.lcm" --estimate OCTO3D_POSE --reference GROUND_TRUTH --json "$1.json" >/dev/null
  rm "$1.lcm" "$1-run.lcm"
  check "$1: every sweep judged" jq -e '.association.coverage >= 0.99' "$1.json"
  check "$1: mean position error" at_most "$(jq .absolute.translation_m.mean "$1.json")" "$2"
  check "$1: mean rotation error" at_most "$(jq .absolute.rotation_rad.mean "$1.json")" "$3"
  jq -r --arg name "$1" '"\($name): mean \(.absolute.translation_m.mean) m, \(.absolute.rotation_rad.mean) rad"' "$1.json"
}

main "$@"

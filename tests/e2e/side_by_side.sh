#!/usr/bin/env bash
# Live runs at the same time do not hear each other, with and without a multicast route.
set -euo pipefail
. "$(dirname "$0")/../support/script.sh"

# Each run gets an episode of its own length, so that a message gone astray changes its counts.
durations=(8 9 10)

main() {
  local seconds pids=()
  for seconds in "${durations[@]}"; do
    "$bin/sensor-bridge" simulate --episode "$root/replay/episodes/room5_low.pbtxt" --seed "$seconds" --set "duration_s=$seconds" \
      --quiet --log-out "$seconds.lcm"
    "$root/replay/run" "$seconds.lcm" --out "$seconds-log"
  done
  for seconds in "${durations[@]}"; do play "$seconds" & pids+=($!); done
  wait "${pids[@]}"
  for seconds in "${durations[@]}"; do
    check "$seconds s: heard its own scans and no others" same_count LIDAR_2D "$seconds"
    check "$seconds s: heard its own poses and no others" same_count SDF2D_POSE "$seconds"
    check "$seconds s: trajectory as when alone" \
      cmp "$seconds-live/latest/sdf2d-slam_tum.txt" "$seconds-log/latest/sdf2d-slam_tum.txt"
  done
  finish_test
}

# The shortest in a namespace without any route, where replay/run has to make its own.
play() {
  local elsewhere=()
  [[ $1 != 8 ]] || elsewhere=(unshare -rn)
  "${elsewhere[@]}" "$root/replay/run" "$1.lcm" --live --speed 2 --out "$1-live"
}

same_count() {
  local live log
  live=$("$bin/log-info" --count "$1" "$2-live/latest/run.lcm")
  log=$("$bin/log-info" --count "$1" "$2-log/latest/run.lcm")
  echo "$1: $live live, $log log to log"
  [[ $live == "$log" && $live -gt 0 ]]
}

main "$@"

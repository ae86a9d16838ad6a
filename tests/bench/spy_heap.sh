#!/usr/bin/env bash
# spy_heap.sh [MINUTES] [SPEED]
#
# What lcm-spy holds on its heap, after a collection, while all our views are open on the data of a VLP-16, of a planar lidar and
# of the services that use them: an hour's, at six times the real rate, by default. One line every five minutes of data. Exit code
# 5: the most of the second half is more than 5 % above the most of the first, in which trails grow as long as they get.
set -euo pipefail
. "$(dirname "$0")/../support/script.sh"
. "$root/replay/support/desktop.sh"
. "$root/replay/support/live_run.sh"

minutes=${1:-60} speed=${2:-6}
readonly interval_s=300 exit_threshold=5

main() {
  local lacking
  lacking=$(desktop_lacks)
  [[ -z $lacking ]] || die "no $lacking"
  claim_bus
  open_desktop
  open_spy spy
  start_sensors
  open_views
  printf '%8s %10s %10s\n' minute 'heap (MB)' 'RSS (MB)'
  watch_heap | tee heap.txt
  judge || exit "$exit_threshold"
}

# The planar lidar comes from a log, without its truth: on this bus there is the other's.
start_sensors() {
  "$bin/sensor-bridge" simulate --episode "$root/replay/episodes/demo.pbtxt" --set "duration_s=$((60 * minutes))" --quiet \
    --log-out planar.lcm >/dev/null
  mkdir planar
  start sdf2d-slam sdf2d-slam.log "$bin/sdf2d-slam" --out planar --lcm-url "$lcm_url"
  wait_until sdf2d-slam says_ready sdf2d-slam
  start_run octo3d-slam hall10_rated_distortion $((60 * minutes)) --speed "$speed"
  start player player.log lcm-logplayer --speed="$speed" --regexp='LIDAR_2D.*' --lcm-url="$lcm_url" planar.lcm
}

open_views() {
  tell_spy spy "open SDF2D_MAP map" "open OCTO3D_MAP space" "open SDF2D_SLAM_STATUS health" "open EVALUATION error" "await end"
  until [[ -e spy/error.png ]]; do
    is_running spy || die "$(cat spy.log)"
    sleep 1
  done
}

watch_heap() {
  local next_s=$interval_s
  while is_running sensor-bridge; do
    sleep 1
    (($(data_s) >= next_s)) || continue
    printf '%8d %10.1f %10.1f\n' $((next_s / 60)) "$(heap_mb)" "$(rss_mb)"
    next_s=$((next_s + interval_s))
  done
}

# Of the last pose but one: the last line may not be whole yet.
data_s() { tail -n 2 out/octo3d-slam_tum.txt | head -n 1 | cut -d . -f 1; }

# A histogram collects before it counts, but not while something is being drawn: then garbage counts too. Hence the least of five.
heap_mb() {
  for _ in {1..5}; do jcmd "${pid_of[spy]}" GC.class_histogram | awk '/^Total/ { print $3 / 1e6 }'; done | sort -g | head -n 1
}
rss_mb() { awk '/^VmRSS/ { print $2 / 1e3 }' "/proc/${pid_of[spy]}/status"; }

judge() {
  awk -v half=$((minutes / 2)) '
    $1 <= half && $2 > first { first = $2 }
    $1 > half && $2 > second { second = $2 }
    END {
      printf "most of the first half %.1f MB, of the second %.1f MB\n", first, second
      exit !(first > 0 && second > 0 && second <= 1.05 * first)
    }' heap.txt
}

main "$@"

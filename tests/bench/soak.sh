#!/usr/bin/env bash
# soak.sh [MINUTES] [planar|both]
#
# Live runs at real rates in a room, half an hour by default: `planar`, a lidar at 20 Hz on sdf2d-slam; `both`, a VLP-16 at 10 Hz on
# octo3d-slam and a planar lidar at 20 Hz on sdf2d-slam, on one bus. Prints for every service its memory after five minutes and
# the most of it later, what it lost, and the 99th percentile of its latency: the median and the worst second; and beside it
# how busy the machine was. Exit code 5: memory grew by more than 5 %, or something was lost.
set -euo pipefail
. "$(dirname "$0")/../support/script.sh"
. "$root/replay/support/live_run.sh"

minutes=${1:-30} lidars=${2:-planar}
readonly warm_up_s=300 exit_threshold=5
readonly at_20_hz=(--set planar.lidar.model.turn_s=0.05)

main() {
  claim_bus
  start logger logger.log lcm-logger --quiet --channel='.*_STATUS' --lcm-url="$lcm_url" statuses.lcm
  wait_until logger listens "${pid_of[logger]}"
  start vmstat load.txt vmstat -n 10
  case $lidars in
    planar) run_planar ;;
    both) run_both ;;
    *) die "$lidars: neither planar nor both" "$exit_usage" ;;
  esac
  stop logger
  kill "${pid_of[vmstat]}"
  "$bin/status_lines" statuses.lcm >statuses.tsv
  awk 'NR > 3 { busy += 100 - $15; ++n } END { printf "machine busy: %.0f %%\n", busy / n }' load.txt
  judge || exit "$exit_threshold"
}

run_planar() {
  start_run sdf2d-slam demo $((60 * minutes)) "${at_20_hz[@]}"
  end_run sdf2d-slam ground-truth-logger evaluator
}

# The planar lidar comes from a log, without its truth: on this bus there is the other's.
run_both() {
  "$bin/sensor-bridge" simulate --episode "$root/replay/episodes/demo.pbtxt" --set "duration_s=$((60 * minutes))" \
    "${at_20_hz[@]}" --quiet --log-out planar.lcm >/dev/null
  mkdir planar
  start sdf2d-slam sdf2d-slam.log "$bin/sdf2d-slam" --set channels.lidar=LIDAR_2D --out planar --lcm-url "$lcm_url"
  wait_until sdf2d-slam says_ready sdf2d-slam
  start_run octo3d-slam hall10_rated_distortion $((60 * minutes))
  start player player.log lcm-logplayer --regexp='LIDAR_2D.*' --lcm-url="$lcm_url" planar.lcm
  finish player
  end_run sdf2d-slam octo3d-slam ground-truth-logger evaluator
}

# end_run SERVICE...: after the sensors.
end_run() {
  local service
  finish sensor-bridge
  for service in "$@"; do
    stop "$service"
    tail -n 1 "$service.log"
  done
}

judge() {
  local services service bad=0
  mapfile -t services < <(cut -f 2 statuses.tsv | sort -u)
  printf '%-20s %8s %8s %7s %9s %8s %8s %8s %10s %10s\n' service 'MB@5min' 'MB later' growth received dropped refused missing 'p99 median' 'p99 worst'
  for service in "${services[@]}"; do judge_service "$service" || bad=1; done
  return "$bad"
}

# judge_service NAME: one line. Its last second, when everything ends, does not count.
judge_service() {
  awk -F '\t' -v name="$1" '$2 == name' statuses.tsv | head -n -1 >service.tsv
  local median worst
  median=$(cut -f 9 service.tsv | sort -g | awk '{ p[NR] = $1 } END { print p[int((NR + 1) / 2)] }')
  worst=$(cut -f 9 service.tsv | sort -g | tail -n 1)
  awk -F '\t' -v warm_up="$warm_up_s" -v median="$median" -v worst="$worst" '
    NR == 1 { start = $1 }
    $1 - start <= warm_up { early = late = $10 }
    $10 > late { late = $10 }
    { received = $4; dropped = $6; refused = $7; missing = $8 }
    END {
      growth = 100 * (late / early - 1)
      printf "%-20s %8.1f %8.1f %5.1f %% %9d %8d %8d %8d %7.2f ms %7.2f ms\n", $2, early, late, growth, received, dropped, refused,
        missing, median, worst
      exit growth > 5 || dropped + refused + missing > 0
    }' service.tsv
}

main "$@"

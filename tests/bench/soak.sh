#!/usr/bin/env bash
# soak.sh [MINUTES] [SYSTEM] [EPISODE]
#
# A simulated robot drives about a room for half an hour at real rates (default: sdf2d-slam on the episode `demo`). Prints for
# every service its memory after five minutes and at the end, what it lost, and the 99th percentile of its latency: the
# median and the worst second. Exit code 5: memory grew by more than 5 %, or something was lost. evaluator, which keeps every
# pose until the end, and the simulator may grow.
set -euo pipefail
. "$(dirname "$0")/../support/script.sh"
. "$root/replay/support/live_run.sh"

minutes=${1:-30} system=${2:-sdf2d-slam} episode=${3:-demo}
readonly warm_up_s=300 exit_threshold=5

main() {
  local service
  claim_bus
  start logger logger.log lcm-logger --quiet --channel='.*_STATUS' --lcm-url="$lcm_url" statuses.lcm
  wait_until logger listens "${pid_of[logger]}"
  start_run "$system" "$episode" $((60 * minutes))
  finish sensor-bridge
  for service in "$system" ground-truth-logger evaluator; do stop "$service"; done
  tail -qn 1 {"$system",ground-truth-logger,evaluator}.log
  stop logger
  "$bin/status_lines" statuses.lcm >statuses.tsv
  judge || exit "$exit_threshold"
}

judge() {
  local services service bad=0
  mapfile -t services < <(cut -f 2 statuses.tsv | sort -u)
  printf '%-20s %8s %8s %7s %9s %8s %8s %8s %10s %10s\n' service 'MB@5min' 'MB@end' growth received dropped refused missing 'p99 median' 'p99 worst'
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
    $1 - start <= warm_up { early = $10 }
    { late = $10; received = $4; dropped = $6; refused = $7; missing = $8 }
    END {
      growth = 100 * (late / early - 1)
      printf "%-20s %8.1f %8.1f %5.1f %% %9d %8d %8d %8d %7.2f ms %7.2f ms\n", $2, early, late, growth, received, dropped, refused,
        missing, median, worst
      may_grow = $2 == "evaluator" || $2 == "sensor-bridge"
      exit (growth > 5 && !may_grow) || dropped + refused + missing > 0
    }' service.tsv
}

main "$@"

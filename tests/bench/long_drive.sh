#!/usr/bin/env bash
# long_drive.sh [MINUTES] [SYSTEM] [EPISODE]
#
# A simulated robot drives about for an hour (default: sdf2d-slam on the episode `room5_low`), log to log. Prints for every ten
# minutes the 99th percentile of a scan's milliseconds (median over seconds) and the memory, and the error of the whole drive:
# both stay flat once the room is known.
set -euo pipefail
. "$(dirname "$0")/../support/script.sh"

minutes=${1:-60} system=${2:-sdf2d-slam} episode=${3:-room5_low}

main() {
  "$bin/sensor-bridge" simulate --quiet --episode "$root/replay/episodes/$episode.pbtxt" --set duration_s=$((60 * minutes)) --seed 1 --log-out in.lcm
  "$bin/$system" --quiet --timings --log-in in.lcm --log-out out.lcm
  "$bin/status_lines" out.lcm >statuses.tsv
  printf '%8s %12s %10s\n' minutes 'p99 [ms]' 'memory [MB]'
  local from
  for ((from = 0; from < minutes; from += 10)); do ten_minutes "$from"; done
  "$bin/evaluator" --log-in out.lcm --estimate "$(pose_channel "$system")" --reference GROUND_TRUTH
}

ten_minutes() {
  awk -F '\t' -v name="$system" -v from="$1" '
    $2 != name { next }
    !start { start = $1 }
    $1 - start >= 60 * from && $1 - start < 60 * (from + 10) { print $9 "\t" $10 }' statuses.tsv | sort -g |
    awk -v from="$1" '{ p99[NR] = $1 } $2 > mb { mb = $2 } END { printf "%8s %12.3f %10.1f\n", from "-" from + 10, p99[int((NR + 1) / 2)], mb }'
}

main "$@"

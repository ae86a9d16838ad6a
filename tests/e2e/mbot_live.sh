#!/usr/bin/env bash
# A student robot's log, played by lcm-logplayer over UDP: every scan is processed, and live equals log to log.
set -euo pipefail
. "$(dirname "$0")/../support/script.sh"
need_data mbot/convex.lcm

"$root/replay/run" "$data/mbot/convex.lcm" --live --speed 4 --out live
"$root/replay/run" "$data/mbot/convex.lcm" --out log
check "459 scans processed" grep -x "sdf2d-slam: 459 received, 459 processed" live/latest/sdf2d-slam.log
check "459 poses" test "$(wc -l <live/latest/sdf2d-slam_tum.txt)" = 459
check "live trajectory equals log to log" cmp live/latest/sdf2d-slam_tum.txt log/latest/sdf2d-slam_tum.txt
check "live map equals log to log" cmp live/latest/sdf2d-slam_map.sdf log/latest/sdf2d-slam_map.sdf
check "results are sealed" env -C live/latest sha256sum --quiet --check --strict SHA256SUMS
finish_test

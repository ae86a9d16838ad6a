#!/usr/bin/env bash
# The same log twice gives the same bytes; played live without loss it gives the same trajectory.
set -euo pipefail
. "$(dirname "$0")/../support/script.sh"

"$bin/sensor-bridge" simulate --episode "$root/replay/episodes/room5_low.pbtxt" --set duration_s=20 --quiet --log-out episode.lcm
for folder in first second; do "$root/replay/run" episode.lcm --out $folder; done
"$root/replay/run" episode.lcm --live --speed 4 --out live
for file in run.lcm sdf2d-slam_tum.txt sdf2d-slam_map.pgm sdf2d-slam_map.sdf ground_truth_000_tum.txt; do
  check "$file twice the same" cmp first/latest/$file second/latest/$file
done
for file in sdf2d-slam_tum.txt sdf2d-slam_map.sdf ground_truth_000_tum.txt; do
  check "$file the same live" cmp first/latest/$file live/latest/$file
done
finish_test

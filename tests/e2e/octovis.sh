#!/usr/bin/env bash
# octovis opens both OctoMap files of octo3d-slam.
set -euo pipefail
. "$(dirname "$0")/../support/script.sh"
for program in octovis xvfb-run xwininfo; do
  command -v $program >/dev/null || { echo "SKIPPED: no $program" && exit 77; }
done

# open_in_octovis FILE LOG_FILE: on a screen of its own; until its window is there, and it lives on.
open_in_octovis() {
  # shellcheck disable=SC2016  # expanded by the inner shell
  timeout 60 xvfb-run -a -s "-screen 0 1024x768x24" bash -c '
    octovis "$1" >"$2" 2>&1 & viewer=$!
    until xwininfo -root -tree | grep -q "\"octovis\".*[0-9][0-9][0-9]x"; do
      kill -0 $viewer || exit 1
      sleep 0.1
    done
    kill -0 $viewer && kill $viewer' bash "$1" "$2"
}

"$bin/sensor-bridge" simulate --episode "$root/replay/episodes/hall10_low.pbtxt" --set duration_s=5 --quiet --log-out episode.lcm >/dev/null
"$bin/octo3d-slam" --quiet --log-in episode.lcm --out out
check "octovis opens the .bt" open_in_octovis out/octo3d-slam_map.bt bt.log
check "octovis has read it" grep -x "Reading binary octree type OcTree" bt.log
check "octovis opens the .ot" open_in_octovis out/octo3d-slam_map.ot ot.log
check "octovis has nothing to say against them" test -z "$(grep -i error {bt,ot}.log)"
finish_test

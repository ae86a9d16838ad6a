#!/usr/bin/env bash
# replay/demo from start to end.
set -euo pipefail
. "$(dirname "$0")/../support/script.sh"

main() {
  check "replay/demo ends well" demo
  check "it prints the error" grep -iE 'mean.*[0-9]' demo.txt
  check "it prints the coverage" grep -iE 'coverage.*[0-9]' demo.txt
  local file
  for file in sdf2d-slam_tum.txt sdf2d-slam_map.pgm sdf2d-slam_map.yaml sdf2d-slam_map.sdf sdf2d-slam_picture.png \
    sdf2d-slam_metrics.json sdf2d-slam.pbtxt ground_truth_000_tum.txt run.lcm SHA256SUMS; do
    check "it leaves $file" test -s "out/latest/$file"
  done
  check "every scan gave a pose" test "$(wc -l <out/latest/sdf2d-slam_tum.txt)" = 600
  check "mean error below 5 mm, all poses judged" \
    "$bin/evaluator" --estimate out/latest/sdf2d-slam_tum.txt --reference out/latest/ground_truth_000_tum.txt \
    --max-mean 0.005 --min-coverage 1
  finish_test
}

demo() { "$root/replay/demo" --out out >demo.txt 2>&1 || { cat demo.txt && false; }; }

main "$@"

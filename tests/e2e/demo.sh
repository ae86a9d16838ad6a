#!/usr/bin/env bash
# replay/demo from start to end.
set -euo pipefail
. "$(dirname "$0")/../support/script.sh"

main() {
  check "replay/demo ends well" demo
  local system
  for system in octo3d-slam sdf2d-slam; do
    check "it prints error and coverage of $system" grep -E "^$system: error mean [0-9].*coverage [0-9.]+ %" demo.txt
  done
  in_a_room
  in_a_hall
  check "one page of both" test "$(grep -cE '^<h2>[0-9-]+-(demo|hall10_rated_distortion)</h2>' out/report.html)" = 2
  check "no run failed for what it did not try" test -z "$(grep 'no result' out/report_files/*_episodes.csv)"
  finish_test
}

demo() { "$root/replay/demo" --out out >demo.txt 2>&1 || { cat demo.txt && false; }; }

in_a_room() {
  local file
  for file in sdf2d-slam_tum.txt sdf2d-slam_map.pgm sdf2d-slam_map.yaml sdf2d-slam_map.sdf sdf2d-slam_picture.png \
    sdf2d-slam_metrics.json sdf2d-slam.pbtxt ground_truth_000_tum.txt run.lcm report.html SHA256SUMS; do
    check "it leaves $file" test -s "out/latest/$file"
  done
  check "every scan gave a pose" test "$(wc -l <out/latest/sdf2d-slam_tum.txt)" = 600
  check "mean error below 5 mm, all poses judged" \
    "$bin/evaluator" --estimate out/latest/sdf2d-slam_tum.txt --reference out/latest/ground_truth_000_tum.txt \
    --max-mean 0.005 --min-coverage 1
}

in_a_hall() {
  local hall file
  hall=$(compgen -G 'out/*-hall10_rated_distortion')
  for file in tum.txt map.ply map.bt picture.png metrics.json; do
    check "it leaves octo3d-slam_$file" test -s "$hall/octo3d-slam_$file"
  done
  check "mean error below 5 mm" \
    "$bin/evaluator" --estimate "$hall/octo3d-slam_tum.txt" --reference "$hall/ground_truth_000_tum.txt" \
    --max-mean 0.005 --min-coverage 0.95
}

main "$@"

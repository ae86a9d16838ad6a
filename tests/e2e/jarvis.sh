#!/usr/bin/env bash
# An AGV with fast turns, scans only, default configuration, against reflector positioning.
set -euo pipefail
. "$(dirname "$0")/../support/script.sh"
need_data jarvis/jarvis_circular_path_fast.bag

"$root/replay/run" "$data/jarvis/jarvis_circular_path_fast.bag" --out .
check "mean error at most 0.020 m" \
  "$bin/evaluator" --estimate latest/sdf2d-slam_tum.txt --reference latest/ground_truth_000_tum.txt \
  --max-mean 0.020 --min-coverage 0.95
finish_test

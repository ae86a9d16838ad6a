#!/usr/bin/env bash
# What evaluator --evo-zip writes, read as evo's evo_res reads it: the same figures as in the evaluator's JSON.
set -euo pipefail
. "$(dirname "$0")/../support/script.sh"

main() {
  "$bin/sensor-bridge" simulate --episode "$root/replay/episodes/room5_low.pbtxt" --set duration_s=10 --quiet --log-out input.lcm
  "$bin/occupancy2d-slam" --quiet --log-in input.lcm --log-out run.lcm
  "$bin/evaluator" --quiet --log-in run.lcm --estimate OCCUPANCY2D_POSE --json metrics.json --evo-zip result.zip >metrics.txt
  check "evo's reader finds all that it needs" python3 "$root/tests/support/evo_result.py" result.zip
  check "the same mean and RMSE" same_figures
  finish_test
}

same_figures() {
  python3 "$root/tests/support/evo_result.py" result.zip >figures.txt
  jq -r '.absolute.translation_m | "\(.mean) \(.rmse)"' metrics.json | paste figures.txt - | tee /dev/stderr |
    awk '{ exit !(($1 - $3) ^ 2 < 1e-24 && ($2 - $4) ^ 2 < 1e-24) }'
}

main "$@"

#!/usr/bin/env bash
# 20 simulated episodes of 60 s for each noise level: the median over episodes of the mean error, and no failure.
set -euo pipefail
. "$(dirname "$0")/../support/script.sh"

episodes=20
first_seed=1
failure_m=0.10 # a larger mean error is a failed episode, and so are fewer than 99 % judged poses

main() {
  export root bin
  export -f run_episode
  parallel --will-cite --jobs "$(nproc)" --halt soon,fail=1 run_episode '{1}' '{2}' \
    ::: none low rated ::: $(seq $first_seed $((first_seed + episodes - 1)))
  judge none 0.0004
  judge low 0.00085
  judge rated 0.0078
  finish_test
}

# run_episode NOISE_LEVEL SEED
run_episode() {
  local name=$1-$2
  "$bin/sensor-bridge" simulate --episode "$root/replay/episodes/room5_$1.pbtxt" --seed "$2" --quiet --log-out "$name.lcm" \
    >/dev/null
  "$bin/sdf2d-slam" --quiet --log-in "$name.lcm" --log-out "$name-run.lcm" 2>"$name.log"
  "$bin/evaluator" --quiet --log-in "$name-run.lcm" --estimate SDF2D_POSE --reference GROUND_TRUTH --json "$name.json" >/dev/null
  rm "$name.lcm" "$name-run.lcm"
}

# judge NOISE_LEVEL LIMIT_M
judge() {
  check "$1: all episodes judged" test "$(find . -name "$1-*.json" | wc -l)" = $episodes
  check "$1: no episode failed" no_failure "$1"
  check "$1: median of mean errors at most $2 m" at_most "$(median "$1")" "$2"
  echo "$1: median $(median "$1") m"
}

no_failure() {
  jq -s -e "all(.absolute.translation_m.mean <= $failure_m and .association.coverage >= 0.99)" "$1"-*.json
}

median() { jq -s 'map(.absolute.translation_m.mean) | sort | (.[length / 2 | floor] + .[(length - 1) / 2 | floor]) / 2' "$1"-*.json; }

main "$@"

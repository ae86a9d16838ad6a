#!/usr/bin/env bash
# evaluator on the bus, live and log to log: the error so far, exit codes, a clock that steps back.
set -euo pipefail
. "$(dirname "$0")/../support/script.sh"

main() {
  need_data jarvis/jarvis_circular_path_fast.bag
  "$bin/sensor-bridge" import rosbag "$data/jarvis/jarvis_circular_path_fast.bag" --log-out input.lcm >import.log 2>&1
  shipped_configuration
  recording
  log_to_log
  live
  finish_test
}

shipped_configuration() {
  "$bin/evaluator" --print-config >printed.pbtxt
  check "the shipped configuration is the default" cmp printed.pbtxt "$root/services/evaluator/evaluator.pbtxt"
  check "--print-config reads back as itself" cmp printed.pbtxt <("$bin/evaluator" --config printed.pbtxt --print-config)
}

# The robot's odometry stands in for an estimate.
recording() {
  "$bin/evaluator" --log-in input.lcm --estimate ODOMETRY --json batch.json >batch.txt
  check "the table says how it came about" grep -qE "alignment +se2, no scale" batch.txt
  check_missed "a demand that is met" 0 --max-mean 0.05
  check_missed "a demand that is missed" 5 --max-mean 0.001
  check_refused "no such channel" 4 "no poses on OCTO3D_POSE" "$bin/evaluator" --quiet --log-in input.lcm --estimate OCTO3D_POSE
  check_refused "no such log" 3 none.lcm "$bin/evaluator" --quiet --log-in none.lcm --estimate ODOMETRY
  check_refused "unknown option" 2 frobnicate "$bin/evaluator" --frobnicate
}

check_missed() {
  local code=0
  "$bin/evaluator" --quiet --log-in input.lcm --estimate ODOMETRY "${@:3}" >missed.txt || code=$?
  check "$1: exit code $2" test "$code" = "$2"
}

log_to_log() {
  "$bin/evaluator" --quiet --log-in input.lcm --log-out judged.lcm --estimate ODOMETRY --json judged.json >judged.txt
  "$bin/evaluator" --quiet --log-in input.lcm --log-out again.lcm --estimate ODOMETRY >again.txt
  check "the same bytes twice" cmp judged.lcm again.lcm
  check "log to log ends where the batch ends" same_mean batch.json judged.json 1e-9
}

# The log twice, so that the clock steps back in between.
live() {
  claim_bus
  start evaluator evaluator.log "$bin/evaluator" --lcm-url "$lcm_url" --estimate ODOMETRY --json live.json
  wait_until evaluator says_ready evaluator
  start lcm-logger logger.log lcm-logger --quiet --lcm-url="$lcm_url" live.lcm
  wait_until lcm-logger listens "${pid_of[lcm-logger]}"
  lcm-logplayer --lcm-url="$lcm_url" --speed=10 input.lcm >/dev/null
  lcm-logplayer --lcm-url="$lcm_url" --speed=10 input.lcm >/dev/null
  stop evaluator
  sleep 0.5
  stop lcm-logger
  check "live ends where the batch ends" same_mean batch.json live.json 1e-3
  check "it says that the clock stepped back" grep -qE "clock stepped back 2[0-9.]+ s, segment 2" evaluator.log
  check "evaluation_t is on the bus" grep -q EVALUATION <("$bin/log-info" live.lcm)
}

# same_mean A.json B.json TOLERANCE: of the absolute error in m.
same_mean() {
  paste <(mean_of "$1") <(mean_of "$2") | tee /dev/stderr | awk -v tolerance="$3" '{ d = $1 - $2; exit !(d <= tolerance && -d <= tolerance) }'
}

mean_of() { sed -n '/"absolute"/,/"mean"/s/.*"mean": \([0-9.e-]*\).*/\1/p' "$1" | head -n 1; }

main "$@"

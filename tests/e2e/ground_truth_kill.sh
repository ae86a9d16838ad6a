#!/usr/bin/env bash
# ground-truth-logger, killed by SIGKILL in the middle of a run, loses at most the last second.
set -euo pipefail
. "$(dirname "$0")/../support/script.sh"

poses_per_second=40

main() {
  claim_bus
  start logger logger.log "$bin/ground-truth-logger" --out kept --lcm-url "$lcm_url"
  wait_until logger says_ready logger
  start listener listener.log lcm-logger --quiet --lcm-url="$lcm_url" heard.lcm
  wait_until listener listens "${pid_of[listener]}"
  start sender sender.log "$bin/sensor-bridge" simulate --episode "$root/replay/episodes/room5_low.pbtxt" \
    --set planar.lidar.model.turn_s=0.025 --set planar.lidar.model.num_beams=100 --lcm-url "$lcm_url" --quiet
  sleep 4.5
  kill -KILL "${pid_of[logger]}" "${pid_of[sender]}"
  for name in logger sender; do
    wait "${pid_of[$name]}" || true
    unset "pid_of[$name]"
  done
  sleep 0.5
  stop listener
  "$bin/ground-truth-logger" --quiet --log-in heard.lcm --out heard

  local heard
  heard=$(wc -l <heard/ground_truth_000_tum.txt)
  check "enough was sent" test "$heard" -gt $((3 * poses_per_second))
  check "trajectory lacks at most a second" at_most $((heard - $(wc -l <kept/ground_truth_000_tum.txt))) $poses_per_second
  check "log lacks at most a second" at_most $((heard - $(logged kept))) $poses_per_second
  check "what is kept is what was sent" cmp <(head -n -1 kept/ground_truth_000_tum.txt) \
    <(head -n $(($(wc -l <kept/ground_truth_000_tum.txt) - 1)) heard/ground_truth_000_tum.txt)
  finish_test
}

logged() { "$bin/log-info" --count GROUND_TRUTH "$1/ground_truth_000.lcm"; }

main "$@"

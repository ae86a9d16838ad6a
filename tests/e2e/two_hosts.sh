#!/usr/bin/env bash
# Sensors on one host, everything else on another, ttl=1: over a good cable nothing is lost; over one that loses 2 % of the
# packets and reorders some the run completes, says what it lacks, and stays accurate.
set -euo pipefail
. "$(dirname "$0")/../support/script.sh"
. "$root/tests/support/two_hosts.sh"
require_two_hosts "$root/tests/e2e/two_hosts.sh" "$@"

lcm_url="udpm://239.255.76.67:7667?ttl=1&recv_buf_size=2097152"
planar=(--episode "$root/replay/episodes/room5_low.pbtxt" --seed 1 --set duration_s=20 --set planar.lidar.model.turn_s=0.05)

main() {
  "$bin/sensor-bridge" simulate "${planar[@]}" --quiet --log-out planar.lcm
  mkdir log_to_log
  "$bin/sdf2d-slam" --quiet --log-in planar.lcm --log-out sdf2d.lcm --out log_to_log

  connect_hosts
  drive good sdf2d-slam SDF2D_POSE "${planar[@]}"
  disconnect_hosts
  check "20 Hz planar, good cable: all 400 scans" test "$(count LIDAR_2D good/run.lcm)" = 400
  check "all of ground truth" test "$(count GROUND_TRUTH good/run.lcm)" = "$(count GROUND_TRUTH planar.lcm)"
  check "trajectory as log to log" cmp good/sdf2d-slam_tum.txt log_to_log/sdf2d-slam_tum.txt
  check "nothing to complain about" nothing_missing good

  connect_hosts_lossily 0.02 0.05 1
  drive bad sdf2d-slam SDF2D_POSE "${planar[@]}"
  disconnect_hosts
  cat link.log
  check "20 Hz planar, bad cable: sdf2d-slam counts the scans it lacks" counts_missing bad/sdf2d-slam LIDAR_2D planar.lcm
  check "ground-truth-logger counts the poses it lacks" counts_missing bad/ground-truth-logger GROUND_TRUTH planar.lcm
  check "error within 1.5 times" at_most "$(error bad)" "$(awk "BEGIN { print 1.5 * $(error good) }")"
  finish_test
}

# drive FOLDER SLAM_SERVICE POSE_CHANNEL EPISODE...: a run over both hosts.
drive() {
  local folder=$1 service=$2 pose=$3 name
  shift 3
  mkdir "$folder"
  start lcm-logger "$folder/lcm-logger.log" "${on_slam[@]}" lcm-logger --quiet --lcm-url="$lcm_url" "$folder/run.lcm"
  wait_until lcm-logger host_listens "${pid_of[lcm-logger]}"
  start ground-truth-logger "$folder/ground-truth-logger.log" "${on_slam[@]}" "$bin/ground-truth-logger" --out "$folder" --lcm-url "$lcm_url"
  start "$service" "$folder/$service.log" "${on_slam[@]}" "$bin/$service" --out "$folder" --lcm-url "$lcm_url"
  start evaluator "$folder/evaluator.log" "${on_slam[@]}" "$bin/evaluator" --estimate "$pose" --json "$folder/metrics.json" --lcm-url "$lcm_url"
  for name in ground-truth-logger "$service" evaluator; do wait_until "$name" says_ready "$name"; done
  start sensor-bridge "$folder/sensor-bridge.log" "${on_lidar[@]}" "$bin/sensor-bridge" simulate "$@" --quiet --lcm-url "$lcm_url"
  finish sensor-bridge
  for name in "$service" ground-truth-logger evaluator; do stop "$name"; done
  sleep 0.5 # lcm-logger tells nobody what it has yet to write
  stop lcm-logger
}

host_listens() { "${on_slam[@]}" ss -lunpH "sport = :7667" | grep -q "pid=$1,"; }

count() { "$bin/log-info" --count "$1" "$2"; }

error() { jq .absolute.translation_m.mean "$1/metrics.json"; }

nothing_missing() { tail -qn 1 "$1"/{ground-truth-logger,*-slam,evaluator}.log && ! grep -E 'missing|dropped|refused' "$1"/*.log; }

# counts_missing LOG CHANNEL SENT: what the service says it lacks on the channel is what was sent and did not arrive, but for
# what went before it knew the period or after the last it heard.
counts_missing() {
  local said lost
  said=$(sed -n "s/.* \([0-9]*\) missing on $2.*/\1/p" "$1.log" | tail -n 1)
  lost=$(($(count "$2" "$3") - $(count "$2" "$(dirname "$1")/run.lcm")))
  echo "$lost lost, $said said to be missing"
  ((lost > 0 && said <= lost && lost - said <= 3))
}

main "$@"

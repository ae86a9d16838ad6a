# A simulated robot on the bus, the SLAM system on it, and its evaluation. Sourced after common.sh, network.sh and processes.sh.
# shellcheck shell=bash
# shellcheck disable=SC2154  # root, bin and lcm_url come from those

# start_run SYSTEM EPISODE SECONDS [SIMULATE_OPTION...]: what the services write goes to out/. Processes are named as the
# services.
start_run() {
  local system=$1 episode=$2 seconds=$3 service
  shift 3
  mkdir out
  for service in ground-truth-logger "$system"; do
    start "$service" "$service.log" "$bin/$service" --out out --lcm-url "$lcm_url"
    wait_until "$service" says_ready "$service"
  done
  start evaluator evaluator.log "$bin/evaluator" --estimate "$(pose_channel "$system")" --lcm-url "$lcm_url"
  wait_until evaluator says_ready evaluator
  start sensor-bridge sensor-bridge.log "$bin/sensor-bridge" simulate --episode "$root/replay/episodes/$episode.pbtxt" \
    --set "duration_s=$seconds" "$@" --lcm-url "$lcm_url" --quiet
}

# has_poses SYSTEM COUNT: whether so many have been written.
has_poses() { [[ -e out/$1_tum.txt && $(wc -l <"out/$1_tum.txt") -ge $2 ]]; }

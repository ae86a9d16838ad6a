#!/usr/bin/env bash
# 10,000 mutated messages of every type to every service, log to log and over a live bus: nobody dies, refusals are counted.
set -euo pipefail
. "$(dirname "$0")/../support/script.sh"

services=(sdf2d-slam octo3d-slam occupancy2d-slam cloud3d-slam ground-truth-logger evaluator)
declare -A options=([sdf2d-slam]="--set channels.odometry=ODOMETRY" [octo3d-slam]="--set channels.odometry=ODOMETRY --set channels.imu=IMU"
  [occupancy2d-slam]="--set channels.odometry=ODOMETRY" [cloud3d-slam]="--set channels.odometry=ODOMETRY")

main() {
  "$bin/mutated_log" mutated.lcm 10000 "${LCMSLAM_SEED:-1}"
  local service
  for service in "${services[@]}"; do log_to_log "$service"; done
  live
  finish_test
}

log_to_log() {
  local arguments
  read -ra arguments <<<"${options[$1]:-}"
  check "$1 survives the log" bounded "$1.log" "$bin/$1" "${arguments[@]}" --out "$1" --log-in mutated.lcm --log-out "$1.lcm"
  check "$1 counts refusals" grep -E '[1-9][0-9]* refused' "$1.log"
}

# bounded LOG_FILE COMMAND...: with 120 s of computing and 4 GB; a count that is believed would ask for more.
bounded() (
  ulimit -t 120 -v 4000000
  "${@:2}" 2>"$1" || { cat "$1" && false; }
)

# All services on one bus, as fast as the log can be played.
live() {
  local service arguments
  claim_bus
  for service in "${services[@]}"; do
    read -ra arguments <<<"${options[$service]:-}"
    start "$service" "$service.log" "$bin/$service" "${arguments[@]}" --out "$service-live" --lcm-url "$lcm_url"
    wait_until "$service" says_ready "$service"
  done
  lcm-logplayer --lcm-url="$lcm_url" --speed=20 mutated.lcm >/dev/null
  for service in "${services[@]}"; do
    check "$service lives on" is_running "$service"
    stop "$service"
    check "$service counts refusals live" grep -E '[1-9][0-9]* refused' "$service.log"
  done
}

main "$@"

# What services say of their health while they run. Sourced after script.sh.
# shellcheck shell=bash
# shellcheck disable=SC2154  # bin and lcm_url come from there

# Records all statuses from now on.
log_statuses() {
  start logger logger.log lcm-logger --quiet --flush-interval=50 --channel='.*_STATUS' --lcm-url="$lcm_url" statuses.lcm
  wait_until logger listens "${pid_of[logger]}"
}

# hear SERVICE STATE CONDITION: waits for a status with this state (or any) and the condition, in awk's words.
hear() {
  local deadline=$((SECONDS + 15))
  until said "$@"; do
    ((SECONDS < deadline)) || { statuses "$1" | tail -n 12 && return 1; }
    sleep 0.1
  done
}

said() {
  local first
  first=$(statuses "$1" | awk -F '\t' -v want="$2" \
    '{ state = $3; processed = $5; dropped = $6; refused = $7; missing = $8; p99 = $9; text = $11; kernel_dropped = $12 }
    (want == "any" || state == want) && ('"$3"') { print; exit }')
  [[ -n $first ]]
}

statuses() { "$bin/status_lines" statuses.lcm | awk -F '\t' -v name="$1" '$2 == name'; }

# tells SERVICE SINCE STATE CONDITION: waits for such a status after the time SINCE (s, as logs have it); it has to come within two
# seconds. How many it took goes to delays.txt. In the condition, too: new_lost, messages dropped or missing since then.
tells() {
  local deadline=$((SECONDS + 15)) after
  until after=$(seconds_until_told "$@") && [[ -n $after ]]; do
    ((SECONDS < deadline)) || { echo "since $2:" && statuses "$1" | tail -n 20 && return 1; }
    sleep 0.1
  done
  echo "$after" >>delays.txt
  at_most "$after" 2
}

seconds_until_told() {
  statuses "$1" | awk -F '\t' -v since="$2" -v want="$3" \
    '{ state = $3; processed = $5; lost = $6 + $8; refused = $7; missing = $8; p99 = $9; text = $11; kernel_dropped = $12 }
    $1 < since { lost_before = lost; next }
    { new_lost = lost - lost_before }
    (want == "any" || state == want) && ('"$4"') { print $1 - since; exit }'
}

# Records the inputs on this bus from now on.
log_inputs() {
  start input_logger input_logger.log lcm-logger --quiet --flush-interval=50 --channel='LIDAR_2D|LIDAR_3D|GROUND_TRUTH' \
    --lcm-url="$lcm_url" inputs.lcm
  wait_until input_logger listens "${pid_of[input_logger]}"
}

# first_arrival CHANNEL STAMP: when the first message stamped STAMP (s) or later came.
first_arrival() { "$bin/arrivals" inputs.lcm "$1" | awk -v stamp="$2" '$2 >= stamp { print $1; exit }'; }

# last_arrival CHANNEL STAMP: when the last message stamped before STAMP (s) came.
last_arrival() { "$bin/arrivals" inputs.lcm "$1" | awk -v stamp="$2" '$2 < stamp { last = $1 } END { print last }'; }

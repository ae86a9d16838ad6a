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

# Seconds from the last status without to the first one with word of silence; the input ended before that.
silence_before_word() { statuses "$1" | awk -F '\t' '$11 ~ /no input/ { print $1 - last; exit } { last = $1 }'; }

#!/usr/bin/env bash
# sdf2d-slam's status tells within two seconds, with numbers, when its input stops, skips, comes late or floods it; and it obeys
# SLAM_COMMAND while it runs.
set -euo pipefail
. "$(dirname "$0")/../support/script.sh"

main() {
  episode good 1000000 8
  episode after_a_gap 10000000 10 # a second later: 10 scans are missing
  episode flood 20000000 300
  episode later 400000000 4

  claim_bus
  start logger logger.log lcm-logger --quiet --flush-interval=50 --lcm-url="$lcm_url" heard.lcm
  wait_until logger listens "${pid_of[logger]}"
  mkdir out
  start slam slam.log "$bin/sdf2d-slam" --out out --lcm-url "$lcm_url"
  wait_until slam says_ready slam

  play good
  check "well while scans come" hear OK 'processed >= 80'
  check "starved: waiting, for how long" hear WAITING 'text ~ /no input for 1 s/'
  check "the first word of it came within two seconds" at_most "$(seconds_to 'text ~ /no input/')" 2
  play after_a_gap &
  check "skipped: how many, and where" hear DEGRADED 'missing == 10 && text ~ /10 missing on LIDAR_2D/'
  hold_up
  check "slowed: how late" hear any 'p99 >= 1000'
  wait "$!"
  play flood --speed=0
  check "flooded: how many were lost" hear DEGRADED 'dropped + missing > 100'
  check_commands
  stop slam
  stop logger
  finish_test
}

# episode NAME START_UTIME SECONDS: 10 scans a second.
episode() {
  "$bin/sensor-bridge" simulate --episode "$root/replay/episodes/room5_low.pbtxt" --quiet --log-out "$1.lcm" \
    --set "start_utime=$2" --set "duration_s=$3" >/dev/null
}

# play NAME [OPTION...]
play() { lcm-logplayer --lcm-url="$lcm_url" "${@:2}" "$1.lcm" >player.log 2>&1; }

# Keeps the service from working for over a second while scans arrive.
hold_up() {
  kill -STOP "${pid_of[slam]}"
  sleep 1.3
  kill -CONT "${pid_of[slam]}"
}

# said STATE CONDITION: whether a status had this state (or any) and the condition, in awk's words.
said() { [[ -n $(first_time "$@") ]]; }

# hear STATE CONDITION: waits for such a status.
hear() {
  local deadline=$((SECONDS + 10))
  until said "$@"; do
    ((SECONDS < deadline)) || { "$bin/status_lines" heard.lcm | tail -n 12 && return 1; }
    sleep 0.1
  done
}

# Log time of the first such status; nothing before there is one.
first_time() {
  "$bin/status_lines" heard.lcm | awk -F '\t' -v want="$1" '$2 != "sdf2d-slam" { next }
    { state = $3; processed = $5; dropped = $6; missing = $8; p99 = $9; text = $11 }
    (want == "any" || state == want) && ('"$2"') { print $1; exit }'
}

# Seconds from the first status that had all scans to the first with this.
seconds_to() {
  local last
  last=$("$bin/status_lines" heard.lcm | awk -F '\t' '$2 == "sdf2d-slam" && $5 >= 80 { print $1; exit }')
  awk -v from="$last" -v to="$(first_time any "$1")" 'BEGIN { print to - from }'
}

check_commands() {
  command_slam reset
  check "reset: it says so" hear any 'text ~ /reset/'
  command_slam pose 10 20 1.5
  check "set pose: it says so" hear any 'text ~ /pose set/'
  play later
  check "set pose: it goes on from there" at_most "$(distance_of_last_pose 10 20)" 5
  command_slam save kept
  check "save: it says so" hear any 'text ~ /saved kept/'
  check "save: the map is there" test -s kept.sdf -a -s kept.pgm -a -s kept.yaml
  command_slam load kept.sdf
  check "load: it says so" hear any 'text ~ /loaded kept/'
}

command_slam() {
  "$bin/command_log" command.lcm "$@"
  play command
}

# From X Y, once the trajectory has been written.
distance_of_last_pose() {
  sleep 1.5
  tail -n 1 out/sdf2d-slam_tum.txt | awk -v x="$1" -v y="$2" '{ print sqrt(($2 - x) ^ 2 + ($3 - y) ^ 2) }'
}

main "$@"

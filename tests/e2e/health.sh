#!/usr/bin/env bash
# The status of every service tells within two seconds, with numbers, when its input stops, skips, comes late or floods it; and
# the SLAM services obey SLAM_COMMAND while they run.
set -euo pipefail
. "$(dirname "$0")/../support/script.sh"
. "$root/tests/support/statuses.sh"

planar=(sdf2d-slam occupancy2d-slam) spatial=(octo3d-slam cloud3d-slam) judges=(ground-truth-logger evaluator)
declare -A channel=([sdf2d-slam]=LIDAR_2D [occupancy2d-slam]=LIDAR_2D [octo3d-slam]=LIDAR_3D [cloud3d-slam]=LIDAR_3D
  [ground-truth-logger]=GROUND_TRUTH [evaluator]=GROUND_TRUTH)
declare -A map=([sdf2d-slam]=.sdf [occupancy2d-slam]=.pgm [octo3d-slam]=.surfels [cloud3d-slam]=.ply)

main() {
  claim_bus
  log_statuses
  check_group room5_low 300 "${planar[@]}" "${judges[@]}"
  check_group hall10_low 15 "${spatial[@]}"
  stop logger
  finish_test
}

# check_group EPISODE FLOOD_SECONDS SERVICE...: services that hear the same logs.
check_group() {
  local episode=$1 flood_s=$2 service
  shift 2
  make_log good "$episode" 1000000 6
  make_log after_a_gap "$episode" 8000000 3 # a second later: 10 scans are missing
  make_log held_up "$episode" 11000000 8
  make_log flood "$episode" 20000000 "$flood_s"
  make_log later "$episode" 400000000 4
  for service in "$@"; do start_service "$service"; done

  play good
  for service in "$@"; do
    check "$service: well while its input comes" hear "$service" OK 'processed >= 50'
    check "$service: starved, and for how long" hear "$service" WAITING 'text ~ /no input for 1 s/'
    check "$service: the first word of it came within two seconds" at_most "$(silence_before_word "$service")" 2
  done
  play after_a_gap
  for service in "$@"; do
    check "$service: skipped: how much, and where" hear "$service" DEGRADED 'missing >= 9 && text ~ /[0-9]+ missing on '"${channel[$service]}"'/'
  done
  play held_up &
  local player=$!
  hold_up "$@"
  for service in "$@"; do check "$service: slowed: how late" hear "$service" any 'p99 >= 1000'; done
  wait "$player"
  check_flooded "$@"
  for service in "$@"; do
    if [[ $service == *-slam ]]; then check_commands "$service"; fi
    stop "$service"
  done
}

# make_log NAME EPISODE START_UTIME SECONDS: 10 scans or sweeps a second.
make_log() {
  "$bin/sensor-bridge" simulate --episode "$root/replay/episodes/$2.pbtxt" --quiet --log-out "$1.lcm" \
    --set "start_utime=$3" --set "duration_s=$4" >/dev/null
}

# play NAME [OPTION...]
play() { lcm-logplayer --lcm-url="$lcm_url" "${@:2}" "$1.lcm" >player.log 2>&1; }

start_service() {
  local options=(--out out)
  [[ $1 != evaluator ]] || options=(--estimate SDF2D_POSE)
  mkdir -p out
  start "$1" "$1.log" "$bin/$1" "${options[@]}" --lcm-url "$lcm_url"
  wait_until "$1" says_ready "$1"
}

# Keeps the services from working for well over a second of their input, which may be late to begin.
hold_up() {
  local service
  for service in "$@"; do kill -STOP "${pid_of[$service]}"; done
  sleep 4
  for service in "$@"; do kill -CONT "${pid_of[$service]}"; done
}

# A flood that they are kept from taking in: what the kernel had no room for shows when the next message comes.
check_flooded() {
  local service
  for service in "$@"; do kill -STOP "${pid_of[$service]}"; done
  play flood --speed=0
  for service in "$@"; do kill -CONT "${pid_of[$service]}"; done
  play later
  for service in "$@"; do check "$service: flooded: how much was lost" hear "$service" any 'dropped + missing > 100'; done
}

check_commands() {
  local service=$1
  command_slam "$service" reset
  check "$service: reset: it says so" hear "$service" any 'text ~ /reset/'
  command_slam "$service" pose 10 20 1.5
  check "$service: set pose: it says so" hear "$service" any 'text ~ /pose set/'
  play later
  check "$service: set pose: it goes on from there" wait_until "$service" last_pose_is_near "$service" 10 20
  command_slam "$service" save "kept-$service"
  check "$service: save: it says so" hear "$service" any 'text ~ /saved kept/'
  check "$service: save: the map is there" test -s "kept-$service${map[$service]}"
}

# command_slam SERVICE COMMAND ARGUMENT...
command_slam() {
  "$bin/command_log" command.lcm "$@"
  play command
}

# last_pose_is_near SERVICE X Y: the last one written is within 5 m.
last_pose_is_near() {
  tail -n 1 "out/$1_tum.txt" | awk -v x="$2" -v y="$3" '{ exit !(sqrt(($2 - x) ^ 2 + ($3 - y) ^ 2) < 5) }'
}

main "$@"

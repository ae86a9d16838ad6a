#!/usr/bin/env bash
# The status of every service tells within two seconds, with numbers, when its input stops, skips, comes slowly, late or as a flood;
# and the SLAM services obey SLAM_COMMAND while they run. The two seconds are counted from the arrival of the first message that is
# wrong, as a logger beside the services heard it, so that a busy machine's slow start of a sender does not count.
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
  check_group room5_low planar.lidar.model.turn_s 50 300 "${planar[@]}" "${judges[@]}"
  check_group hall10_low spatial.lidar.model.turn_s 10 20 "${spatial[@]}"
  stop logger
  echo "slowest: $(sort -g delays.txt | tail -n 1) s from a fault to the status that tells it"
  finish_test
}

# check_group EPISODE PERIOD_FIELD FLOOD_SPEED FLOOD_SECONDS SERVICE...: services that hear the same logs. All logs hold 10 scans or
# sweeps a second but `half`; by its stamp a message tells which it is from.
check_group() {
  local episode=$1 period=$2 flood_speed=$3 flood_s=$4 service
  shift 4
  make_log good "$episode" 1 6
  make_log after_a_gap "$episode" 8 3 # a second later: 10 scans are missing
  make_log held_up "$episode" 11 8
  make_log slow "$episode" 30 3
  make_log steady "$episode" 40 3
  make_log half "$episode" 43.2 3 --set "$period=0.2"
  make_log flood "$episode" 50 "$flood_s"
  make_log later "$episode" 400 4
  rm -f inputs.lcm
  log_inputs
  for service in "$@"; do start_service "$service"; done

  play good
  each well "$@"
  each starved "$@"
  play after_a_gap
  each skipped "$@"
  hold_up "$@"
  each late "$@"
  play slow --speed=0.4
  each slowed "$@"
  play steady && play half
  each halved "$@"
  play flood --speed="$flood_speed"
  each flooded "$@"
  overwhelm "$@"
  each overwhelmed "$@"
  for service in "$@"; do
    if [[ $service == *-slam ]]; then check_commands "$service"; fi
    stop "$service"
  done
  stop input_logger
}

# make_log NAME EPISODE START_S SECONDS [OPTION...]
make_log() {
  "$bin/sensor-bridge" simulate --episode "$root/replay/episodes/$2.pbtxt" --quiet --log-out "$1.lcm" \
    --set "start_utime=$(awk -v s="$3" 'BEGIN { printf "%d", 1e6 * s }')" --set "duration_s=$4" "${@:5}" >/dev/null
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

# each CHECK SERVICE...: CHECK SERVICE CHANNEL.
each() {
  local service
  for service in "${@:2}"; do "$1" "$service" "${channel[$service]}"; done
}

well() { check "$1: well while its input comes" hear "$1" OK 'processed >= 50'; }

starved() { check "$1: starved, and for how long" tells "$1" "$(last_arrival "$2" 8)" WAITING 'text ~ /no input for [0-9.]+ s/'; }

skipped() {
  check "$1: skipped: how much, and where" tells "$1" "$(first_arrival "$2" 8)" DEGRADED \
    'new_lost >= 9 && text ~ /[0-9]+ missing on '"$2"'/'
}

late() { check "$1: held up: how late it is" tells "$1" "$held_up_until" any 'p99 >= 1000'; }

slowed() {
  check "$1: slowed: how slow" tells "$1" "$(first_arrival "$2" 30)" DEGRADED 'text ~ /input at 0[.][345][0-9]* of real time, [0-9.]+ Hz/'
}

# The truth keeps its rate.
halved() {
  [[ $2 != GROUND_TRUTH ]] || return 0
  check "$1: at half the rate: how much is missing" tells "$1" "$(first_arrival "$2" 43.2)" DEGRADED 'new_lost >= 2 && text ~ /missing on '"$2"'/'
}

flooded() {
  check "$1: flooded: how fast" tells "$1" "$(first_arrival "$2" 50)" any 'text ~ /input at [0-9.]+ times real time, [0-9]+ Hz/'
}

overwhelmed() { check "$1: overwhelmed: how much was lost" tells "$1" "$held_up_until" any 'new_lost > 100'; }

# Keeps the services from working for well over a second of their input, which may be late to begin.
hold_up() {
  local player
  play held_up &
  player=$!
  signal STOP "$@"
  sleep 4
  signal CONT "$@"
  wait "$player"
}

# A flood that they are kept from taking in: what the kernel had no room for shows when the next message comes.
overwhelm() {
  signal STOP "$@"
  play flood --speed=0
  signal CONT "$@"
  play later
}

# signal NAME SERVICE...
signal() {
  local service
  for service in "${@:2}"; do kill "-$1" "${pid_of[$service]}"; done
  held_up_until=$(date +%s.%N)
}

check_commands() {
  local service=$1 poses
  command_slam "$service" reset
  check "$service: reset: it says so" hear "$service" any 'text ~ /reset/'
  command_slam "$service" pose -10 20 1.5
  check "$service: set pose: it says so" hear "$service" any 'text ~ /pose set/'
  poses=$(count_poses "$service")
  play later
  wait_until "$service" has_pose "$service" "$poses" 403.5
  check "$service: set pose: it goes on from there" pose_is_near "$service" "$poses" 403.5 -10 20 5
  command_slam "$service" save "kept-$service"
  check "$service: save: it says so" hear "$service" any 'text ~ /saved kept/'
  check "$service: save: the map is there" test -s "kept-$service${map[$service]}"
  case $service in
    sdf2d-slam | octo3d-slam) check_load "$service" ;;
    *)
      command_slam "$service" load "kept-$service${map[$service]}"
      check "$service: load: it says that it cannot" hear "$service" any 'text ~ /loads no maps/'
      ;;
  esac
}

# In the map that was saved it finds its way back from a pose that is a little wrong; without one it would keep the error.
check_load() {
  local service=$1 stamp x y poses
  read -r stamp x y <<<"$(last_pose "$service")"
  poses=$(count_poses "$service")
  command_slam "$service" reset
  command_slam "$service" load "no such map"
  check "$service: load: it says that there is none" hear "$service" any 'text ~ /no such map: /'
  command_slam "$service" load "kept-$service${map[$service]}"
  check "$service: load: it says so" hear "$service" any 'text ~ /loaded kept/'
  command_slam "$service" pose -10.1 20 1.5
  play later
  wait_until "$service" has_pose "$service" "$poses" "$stamp"
  check "$service: load: it finds its place in the map" pose_is_near "$service" "$poses" "$stamp" "$x" "$y" 0.03
}

# command_slam SERVICE COMMAND ARGUMENT...
command_slam() { "$bin/slam-command" --lcm-url "$lcm_url" --service "$@"; }

count_poses() { wc -l <"out/$1_tum.txt"; }

# Stamp, x and y.
last_pose() { tail -n 1 "out/$1_tum.txt" | cut -d ' ' -f 1-3; }

# pose_from SERVICE POSES STAMP: the first pose stamped STAMP or later, but for the first POSES that it wrote.
pose_from() { awk -v poses="$2" -v stamp="$3" 'NR > poses && $1 >= stamp { print $1, $2, $3; exit }' "out/$1_tum.txt"; }

has_pose() { [[ -n $(pose_from "$@") ]]; }

# pose_is_near SERVICE POSES STAMP X Y LIMIT: pose_from, to that place.
pose_is_near() {
  pose_from "$1" "$2" "$3" | awk -v x="$4" -v y="$5" -v limit="$6" \
    '{ distance = sqrt(($2 - x) ^ 2 + ($3 - y) ^ 2); print distance, "m, limit", limit; exit !(distance < limit) }'
}

main "$@"

#!/usr/bin/env bash
# replay/run: says in one line what is wrong, ends what it started however it ends, keeps earlier results, draws maps.
set -euo pipefail
. "$(dirname "$0")/../support/script.sh"
. "$root/tests/support/pictures.sh"

main() {
  "$bin/sensor-bridge" simulate --episode "$root/replay/episodes/room5_low.pbtxt" --set duration_s=5 --quiet --log-out episode.lcm
  refuses
  cleans_up
  keeps_results
  takes_sweeps
  finish_test
}

refuses() {
  check_refused "no log" 2 "which log" "$root/replay/run"
  check_refused "missing log" 3 "none.lcm: cannot be read" "$root/replay/run" none.lcm
  check_refused "unknown option" 2 "--frobnicate" "$root/replay/run" episode.lcm --frobnicate
  check_refused "option without value" 2 "--out: needs a value" "$root/replay/run" episode.lcm --out
  check_refused "speed that is none" 2 "--speed fast" "$root/replay/run" episode.lcm --live --speed fast
  check_refused "no speed at all" 2 "--speed 0: not a positive" "$root/replay/run" episode.lcm --live --speed 0
  check_refused "system that is none" 2 "hector" "$root/replay/run" episode.lcm --systems hector
  check_refused "bad configuration of a service" 2 "run: sdf2d-slam ended with code 2: .*cell_m" \
    "$root/replay/run" episode.lcm --set sdf2d-slam:cell_m=-1
  check_refused "configuration of what does not run" 2 "octo3d-slam does not run" \
    "$root/replay/run" episode.lcm --set octo3d-slam:leaf_m=1
  check_refused "scans for a system of sweeps" 4 "octo3d-slam: no pose from episode.lcm" \
    "$root/replay/run" episode.lcm --systems octo3d-slam
  head -c 10000 /dev/zero >damaged.bag
  check_refused "damaged bag" 3 "damaged.bag" "$root/replay/run" damaged.bag
  cp damaged.bag zeros
  check_refused "bag by another name" 3 "zeros: not an LCM log.*\.bag" "$root/replay/run" zeros
  { head -c 300000 episode.lcm && head -c 500 /dev/zero && tail -c +300001 episode.lcm; } >damaged.lcm
  check_refused "damage in the middle" 3 "run: damaged.lcm: [0-9]+ damaged bytes" "$root/replay/run" damaged.lcm --live
}

# On SIGINT and SIGTERM in the middle of a live run.
cleans_up() {
  local signal code
  for signal in INT TERM; do
    start run run.log env --default-signal=INT setsid "$root/replay/run" episode.lcm --live --out "$signal"
    wait_until run grep -q Playing run.log
    sleep 1.5
    check "services run before SIG$signal" test "$(services_of "$signal")" -ge 3
    code=0
    kill -s "$signal" "${pid_of[run]}"
    wait "${pid_of[run]}" || code=$?
    unset "pid_of[run]"
    check "SIG$signal ends the run" test $code -gt 128
    check "no service is left after SIG$signal" test "$(services_of "$signal")" = 0
  done
}

# How many processes work in results folder $1 of this test.
services_of() { pgrep -fc "[ =]$1/[^ ]*-episode" || true; }

keeps_results() {
  mkdir -p "it's a folder"
  "$root/replay/run" episode.lcm --out kept
  (cd "it's a folder" && "$root/replay/run" ../episode.lcm --out ../kept)
  check "named after the log" test "$(compgen -G 'kept/*-episode*' | wc -l)" = 2
  check "a folder of any name" "$root/replay/run" episode.lcm --out "it's a folder"
  check "two folders and the link" test "$(find kept -mindepth 1 -maxdepth 1 | wc -l)" = 3
  check "latest is the newer one" test "$(readlink kept/latest)" = "$(find kept -mindepth 1 -maxdepth 1 -type d -printf '%f\n' | sort -V | tail -n 1)"
}

# Walls, and the estimate upon the truth, in plan and side view: truth comes in another frame.
takes_sweeps() {
  "$bin/sensor-bridge" simulate --episode "$root/replay/episodes/hall10_low.pbtxt" --set duration_s=5 --quiet --log-out hall.lcm
  check "a log of sweeps runs" "$root/replay/run" hall.lcm --out hall
  check "a cloud's map too" "$root/replay/run" hall.lcm --systems cloud3d-slam --out cloud
  local picture
  for picture in hall/latest/octo3d-slam_picture.png cloud/latest/cloud3d-slam_picture.png; do
    check "$picture: walls" at_least "$(pixels count "$picture" 26323A)" 3000
    check "$picture: a trajectory" at_least "$(pixels count "$picture" 0072B2)" 150
    check "$picture: truth below it" at_least "$(pixels near "$picture" 0072B2 E69F00 4)" 75 # the key has no truth below it
  done
}

main "$@"

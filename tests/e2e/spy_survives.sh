#!/usr/bin/env bash
# lcm-spy with our views open while messages of every type come mutated, and then services that begin again: it stays, and
# shows the new run.
set -euo pipefail
. "$(dirname "$0")/../support/script.sh"
. "$root/replay/support/desktop.sh"
. "$root/tests/support/pictures.sh"
need_desktop

main() {
  record planar sdf2d-slam room5_low 20
  record spatial octo3d-slam hall10_low 8
  "$bin/mutated_log" mutated.lcm 1000 "${LCMSLAM_SEED:-1}"
  claim_bus
  open_desktop
  open_spy spy
  tell_spy spy "open SDF2D_MAP map" "open OCTO3D_MAP space" "open SDF2D_SLAM_STATUS health" "await mutated" table close \
    "await again" "open SDF2D_MAP map_again" close "open OCTO3D_MAP space_again" close "open SDF2D_SLAM_STATUS health_again"
  play_until_open
  play mutated 2
  check "mutated messages: it stays" is_running spy
  touch spy/mutated
  play planar 4 # slowly: lcm-spy listens with the kernel's default buffer
  play spatial 0.5
  touch spy/again
  check "it does as it is told" finish_spy
  # shellcheck disable=SC2016  # for awk to expand
  check "there were messages that nobody can decode" awk -F '\t' '$1 == "SLAM_COMMAND" { exit !($NF > 0) }' spy/channels.tsv
  check "no view fails" not_in spy.log 'Exception in thread|at lcmslam\.'
  check_again
  finish_test
}

# record NAME SYSTEM EPISODE SECONDS: the log of a run.
record() {
  "$bin/sensor-bridge" simulate --episode "$root/replay/episodes/$3.pbtxt" --set "duration_s=$4" --quiet --log-out "$1-input.lcm" >/dev/null
  "$bin/$2" --quiet --log-in "$1-input.lcm" --log-out "$1.lcm"
}

# play NAME SPEED
play() { lcm-logplayer --speed="$2" --lcm-url="$lcm_url" "$1.lcm" >player.log 2>&1; }

# What came before a view was opened may have been lost: again, until all are.
play_until_open() {
  until [[ -e spy/health.png ]]; do
    is_running spy || die "$(tail -n 1 spy.log)"
    play planar 10
    play spatial 1
  done
}

finish_spy() {
  finish spy
  [[ -e spy/done ]]
}

not_in() {
  cat "$1"
  ! grep -qE "$2" "$1"
}

check_again() {
  local scan surfel=96a9c6 estimate=0072b2
  scan=$(color SCAN)
  check "map again: free space" at_least "$(pixels count spy/map_again.png fafafa)" 20000
  check "map again: estimate" at_least "$(pixels count spy/map_again.png $estimate)" 200
  check "map again: the scan lies on walls" at_least "$(pixels near spy/map_again.png "$scan" 262626 8)" 25
  check "space again: sweep" at_least "$(pixels count spy/space_again.png "$scan")" 2000
  check "space again: surfels of the floor" at_least "$(pixels count spy/space_again.png $surfel)" 5000
  check "space again: the sweep lies on surfels" at_least "$(pixels near spy/space_again.png "$scan" $surfel 10)" 30
  check "health again: it goes on" at_least "$(pixels differ spy/health.png spy/health_again.png)" 50
}

main "$@"

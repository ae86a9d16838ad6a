#!/usr/bin/env bash
# Two CARMEN logs with odometry, against relations that a person has confirmed.
set -euo pipefail
. "$(dirname "$0")/../support/script.sh"
need_data radish/fr079.clf.bz2 radish/aces.clf.bz2

main() {
  replay fr079
  check "fr079: translation error at most 0.040 m mean" judge fr079 --max-mean 0.040 --min-coverage 0.99
  replay aces
  check "aces: translation error at most 0.20 m mean" judge aces --max-mean 0.20 --min-coverage 0.99
  finish_test
}

replay() {
  "$root/replay/run" "$data/radish/$1.clf.bz2" --set sdf2d-slam:channels.odometry=ODOMETRY \
    --relations "$data/radish/$1.relations" --out "$1" >"$1.txt"
}

judge() {
  "$bin/evaluator" --estimate "$1/latest/sdf2d-slam_tum.txt" --relations "$data/radish/$1.relations" "${@:2}"
}

main "$@"

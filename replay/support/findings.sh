# What replay/doctor found: a line each, with the command that mends it below.
# shellcheck shell=bash
# shellcheck disable=SC2154  # exit_runtime comes from common.sh

faults=0 warnings=0

ok() { printf 'ok       %s\n' "$1"; }

# note FINDING [COMMAND]
note() {
  printf 'note     %s\n' "$1"
  (($# < 2)) || printf '         mend: %s\n' "$2"
}

# warning FINDING COMMAND
warning() {
  printf 'warning  %s\n         mend: %s\n' "$1" "$2"
  warnings=$((warnings + 1))
}

# fault FINDING COMMAND: live runs do not work with it.
fault() {
  printf 'FAULT    %s\n         mend: %s\n' "$1" "$2"
  faults=$((faults + 1))
}

# Says it all in a line; false when there was a fault.
conclude() {
  ((faults > 0)) || { echo "Live runs work ($warnings warnings)." && return; }
  echo "Live runs do not work: $faults to mend."
  return "$exit_runtime"
}

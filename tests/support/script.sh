# Sourced first by every test that is a script. Sees to a multicast route and changes into an empty folder, `work`, that is
# removed at the end. A test goes on after a failed check and ends with 1; with 77 (skipped) where its data is absent.
# shellcheck shell=bash
# shellcheck disable=SC2034  # used by those who source this

. "$(dirname "${BASH_SOURCE[0]}")/../../replay/support/common.sh"
. "$root/replay/support/network.sh"
. "$root/replay/support/processes.sh"
require_multicast "$0" "$@"

data=${LCMSLAM_DATA:-$root/../shared/data}
work=$(mktemp -d)
cd "$work"
trap 'stop_all; rm -rf "$work"' EXIT

failures=0

# need_data FILE...: below `data`.
need_data() {
  local file
  for file in "$@"; do
    [[ -e $data/$file ]] || { echo "SKIPPED: no $data/$file" && exit 77; }
  done
}

# check DESCRIPTION COMMAND ARGUMENT...: the command has to succeed. Shows its output when it does not.
check() {
  local description=$1
  shift
  if "$@" >check.out 2>&1; then
    echo "ok: $description"
  else
    echo "FAILED: $description: $*"
    cat check.out
    failures=$((failures + 1))
  fi
}

# check_refused DESCRIPTION EXIT_CODE PATTERN COMMAND ARGUMENT...
# The command has to end with this code and exactly one line on stderr, which matches the pattern.
check_refused() {
  local description=$1 want=$2 pattern=$3 code=0
  shift 3
  "$@" >/dev/null 2>refused.err || code=$?
  grep -v '^READY$' refused.err >refused.lines || true
  check "$description: exit code $want" test "$code" = "$want"
  check "$description: one line" test "$(wc -l <refused.lines)" = 1
  check "$description: says '$pattern'" grep -qE -- "$pattern" refused.lines
}

# at_most VALUE LIMIT: as decimal numbers; a value that is no number is too large.
at_most() {
  echo "$1, limit $2"
  awk -v value="$1" -v limit="$2" 'BEGIN { exit !(value ~ /^[-+]?[0-9.]+([eE][-+]?[0-9]+)?$/ && value + 0 <= limit + 0) }'
}

finish_test() { ((failures == 0)) || exit 1; }

#!/usr/bin/env bash
# replay/reproduce: killed in the middle and run again, it ends with the same bytes as a run that nothing disturbed, but for times.
set -euo pipefail
. "$(dirname "$0")/../support/script.sh"

main() {
  check "an undisturbed run" reproduce whole --jobs 1
  check "every regime and system is in the table" test "$(grep -cE '^(noise_free|low|rated|urg)[_0-9m]* .*-slam' whole.out)" = 21
  check "one row a system and episode" test "$(cat whole/chapter4/report_files/group?_episodes.csv | wc -l)" = $((14 * 3 + 7))
  check "the page" test -s whole/chapter4/report.html
  check "no logs are left" test -z "$(find whole -name '*.lcm')"
  check "checksums" sums_agree
  kill_in_the_middle
  echo '2/:' >hosts # two jobs here
  check "a run that goes on" reproduce killed --sshloginfile hosts
  check "it redoes only what is missing" grep -qE '^chapter4: 14 episodes, ([1-9]|1[0-3]) of them done' killed.err
  check "the same results" same_results
  check "nothing unfinished is left" test ! -e killed/chapter4/.unfinished
  check_refused "results of another build" 2 made_with.txt other_build
  check_refused "no such study" 2 'no such study' "$root/replay/reproduce" chapter99
  check_refused "a count that is none" 2 episodes "$root/replay/reproduce" chapter4 --episodes 0
  finish_test
}

reproduce() { "$root/replay/reproduce" chapter4 --episodes 2 --out "$1" "${@:2}" >"$1.out" 2>"$1.err"; }

sums_agree() (cd whole/latest && sha256sum --quiet -c SHA256SUMS)

# Kills the whole run once episodes are done and others are at work.
kill_in_the_middle() {
  setsid "$root/replay/reproduce" chapter4 --episodes 2 --jobs 2 --out killed >/dev/null 2>&1 &
  local run=$!
  until is_in_the_middle; do
    kill -0 "$run" || break
    sleep 0.05
  done
  kill -9 -- "-$run"
  wait "$run" 2>/dev/null || true
  check "killed before the end" test ! -e killed/chapter4/report.html
}

is_in_the_middle() { [[ -d killed/chapter4/.unfinished && $(compgen -G 'killed/chapter4/*/*/bound.csv' | wc -l) -ge 2 ]]; }

same_results() {
  local file
  while read -r file; do
    case $file in
      *_metrics.json) cmp <(jq 'del(.timing)' "whole/$file") <(jq 'del(.timing)' "killed/$file") || return ;;
      *) cmp "whole/$file" "killed/$file" || return ;;
    esac
  done < <(cd whole && find chapter4/*/*/ -type f && find chapter4/report_files -name '*_episodes.csv' -o -name '*_comparisons.csv')
  diff <(cd whole && find . | sort) <(cd killed && find . | sort)
}

# The same programs but one.
other_build() {
  mkdir -p other_bin
  cp "$bin"/{sdf2d-slam,occupancy2d-slam,sensor-bridge,ground-truth-logger,evaluator} other_bin
  echo >>other_bin/sdf2d-slam
  LCMSLAM_BIN=$PWD/other_bin "$root/replay/reproduce" chapter4 --episodes 2 --out whole
}

main "$@"

# Checks of what lcm-spy showed. Sourced after script.sh and desktop.sh.
# shellcheck shell=bash
# shellcheck disable=SC2154  # root comes from script.sh

need_desktop() {
  local lacking
  lacking=$(desktop_lacks)
  [[ -z $lacking ]] || { echo "SKIPPED: no $lacking" && exit 77; }
}

# check_channels SPY CHANNEL...: it listed all, and decoded every message of every channel.
check_channels() {
  local list=$1/channels.tsv channel
  for channel in "${@:2}"; do check "$1: $channel is listed" grep -P "^$channel\t" "$list"; done
  # LCM_SELF_TEST is text that LCM sends to itself.
  # shellcheck disable=SC2016  # for awk to expand
  check "$1: all are decoded" awk -F '\t' '{ print } $1 != "LCM_SELF_TEST" && $NF != 0 { bad = 1 } END { exit bad }' "$list"
}

# pixels ...: see Pixels.
pixels() {
  [[ -e pixels/Pixels.class ]] || javac -d pixels "$root/tests/support/Pixels.java"
  java -cp pixels Pixels "$@"
}

# color NAME: of the views.
color() { sed -n "s/.*$1 = new Color(0x\([0-9A-F]*\)).*/\1/p" "$root/lcmtypes/spy/lcmslam/spy/Palette.java"; }

# at_least VALUE LIMIT
at_least() { at_most "$2" "$1"; }

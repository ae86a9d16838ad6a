# A screen that nobody looks at, and lcm-spy on it, worked by SpyDriver. Sourced after common.sh, network.sh and processes.sh,
# in a folder of one's own.
# shellcheck shell=bash
# shellcheck disable=SC2154  # root, bin and lcm_url come from those

# The first program or file that is missing; nothing when all is there.
desktop_lacks() {
  local program
  for program in Xvfb javac java; do
    command -v "$program" >/dev/null || { echo "$program" && return; }
  done
  [[ -r $(dirname "$bin")/lcmslam-spy.jar ]] || echo lcmslam-spy.jar
}

# Starts a screen and sets DISPLAY.
open_desktop() {
  start Xvfb Xvfb.log Xvfb -displayfd 6 -screen 0 1600x1200x24 -nolisten tcp 6>display
  wait_until Xvfb test -s display
  DISPLAY=:$(<display)
  export DISPLAY
}

# Starts replay/spy, to be told what to do by do_in_spy.
open_spy() {
  mkdir shots classes
  javac -d classes "$root/replay/support/SpyDriver.java"
  printf 'Premain-Class: SpyDriver\n' >manifest
  jar cfm driver.jar manifest -C classes .
  JAVA_TOOL_OPTIONS="-javaagent:$PWD/driver.jar=$PWD/shots" start spy spy.log "$root/replay/spy" --lcm-url "$lcm_url"
  wait_until spy test -e shots/ready
}

# do_in_spy LINE...: see SpyDriver. Pictures are in shots/, and lcm-spy has ended afterwards.
do_in_spy() {
  printf '%s\n' "$@" >todo
  mv todo shots/todo
  finish spy
  [[ -e shots/done ]]
}

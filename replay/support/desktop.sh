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

# open_spy NAME [BEFORE...]: starts replay/spy as process NAME, by the command BEFORE if there is one, to be told what to do by
# do_in_spy. What it leaves is in the folder NAME/.
open_spy() {
  local name=$1
  shift
  mkdir "$name"
  [[ -e driver.jar ]] || make_driver
  JAVA_TOOL_OPTIONS="-javaagent:$PWD/driver.jar=$PWD/$name" start "$name" "$name.log" "$@" "$root/replay/spy" --lcm-url "$lcm_url"
  wait_until "$name" test -e "$name/ready"
}

make_driver() {
  mkdir driver
  javac --release 11 -d driver "$root/replay/support/SpyDriver.java"
  printf 'Premain-Class: SpyDriver\n' >driver/manifest
  jar cfm driver.jar driver/manifest -C driver .
}

# do_in_spy NAME LINE...: see SpyDriver. lcm-spy has ended afterwards.
do_in_spy() {
  tell_spy "$@"
  finish "$1"
  [[ -e $1/done ]]
}

# tell_spy NAME LINE...: the same without waiting for it.
tell_spy() {
  printf '%s\n' "${@:2}" >"$1.todo"
  mv "$1.todo" "$1/todo"
}

# A screen that nobody looks at, and lcm-spy on it, worked by SpyDriver. Sourced after script.sh.
# shellcheck shell=bash
# shellcheck disable=SC2154  # root, bin, work and lcm_url come from script.sh

spy_sources=$root/tests/e2e/spy

need_desktop() {
  local program
  for program in Xvfb javac java; do
    command -v "$program" >/dev/null || { echo "SKIPPED: no $program" && exit 77; }
  done
  [[ -r $(dirname "$bin")/lcmslam-spy.jar ]] || { echo "SKIPPED: no lcmslam-spy.jar" && exit 77; }
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
  javac -d classes "$spy_sources"/*.java
  printf 'Premain-Class: SpyDriver\n' >manifest
  jar cfm driver.jar manifest -C classes .
  JAVA_TOOL_OPTIONS="-javaagent:$work/driver.jar=$work/shots" start spy spy.log "$root/replay/spy" --lcm-url "$lcm_url"
  wait_until spy test -e shots/ready
}

# do_in_spy LINE...: see SpyDriver. lcm-spy has ended afterwards.
do_in_spy() {
  printf '%s\n' "$@" >todo
  mv todo shots/todo
  finish spy
  [[ -e shots/done ]]
}

# pixels ...: see Pixels.
pixels() { java -cp classes Pixels "$@"; }

# The colours of lcmtypes/spy/lcmslam/spy/Palette.java.
color() { sed -n "s/.*$1 = new Color(0x\([0-9A-F]*\)).*/\1/p" "$root/lcmtypes/spy/lcmslam/spy/Palette.java"; }

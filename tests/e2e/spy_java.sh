#!/usr/bin/env bash
# Our jars hold nothing newer than Java 11 understands, and lcm-spy opens its views on every Java of the folder
# LCMSLAM_JVMS, /usr/lib/jvm by default.
set -euo pipefail
. "$(dirname "$0")/../support/script.sh"
. "$root/replay/support/desktop.sh"
. "$root/tests/support/pictures.sh"
need_desktop

newest_classes=55 # Java 11's

main() {
  local jar
  for jar in lcmslam lcmslam-spy; do
    mkdir "$jar"
    (cd "$jar" && jar xf "$(dirname "$bin")/$jar.jar")
    check "$jar.jar: for Java 11 or older" at_most "$(newest_class "$jar")" "$newest_classes"
    check "$jar.jar: uses nothing that Java is to lose" uses_nothing_doomed "$(dirname "$bin")/$jar.jar"
  done
  "$bin/sensor-bridge" simulate --episode "$root/replay/episodes/room5_low.pbtxt" --set duration_s=5 --quiet --log-out input.lcm >/dev/null
  "$bin/sdf2d-slam" --quiet --log-in input.lcm --log-out run.lcm
  claim_bus
  open_desktop
  local java
  for java in "${LCMSLAM_JVMS:-/usr/lib/jvm}"/*/bin/java; do
    [[ -L ${java%/bin/java} ]] || check_spy "$java"
  done
  finish_test
}

# newest_class FOLDER: the class file version is the fourth pair of bytes.
newest_class() { find "$1" -name '*.class' -exec od -An -j 6 -N 2 -t u1 {} \; | awk '{ print 256 * $1 + $2 }' | sort -n | tail -n 1; }

uses_nothing_doomed() {
  jdeprscan --for-removal --class-path "/usr/share/java/lcm.jar:/usr/share/java/jchart2d.jar:$(dirname "$bin")/lcmslam.jar" "$1" >doomed 2>&1 || return 1
  cat doomed
  ! grep -q 'forRemoval=true' doomed
}

check_spy() {
  local name
  name=$(basename "${1%/bin/java}")
  open_spy "$name" env PATH="${1%/java}:$PATH"
  tell_spy "$name" "open SDF2D_MAP map" close "open SDF2D_SLAM_STATUS health"
  while is_running "$name"; do play_run; done
  check "$name: $("$1" -version 2>&1 | head -n 1)" finish_spy "$name"
}

play_run() { lcm-logplayer --speed=5 --lcm-url="$lcm_url" run.lcm >player.log 2>&1; }

finish_spy() {
  finish "$1"
  cat "$1.log"
  [[ -s $1/map.png && -s $1/health.png && -e $1/done ]]
}

main "$@"

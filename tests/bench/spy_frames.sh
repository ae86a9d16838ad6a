#!/usr/bin/env bash
# spy_frames.sh [PICTURE.png]: what a frame of the 3D view of 30000 points and 20000 surfels costs.
set -euo pipefail
. "$(dirname "$0")/../../replay/support/common.sh"
ensure_built lcmslam_jar lcmslam_spy_jar

jars=/usr/share/java/lcm.jar:$(dirname "$bin")/lcmslam.jar:$(dirname "$bin")/lcmslam-spy.jar
classes=$(mktemp -d)
trap 'rm -r "$classes"' EXIT
javac -cp "$jars" -d "$classes" "$root"/tests/bench/spy/lcmslam/spy/*.java
java -Djava.awt.headless=true -cp "$classes:$jars" lcmslam.spy.FrameTimes "$@"

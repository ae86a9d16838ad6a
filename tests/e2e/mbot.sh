#!/usr/bin/env bash
# A student robot that turns on the spot at 3 rad/s from one scan to the next, scans only, default configuration: it stays on
# the way that the robot's own SLAM, which has wheel encoders, tells.
set -euo pipefail
. "$(dirname "$0")/../support/script.sh"
need_data mbot/convex.lcm

"$bin/sdf2d-slam" --quiet --log-in "$data/mbot/convex.lcm" --log-out run.lcm --out .
check "2 cm and 0.03 rad from the robot's SLAM on average" \
  "$bin/evaluator" --log-in run.lcm --estimate SDF2D_POSE --reference SLAM_POSE \
  --max-mean 0.02 --max-rotation 0.03 --min-coverage 0.99
finish_test

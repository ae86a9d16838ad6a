#!/usr/bin/env bash
# large_trajectory.sh [POSES]
#
# Writes two TUM files of so many poses (default: ten million, 1 GB each) and evaluates the one by the other. Prints the
# result, the seconds and the memory that it took.
set -euo pipefail
. "$(dirname "$0")/../support/script.sh"

poses=${1:-10000000}

main() {
  write_trajectory 0 >reference.tum
  write_trajectory 0.02 >estimate.tum
  cat reference.tum estimate.tum >/dev/null # the disk is not what is measured
  /usr/bin/time --format '%e s, %M kB' "$bin/evaluator" --estimate estimate.tum --reference reference.tum
}

# write_trajectory NOISE_M: rounds of 30 m radius at 0.9 m/s and 100 Hz, in the stamps of a real clock.
write_trajectory() {
  awk -v poses="$poses" -v noise_m="$1" '
    BEGIN {
      srand(1)
      for (i = 0; i < poses; ++i) {
        angle = 0.0003 * i
        half_yaw = angle / 2 + 0.785398163
        printf "%.6f %.9f %.9f %.9f 0.000000000 0.000000000 %.9f %.9f\n", 1700000000 + 0.01 * i,
          30 * cos(angle) + 1e-5 * i + noise_m * (rand() - 0.5), 30 * sin(angle) + noise_m * (rand() - 0.5),
          0.5 * sin(0.001 * i) + noise_m * (rand() - 0.5), sin(half_yaw), cos(half_yaw)
      }
    }'
}

main "$@"

#!/usr/bin/env bash
# lcm-spy on both of two hosts during a run across them, over a good cable and a bad one: each lists every channel and decodes
# every message, its own host's and the other's.
set -euo pipefail
. "$(dirname "$0")/../support/script.sh"
. "$root/replay/support/desktop.sh"
. "$root/replay/support/live_run.sh"
. "$root/tests/support/pictures.sh"
. "$root/tests/support/two_hosts.sh"
need_desktop
require_two_hosts "$root/tests/e2e/two_hosts_spy.sh" "$@"

lcm_url="udpm://239.255.76.67:7667?ttl=1&recv_buf_size=2097152"

main() {
  open_desktop
  connect_hosts
  watch good-planar sdf2d-slam room5_low LIDAR_2D SDF2D
  watch good-spatial octo3d-slam hall10_low LIDAR_3D OCTO3D
  disconnect_hosts
  connect_hosts_lossily 0.02 0.05 1
  watch bad-planar sdf2d-slam room5_low LIDAR_2D SDF2D
  watch bad-spatial octo3d-slam hall10_low LIDAR_3D OCTO3D
  disconnect_hosts
  finish_test
}

# watch NAME SLAM_SERVICE EPISODE LIDAR_CHANNEL PREFIX: a run, sensors on one host and the rest on the other, until 50 poses are
# there.
watch() {
  local name=$1 service=$2 episode=$3 lidar=$4 prefix=$5 host
  mkdir "$name"
  cd "$name"
  for host in lidar slam; do open_spy "$name-$host" ip netns exec "$host"; done
  start "$service" "$service.log" "${on_slam[@]}" "$bin/$service" --out out --lcm-url "$lcm_url"
  start evaluator evaluator.log "${on_slam[@]}" "$bin/evaluator" --estimate "${prefix}_POSE" --lcm-url "$lcm_url"
  for service in "$service" evaluator; do wait_until "$service" says_ready "$service"; done
  start sensor-bridge sensor-bridge.log "${on_lidar[@]}" "$bin/sensor-bridge" simulate --quiet --lcm-url "$lcm_url" \
    --episode "$root/replay/episodes/$episode.pbtxt" --set duration_s=300
  wait_until sensor-bridge has_poses "$2" 50
  for host in lidar slam; do
    check "$name: spy on host $host" do_in_spy "$name-$host" table
    check_channels "$name-$host" "$lidar" GROUND_TRUTH "${prefix}_POSE" "${prefix}_DIAGNOSTICS" "${prefix}_MAP" EVALUATION \
      SENSOR_BRIDGE_STATUS EVALUATOR_STATUS
  done
  for service in sensor-bridge "$2" evaluator; do stop "$service"; done
  cd ..
}

main "$@"

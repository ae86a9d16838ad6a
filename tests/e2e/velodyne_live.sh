#!/usr/bin/env bash
# A VLP-16's own packets, sent over UDP: what `sensor-bridge velodyne` hears and decodes equals the import of the file.
set -euo pipefail
. "$(dirname "$0")/../support/script.sh"
need_data packets/einride_vlp16.bin

payloads="$data/packets/einride_vlp16.bin" # 1000 of 1206 bytes, 12 whole turns
batch=20                                   # fits default kernel buffers

main() {
  start bridge bridge.log "$bin/sensor-bridge" velodyne --port 0 --packets --log-out heard.lcm
  wait_until bridge says_ready bridge
  sensor_port=$(sed -n 's/.*hears UDP port //p' bridge.log)
  send_payloads
  stop bridge

  "$bin/sensor-bridge" import velodyne "$payloads" --quiet --log-out imported.lcm
  check "every packet is heard" test "$(count LIDAR_3D_PACKET heard.lcm)" = 1000
  check "every chunk is published" test "$(count LIDAR_3D heard.lcm)" = "$(count LIDAR_3D imported.lcm)"
  "$bin/sensor-bridge" import velodyne heard.lcm --log-out again.lcm 2>again.err
  check "12 turns" grep -q '12 sweeps on LIDAR_3D' again.err
  finish_test
}

count() { "$bin/log-info" --count "$1" "$2"; }

# dd writes a block, which is a datagram, at a time.
send_payloads() {
  local sent
  for ((sent = 0; sent < 1000; sent += batch)); do
    dd if="$payloads" bs=1206 skip=$sent count=$batch status=none >"/dev/udp/127.0.0.1/$sensor_port"
    wait_until bridge all_is_read
  done
}

all_is_read() { [[ $(ss -lunH "sport = :$sensor_port" | awk '{ print $2 }') == 0 ]]; }

main "$@"

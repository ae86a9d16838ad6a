#!/usr/bin/env bash
# The status of sensor-bridge, which hears a VLP-16, tells within two seconds, with numbers, when packets stop, are skipped, come
# late or slowly, flood it or are none.
set -euo pipefail
. "$(dirname "$0")/../support/script.sh"
. "$root/tests/support/statuses.sh"
need_data packets/einride_vlp16.bin

payloads="$data/packets/einride_vlp16.bin" # 1000 of 1206 bytes
batch=20                                   # fits default kernel buffers

main() {
  claim_bus
  log_statuses
  start bridge bridge.log "$bin/sensor-bridge" velodyne --port 0 --lcm-url "$lcm_url"
  wait_until bridge says_ready bridge
  sensor_port=$(sed -n 's/.*hears UDP port //p' bridge.log)

  send_payloads 0 1000 # lasts longer than from one status to the next
  check "well while packets come" hear sensor-bridge any 'state != "WAITING" && processed > 0 && missing == 0'
  check "starved, and for how long" tells sensor-bridge "$sent" WAITING 'text ~ /no input for [0-9.]+ s/'
  send_payloads 0 400
  send_payloads 500 1000
  check "skipped: how many, and where" tells sensor-bridge "$begun" any 'missing >= 99 && text ~ /missing on LIDAR_3D_PACKET/'
  hold_up
  check "held up: how late it is" tells sensor-bridge "$(now)" any 'p99 >= 1000'
  send_slowly
  check "slowed: how slow" tells sensor-bridge "$begun" DEGRADED 'text ~ /input at 0[.][0-9]+ of real time, [0-9.]+ Hz/'
  begun=$(now)
  dd if=/dev/zero bs=1206 count=3 status=none >"/dev/udp/127.0.0.1/$sensor_port"
  check "malformed: how many" tells sensor-bridge "$begun" any 'refused == 3'
  flood
  check "flooded: how many were lost" tells sensor-bridge "$(now)" any 'kernel_dropped > 100'
  stop bridge
  stop logger
  finish_test
}

now() { date +%s.%N; }

# send_payloads FROM TO: near their own pace. dd writes a block, which is a datagram, at a time. `begun` and `sent`: from when to
# when.
send_payloads() {
  local next
  begun=$(now)
  for ((next = $1; next < $2; next += batch)); do
    send_batch "$next"
    sleep 0.027
    wait_until bridge all_is_read
  done
  sent=$(now)
}

# 27 ms of packets each 0.1 s.
send_slowly() {
  local i
  begun=$(now)
  for ((i = 0; i < 25; i++)); do
    send_batch $((batch * i))
    sleep 0.1
  done
}

hold_up() {
  kill -STOP "${pid_of[bridge]}"
  send_batch 0
  sleep 1.3
  kill -CONT "${pid_of[bridge]}"
}

send_batch() { dd if="$payloads" bs=1206 skip="$1" count=$batch status=none >"/dev/udp/127.0.0.1/$sensor_port"; }

all_is_read() { [[ $(ss -lunH "sport = :$sensor_port" | awk '{ print $2 }') == 0 ]]; }

# More than any buffer holds, while it cannot read.
flood() {
  local i
  kill -STOP "${pid_of[bridge]}"
  for ((i = 0; i < 10; i++)); do dd if="$payloads" bs=1206 status=none >"/dev/udp/127.0.0.1/$sensor_port"; done
  kill -CONT "${pid_of[bridge]}"
}

main "$@"

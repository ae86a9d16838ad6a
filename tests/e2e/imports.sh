#!/usr/bin/env bash
# Every format that sensor-bridge imports, from real files: what comes out, and one line for what is wrong.
set -euo pipefail
. "$(dirname "$0")/../support/script.sh"
need_data hilti2021_uzh_run2 kitti_raw_0005 vlp16_indoor packets jarvis guardian mbot

main() {
  imports "40 sweeps" kitti "$data/hilti2021_uzh_run2" --rate 2
  holds GROUND_TRUTH 40
  imports "8 sweeps" kitti "$data/kitti_raw_0005" --turn 0.1 --lidar hdl64e
  imports "10 sweeps" kitti "$data/vlp16_indoor" --lidar vlp16
  imports "3 sweeps" velodyne "$data/packets/vlp16_gps.pcap" --packets
  holds LIDAR_3D_PACKET 293
  imports "2 sweeps" velodyne "$data/packets/hdl32.pcap"
  imports "12 sweeps" velodyne "$data/packets/einride_vlp16.bin"
  imports "213 scans" rosbag "$data"/jarvis/*.bag
  holds GROUND_TRUTH 204
  imports "1038 scans" rosbag "$data/guardian/guardian_3.bag"
  imports "459 scans" mbot "$data/mbot/convex.lcm"
  same_bytes_again
  refuses
  finish_test
}

# imports WHAT FORMAT FILE OPTION...: into imported.lcm; WHAT stands in the summary.
imports() {
  local what=$1
  shift
  echo "== import $*"
  check "$what" summary_says "$what on " "$@"
}

summary_says() {
  local what=$1
  shift
  "$bin/sensor-bridge" import "$@" --log-out imported.lcm 2>&1 | tee summary
  grep -q "$what" summary
}

# holds CHANNEL MESSAGES
holds() { check "$2 on $1" test "$("$bin/log-info" --count "$1" imported.lcm)" = "$2"; }

same_bytes_again() {
  for log in one two; do
    "$bin/sensor-bridge" import velodyne "$data/packets/vlp16_gps.pcap" --packets --quiet --log-out $log.lcm
  done
  check "same input, same bytes" cmp one.lcm two.lcm
}

refuses() {
  local import=("$bin/sensor-bridge" import) out=(--quiet --log-out refused.lcm)
  check_refused "another sensor's capture" 3 "OS-1-64.*no packet of a VLP-16 or HDL-32E$" \
    "${import[@]}" velodyne "$data/packets/OS-1-64_1024x10_fw20.pcap" "${out[@]}"
  head -c 300000 "$data/packets/vlp16_gps.pcap" >cut.pcap
  check_refused "a capture that was cut off" 3 "cut.pcap: truncated" "${import[@]}" velodyne cut.pcap "${out[@]}"
  mkdir scans && head -c 1001 "$data/vlp16_indoor/000000.bin" >scans/0.bin
  check_refused "a scan that was cut off" 3 "scans/0.bin: 1001 bytes" "${import[@]}" kitti scans "${out[@]}"
  echo 0.1 >scans/times.txt && echo 1 2 3 >scans/poses.txt
  check_refused "poses that are none" 3 "scans/poses.txt: line 1: 3 numbers" "${import[@]}" kitti scans "${out[@]}"
  rm scans/poses.txt
  for format in pcd ply; do
    head -c 1000 "$data/packets/hdl32.pcap" >"scans/0.$format"
    check_refused "rubbish as $format" 3 "scans/0.$format: " "${import[@]}" $format scans "${out[@]}"
  done
  check_refused "no such folder" 3 "none: no such file" "${import[@]}" kitti none "${out[@]}"
  check_refused "a lidar that is none" 2 "--lidar: 'sick'" "${import[@]}" kitti scans --lidar sick "${out[@]}"
}

main "$@"

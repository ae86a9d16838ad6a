#!/usr/bin/env bash
# What is lost of a VLP-16 that octo3d-slam hears live over UDP for 20 s, by the receive buffer it asks for. The first row is a
# kernel's default; the second is what the services' own URL gets where net.core.rmem_max is 212992, as on a fresh Debian.
#   tests/bench/live_losses.sh [RUNS]
set -euo pipefail
. "$(dirname "$0")/../support/script.sh"

runs=${1:-1}
episode=(--episode "$root/replay/episodes/hall10_rated_distortion.pbtxt" --set duration_s=20 --quiet)

main() {
  sysctl net.core.rmem_default net.core.rmem_max
  claim_bus
  printf '%-26s %-12s %-9s %-9s %s\n' asked "buffer (B)" received missing load
  local run asked
  for ((run = 0; run < runs; run++)); do
    for asked in "" "&recv_buf_size=212992" "&recv_buf_size=2097152"; do play "$asked"; done
  done
}

# play ASKED: a part of the URL.
play() {
  local buffer
  start slam slam.log "$bin/octo3d-slam" --lcm-url "${lcm_url%&recv_buf_size=*}$1" --out live
  wait_until slam says_ready slam
  buffer=$(ss -uamn "sport = :$(port)" | grep -oE 'rb[0-9]+' | head -1)
  "$bin/sensor-bridge" simulate "${episode[@]}" --lcm-url "$lcm_url" >/dev/null
  stop slam
  printf '%-26s %-12s %-9s %-9s %s\n' "${1:-nothing}" "${buffer#rb}" "$(count received)" "$(count missing)" \
    "$(cut -d' ' -f1 /proc/loadavg)"
}

port() {
  local port=${lcm_url##*:}
  echo "${port%%\?*}"
}

# count WHAT: of the summary; 0 when it does not say.
count() { grep -oE "[0-9]+ $1" slam.log | cut -d' ' -f1 || echo 0; }

main

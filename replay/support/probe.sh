# Tries the bus at `url` with LCM's own tools. Sourced by replay/doctor after processes.sh.
# shellcheck shell=bash
# shellcheck disable=SC2154  # url and port are set by the one who sources this

# Whether LCM is refused the port.
port_refused() {
  local folder
  folder=$(mktemp -d)
  timeout 1 lcm-logger --quiet --lcm-url="$url" "$folder/heard.lcm" >"$folder/says" 2>&1 || true
  grep -q '^bind: ' "$folder/says" || { rm -r "$folder" && return 1; }
  rm -r "$folder"
}

# probe_bus COUNT BYTES: sends so many messages of this size at once and prints how many arrived within some seconds.
probe_bus() {
  local folder channel=DOCTOR deadline=$((SECONDS + 5))
  folder=$(mktemp -d)
  messages "$@" "$channel" >"$folder/sent.lcm"
  start listener "$folder/listener.log" lcm-logger --quiet --channel="$channel" --lcm-url="$url" "$folder/heard.lcm"
  # Its socket is there before it subscribes, so what is sent first may pass it by.
  until [[ -s $folder/heard.lcm ]] || ((SECONDS >= deadline)); do
    sleep 0.3
    lcm-logplayer --speed=0 --lcm-url="$url" "$folder/sent.lcm" >"$folder/sender.log" 2>&1 || true
    sleep 0.3 # lcm-logger writes ten times a second
  done
  stop_all
  LC_ALL=C grep -aob "$channel" "$folder/heard.lcm" | wc -l
  rm -r "$folder"
}

# messages COUNT BYTES CHANNEL: an LCM log.
messages() {
  local i
  for ((i = 0; i < $1; i++)); do
    printf '\xed\xa1\xda\x01'
    big_endian 8 "$i"
    big_endian 8 $((i + 1))
    big_endian 4 ${#3}
    big_endian 4 "$2"
    printf %s "$3"
    head -c "$2" /dev/zero
  done
}

# big_endian SIZE NUMBER
big_endian() {
  local hex
  printf -v hex "%0$((2 * $1))x" "$2"
  for (( ; ${#hex} > 0; )); do
    printf '%b' "\\x${hex:0:2}"
    hex=${hex:2}
  done
}

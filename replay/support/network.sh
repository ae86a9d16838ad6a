# The bus of a live run: a multicast route, and a port that no other run on this host uses.
# shellcheck shell=bash
# shellcheck disable=SC2034  # used by those who source this

# LCM_URL of this run, set by claim_bus.
lcm_url=

# require_multicast COMMAND ARGUMENT...
# Returns where a multicast route exists. Elsewhere runs COMMAND, which is to be this very run, in a network namespace
# that has one, and does not return.
require_multicast() {
  ! ip route get 239.255.76.67 >/dev/null 2>&1 || return 0
  local add_route='ip link set lo up && ip route add 224.0.0.0/4 dev lo'
  unshare -rn sh -c "$add_route" 2>/dev/null ||
    die "no multicast route, and none can be made in a namespace of our own; as root: $add_route"
  exec unshare -rn sh -c "$add_route && exec \"\$@\"" sh env LCMSLAM_BIN="$bin" "$@"
}

# Finds a UDP port for this run and holds it, through a lock that this shell and its children keep, until the last of them ends:
# LCM 1.3.1 hears other runs on the same port even when their multicast address is another.
claim_bus() {
  local locks port
  locks=/tmp/lcm-slam-ports.$(id -u)
  mkdir -p "$locks"
  for ((port = 7700; port < 7900; port++)); do
    exec {port_lock}>"$locks/$port"
    if flock -n "$port_lock" && port_is_free "$port"; then
      lcm_url="udpm://239.255.76.67:$port?ttl=0&recv_buf_size=2097152"
      return
    fi
    exec {port_lock}>&-
  done
  die "no free UDP port in 7700..7899"
}

port_is_free() { [[ -z $(ss -lunH "sport = :$1") ]]; }

# Whether process $1 listens on the port of this run's bus.
listens() {
  local port=${lcm_url##*:}
  ss -lunpH "sport = :${port%%\?*}" | grep -q "pid=$1,"
}

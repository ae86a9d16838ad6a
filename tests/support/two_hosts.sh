# Two hosts, the network namespaces `lidar` and `slam`, on one cable. Sourced after script.sh.
# shellcheck shell=bash
# shellcheck disable=SC2034,SC2154  # for those who source this; bin and work come from script.sh

# require_two_hosts COMMAND ARGUMENT...: runs COMMAND, which is to be this very script, where hosts can be made.
require_two_hosts() {
  [[ -z ${LCMSLAM_HOSTS:-} ]] || return 0
  unshare -rnm sh -c 'mount -t tmpfs hosts /run && ip netns add lidar' 2>/dev/null ||
    { echo "SKIPPED: no network namespaces here" && exit 77; }
  cd / && rm -r "$work" # the one there gets its own
  mkdir -p -m 1777 /tmp/.X11-unix
  # A route, so that nothing looks for another place to run in. Screens of our own: programs on the hosts find them by their file,
  # which the screen of another run would replace.
  LCMSLAM_HOSTS=yes exec unshare -rnm sh -c \
    'ip link set lo up && ip route add 224.0.0.0/4 dev lo && mount -t tmpfs hosts /run && mount -t tmpfs screens /tmp/.X11-unix &&
    exec "$@"' sh "$@"
}

# Before a command: to run it on that host.
on_lidar=(ip netns exec lidar) on_slam=(ip netns exec slam)

# One hop, as Ethernet has it.
connect_hosts() {
  make_hosts
  ip link add eth0 netns lidar type veth peer name eth0 netns slam
  address_hosts
}

# connect_hosts_lossily LOSS REORDER SEED: by lossy_link, between two plugs in this namespace.
connect_hosts_lossily() {
  make_hosts
  local host
  for host in lidar slam; do
    ip link add eth0 netns "$host" type veth peer name "plug_$host"
    ip link set "plug_$host" up
  done
  address_hosts
  start link link.log "$bin/lossy_link" plug_lidar plug_slam "$@"
  wait_until link says_ready link
}

make_hosts() {
  local host
  for host in lidar slam; do
    ip netns add "$host"
    ip netns exec "$host" sysctl -qw net.ipv4.ipfrag_high_thresh=67108864 net.ipv4.ipfrag_time=1
  done
}

address_hosts() {
  local host number=1
  for host in lidar slam; do
    ip -n "$host" link set lo up
    ip -n "$host" address add "192.0.2.$((number++))/24" dev eth0
    ip -n "$host" link set eth0 up
    ip -n "$host" route add 224.0.0.0/4 dev eth0
  done
}

# Takes hosts and cable away.
disconnect_hosts() {
  [[ -z ${pid_of[link]:-} ]] || stop link
  ip netns delete lidar
  ip netns delete slam
}

#!/usr/bin/env bash
# replay/doctor on hosts (network namespaces) with one fault each: it says which, fails when live runs cannot work, and the
# command it gives mends it.
set -euo pipefail
. "$(dirname "$0")/../support/script.sh"
unshare -rnm true 2>/dev/null || { echo "SKIPPED: no network namespaces here" && exit 77; }

here='udpm://239.255.76.67:7667?ttl=0' abroad='udpm://239.255.76.67:7667?ttl=1'
wide="$here&recv_buf_size=2097152"
export doctor=$root/replay/doctor here

main() {
  check "a healthy host" finds 0 'Live runs work' healthy "$wide"
  check "a healthy host in a network" finds 0 'ttl=1: messages cross 1' networked "$abroad"
  check "no route" mends 'FAULT    route: none' isolated "$here"
  check "route kept on this host" mends 'FAULT    ttl=1 .*, but the route' kept_at_home "$abroad"
  check "interface that is down" mends 'FAULT    ttl=1 .*, but the route' shut_down "$abroad"
  check "interface without multicast" mends 'FAULT    ttl=1: eth0 does not send multicast' unicast_only "$abroad"
  check "port taken" mends 'FAULT    port 7667: taken by perl' port_taken "$here"
  check "port shared" finds 0 'warning  port 7667: lcm-logger' port_shared "$here"
  check "small default buffer" mends 'FAULT    receive buffer' small_default_buffer "$here"
  check "small buffer limit" mends 'FAULT    receive buffer' small_buffer_limit "$wide"
  check "little memory for fragments" mends 'FAULT    fragments' little_for_fragments "$abroad"
  check "memory for fragments at a loss" finds 0 'warning  fragments: 4194304 bytes' fragments_by_default "$abroad"
  check "memory for fragments" finds 0 'ok       fragments' much_for_fragments "$abroad"
  if command -v nft >/dev/null; then
    check "firewall" mends 'FAULT    delivery: .* none' walled "$here"
  else
    echo "SKIPPED: firewall: no nft"
  fi
  check "no LCM" finds 1 'FAULT    LCM: no lcm-logger' without_lcm "$here"
  check "no Java" finds 0 'warning  Java: none' without_java "$here"
  check "old Java" finds 0 'warning  Java 1.7' with_old_java "$here"
  check "no jchart2d" finds 0 'warning  Java: no jchart2d.jar' without_jchart2d "$here"
  check_refused "a URL of another kind" 2 'memq' "$doctor" --lcm-url memq://
  finish_test
}

# Hosts. The kernel has the buffer sizes once for all namespaces, so a file is mounted over them.
isolated() { :; }
healthy() { ip link set lo up && ip route add 224.0.0.0/4 dev lo; }
connected() {
  ip link set lo up
  ip link add eth0 type veth peer name far
  ip address add 192.0.2.1/24 dev eth0
  ip link set eth0 up
  ip link set far up
}
networked() { connected && ip route add 224.0.0.0/4 dev eth0; }
kept_at_home() { connected && ip route add 224.0.0.0/4 dev lo; }
shut_down() { kept_at_home && ip link set eth0 down && ip link set far down; }
unicast_only() { networked && ip link set eth0 multicast off; }
port_taken() {
  healthy
  perl -MSocket -e 'socket(S, PF_INET, SOCK_DGRAM, 0); bind(S, sockaddr_in(7667, INADDR_ANY)) or die; sleep' &
  listening
}
port_shared() {
  healthy
  lcm-logger --quiet --lcm-url="${here/255.76.67/1.1.1}" other.lcm &
  listening
}
listening() { until [[ -n $(ss -lunH "sport = :7667") ]]; do sleep 0.05; done; }
small_default_buffer() { healthy && shrink rmem_default; }
small_buffer_limit() { healthy && shrink rmem_max; }
shrink() { echo 20000 >small && mount --bind small "/proc/sys/net/core/$1"; }
little_for_fragments() { networked && sysctl -qw net.ipv4.ipfrag_low_thresh=10000 net.ipv4.ipfrag_high_thresh=20000; }
fragments_by_default() { networked && sysctl -qw net.ipv4.ipfrag_high_thresh=4194304 net.ipv4.ipfrag_time=30; }
much_for_fragments() { networked && sysctl -qw net.ipv4.ipfrag_high_thresh=67108864 net.ipv4.ipfrag_time=1; }
walled() {
  healthy
  nft "add table inet wall; add chain inet wall input { type filter hook input priority 0; policy drop; }"
}
without_lcm() { healthy && cover lcm-logger /dev/null; }
without_java() { healthy && cover java /dev/null; }
with_old_java() {
  healthy
  printf '#!/bin/sh\necho version \\"1.7.0\\"\n' >java
  chmod +x java
  cover java java
}
without_jchart2d() { healthy && mount --bind /dev/null /usr/share/java/jchart2d.jar; }
# cover PROGRAM FILE
cover() { mount --bind "$2" "$(readlink -f "$(command -v "$1")")"; }

# finds CODE PATTERN HOST URL: on that host the doctor ends with the code and says the pattern.
finds() { on_host "$3" examine "$1" "$2" "$4"; }

# mends PATTERN HOST URL: the doctor fails and says the pattern; after the command below it all is well.
mends() { on_host "$2" examine_and_mend "$1" "$3"; }

# on_host HOST COMMAND ARGUMENT...
# shellcheck disable=SC2016  # for the shell in the namespace to expand
on_host() { unshare -rnm --pid --fork --kill-child --mount-proc bash -euc '"$1"; shift; "$@"' bash "$@"; }

# examine CODE PATTERN URL
examine() {
  local code=0
  "$doctor" --lcm-url "$3" >said 2>&1 || code=$?
  cat said
  [[ $code == "$1" ]] && grep -qE -- "$2" said
}

# examine_and_mend PATTERN URL
examine_and_mend() {
  examine 1 "$1" "$2"
  local mend
  mend=$(grep -E -A 1 -- "$1" said | sed -n 's/^ *mend: //p')
  echo "# $mend"
  eval "$mend"
  examine 0 'Live runs work' "$2"
  if grep -qE -- "$1" said; then return 1; fi
}

while read -r function; do export -f "${function?}"; done < <(compgen -A function)
main "$@"

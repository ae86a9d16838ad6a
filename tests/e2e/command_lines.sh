#!/usr/bin/env bash
# Every service: help, version, configuration round trip; one line and the right exit code for what is wrong.
set -euo pipefail
. "$(dirname "$0")/../support/script.sh"

services=(sdf2d-slam occupancy2d-slam cloud3d-slam ground-truth-logger)

main() {
  make_logs
  local service
  for service in "${services[@]}"; do
    echo "== $service"
    accepts "$bin/$service"
    refuses_configuration "$bin/$service"
    refuses_input "$bin/$service"
  done
  refuses_commands
  finish_test
}

# damaged.lcm: rubbish in the middle; cut.lcm: as a killed logger leaves it.
make_logs() {
  "$bin/mutated_log" good.lcm 20 1
  local size
  size=$(stat -c %s good.lcm)
  head -c $((size / 2)) good.lcm >half
  { cat half && head -c 5000 /dev/zero && tail -c +$((size / 2)) good.lcm; } >damaged.lcm
  head -c $((size - 7)) good.lcm >cut.lcm
  : >empty.lcm
  head -c 100000 /dev/zero | tr '\0' '\252' >rubbish.lcm
}

accepts() {
  check "--help" "$1" --help
  check "--version is a number" grep -qxE '[0-9]+\.[0-9]+\.[0-9]+' <("$1" --version)
  "$1" --print-config >printed.pbtxt
  check "the shipped configuration is the default" cmp printed.pbtxt "$root/services/$(basename "$1")/$(basename "$1").pbtxt"
  check "--print-config reads back as itself" cmp printed.pbtxt <("$1" --config printed.pbtxt --print-config)
  check "a log whose tail was cut off" "$1" --quiet --log-in cut.lcm --out here
  check "the effective configuration is left in --out" cmp printed.pbtxt "here/$(basename "$1").pbtxt"
}

refuses_configuration() {
  check_refused "unknown option" 2 "--frobnicate" "$1" --frobnicate
  check_refused "missing configuration" 2 "none.pbtxt" "$1" --config none.pbtxt
  echo 'frobnicate: 1' >unknown.pbtxt
  check_refused "unknown field" 2 "unknown.pbtxt:1.*frobnicate" "$1" --config unknown.pbtxt
  cat printed.pbtxt printed.pbtxt >twice.pbtxt
  check_refused "fields set twice" 2 "twice.pbtxt:[0-9]+" "$1" --config twice.pbtxt
  head -c 4000 good.lcm >random.pbtxt
  check_refused "binary configuration" 2 "random.pbtxt" "$1" --config random.pbtxt
  check_refused "unknown field in --set" 2 "frobnicate" "$1" --set frobnicate=1
  check_refused "--set without value" 2 "path=value" "$1" --set frobnicate
}

refuses_commands() {
  echo "== slam-command"
  check_refused "no command" 2 "subcommand" "$bin/slam-command"
  check_refused "no such command" 2 "subcommand" "$bin/slam-command" jump
  check_refused "half a pose" 2 "Y is required" "$bin/slam-command" pose 1
  check_refused "a pose in words" 2 "here" "$bin/slam-command" pose here 2 3
  check_refused "bus that is none" 2 "carrier-pigeon" "$bin/slam-command" reset --lcm-url carrier-pigeon://somewhere
}

refuses_input() {
  check_refused "missing log" 3 "none.lcm" "$1" --quiet --out here --log-in none.lcm
  check_refused "empty log" 3 "empty.lcm" "$1" --quiet --out here --log-in empty.lcm
  check_refused "no log at all" 3 "rubbish.lcm" "$1" --quiet --out here --log-in rubbish.lcm
  check_refused "damage in the middle" 3 "damaged.lcm" "$1" --quiet --out here --log-in damaged.lcm
  check_refused "output over input" 2 "log-out" "$1" --quiet --out here --log-in good.lcm --log-out good.lcm
  check_refused "output that cannot be written" 1 "none/out.lcm" "$1" --quiet --out here --log-in good.lcm --log-out none/out.lcm
  check_refused "bus that is none" 2 "carrier-pigeon" "$1" --out here --lcm-url carrier-pigeon://somewhere
  check_refused "address that is no multicast" 2 "10.0.0.1" "$1" --out here --lcm-url udpm://10.0.0.1:7667
  check_refused "tcpq server that is not there" 1 "tcpq" "$1" --out here --lcm-url tcpq://127.0.0.1:1
}

main "$@"

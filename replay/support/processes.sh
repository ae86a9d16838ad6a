# Processes of a run: started in the background, stopped by their pid, none outlives the run.
# shellcheck shell=bash

declare -A pid_of=() log_of=()

# start NAME LOG_FILE COMMAND ARGUMENT...
start() {
  local name=$1 log=$2
  shift 2
  : >"$log"
  "$@" >>"$log" 2>&1 &
  pid_of[$name]=$!
  log_of[$name]=$log
}

is_running() { kill -0 "${pid_of[$1]}" 2>/dev/null; }

# wait_until NAME CONDITION...: until the condition holds; the run ends when the process does so first or after a minute.
wait_until() {
  local name=$1 deadline=$((SECONDS + 60))
  shift
  until "$@"; do
    is_running "$name" || { finish "$name" && die "$name ended at once"; }
    ((SECONDS < deadline)) || die "$name: not ready after a minute"
    sleep 0.02
  done
}

says_ready() { grep -qx READY "${log_of[$1]}"; }

# finish NAME: waits for its end; when it failed the run ends with its exit code and the last line it wrote.
finish() {
  local code=0
  wait "${pid_of[$1]}" || code=$?
  unset "pid_of[$1]"
  ((code == 0)) || die "$1 ended with code $code: $(tail -n 1 "${log_of[$1]}")" "$code"
}

# stop NAME: asks it to end and waits until it has done so.
stop() {
  kill -TERM "${pid_of[$1]}" 2>/dev/null || true
  finish "$1"
}

# Ends what still runs, asking once.
stop_all() {
  local name
  for name in "${!pid_of[@]}"; do kill -TERM "${pid_of[$name]}" 2>/dev/null || true; done
  for name in "${!pid_of[@]}"; do
    timeout 5 tail --pid="${pid_of[$name]}" -f /dev/null || kill -KILL "${pid_of[$name]}" 2>/dev/null || true
    wait "${pid_of[$name]}" 2>/dev/null || true
  done
  pid_of=()
}
trap stop_all EXIT
trap 'exit 130' INT
trap 'exit 143' TERM

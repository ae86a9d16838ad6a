# Sourced first by every command of replay/ and tests/.
# Sets: root (of the project), bin (folder of the built programs).
# shellcheck shell=bash
# shellcheck disable=SC2034  # used by those who source this

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
# LCMSLAM_BIN: programs built elsewhere; then nothing is installed or built.
bin=${LCMSLAM_BIN:-$root/build/bin}

# The exit codes of every command of the project.
readonly exit_runtime=1 exit_usage=2 exit_bad_input=3 exit_nothing_matched=4

say() { printf '%s\n' "$*" >&2; }

# die LINE [EXIT_CODE]
die() {
  say "${0##*/}: $1"
  exit "${2:-$exit_runtime}"
}

# Prints the comment block at the head of the running script, without '# '.
help() { sed -n '2,/^[^#]/{/^#/s/^# \{0,1\}//p}' "$0"; }

# pose_channel SERVICE: where a SLAM service publishes its pose; sdf2d-slam -> SDF2D_POSE.
pose_channel() {
  local name=${1%-slam}
  printf '%s_POSE\n' "${name^^}"
}

# ensure_built [--tests] [CMAKE_TARGET...]: see replay/setup.
ensure_built() {
  [[ -n ${LCMSLAM_BIN:-} ]] || "$root/replay/setup" "$@"
}

# The results folder of a run.
# shellcheck shell=bash

results=

# open_results DIR NAME: makes a new folder DIR/<time>-NAME and sets `results` to it.
open_results() {
  local stem number=1
  stem=$1/$(date +%Y%m%d-%H%M%S)-$2
  mkdir -p "$1"
  results=$stem
  until mkdir "$results" 2>/dev/null; do
    ((++number < 100)) || die "$stem: cannot be made"
    results=$stem.$number
  done
}

# Writes SHA256SUMS and points the link `latest` beside the folder to it.
seal_results() {
  local sums
  sums=$(cd "$results" && find . -type f -printf '%P\0' | LC_ALL=C sort -z | xargs -0 sha256sum)
  printf '%s\n' "$sums" >"$results/SHA256SUMS"
  ln -sfn "$(basename "$results")" "$(dirname "$results")/latest"
}

# A study: which episodes go through which set-ups of which services. replay/studies/NAME.txt holds one, a line for each
#
#   title TEXT                                  heading of the report
#   note TEXT                                   below it
#   failure METRES                              an episode with a larger mean error has failed
#   simulate GROUP EPISODE COUNT [FIRST_SEED]   COUNT runs of replay/episodes/EPISODE.pbtxt; seeds from 1 unless given
#   recorded GROUP FORMAT FILE RELATIONS [ARGUMENT...]
#                                               a log below the data folder, as `sensor-bridge import FORMAT` reads it;
#                                               RELATIONS: file to judge it by, or - for its ground truth; arguments go to
#                                               every service
#   system NAME SERVICE [ARGUMENT...]           a set-up of a service; the first one is compared with the others
#   bench NAME PROGRAM FILTER SIZE              times from PROGRAM --benchmark_filter=FILTER over their first argument, which
#                                               SIZE describes, as NAME.csv and NAME.svg, and on the page
#
# Groups are summed up one by one. Arguments are those of the service's command line, at the root of the project.
# shellcheck shell=bash
# shellcheck disable=SC2034,SC2154  # with common.sh

study_title='' study_note='' study_failure_m=0.5 study_sources=() study_systems=() study_benches=()

# Where recorded logs are.
data=${LCMSLAM_DATA:-$root/../shared/data}

read_study() {
  local kind words
  while read -r kind words; do
    case $kind in
      '' | '#'*) ;;
      title) study_title=$words ;;
      note) study_note=$words ;;
      failure) study_failure_m=$words ;;
      simulate | recorded) study_sources+=("$kind $words") ;;
      bench) study_benches+=("$words") ;;
      system) study_systems+=("$words") ;;
      *) die "$1: $kind: no such kind of line" "$exit_usage" ;;
    esac
  done <"$1"
  ((${#study_sources[@]} && ${#study_systems[@]})) || die "$1: no episodes or no systems" "$exit_usage"
}

# list_episodes MAX: at most so many of each line; 'GROUP/NAME simulate EPISODE SEED' or 'GROUP/NAME recorded FORMAT ...'.
list_episodes() {
  local source kind group rest episode count seed file
  for source in "${study_sources[@]}"; do
    read -r kind group rest <<<"$source"
    if [[ $kind == simulate ]]; then
      read -r episode count seed <<<"$rest"
      : "${seed:=1}"
      for ((i = 0; i < count && i < $1; ++i)); do echo "$group/$episode-$((seed + i)) simulate $episode $((seed + i))"; done
    else
      read -r _ file _ <<<"$rest"
      if [[ -r $data/$file ]]; then
        file=${file##*/}
        echo "$group/${file%%.*} recorded $rest"
      else
        say "$data/$file: absent, left out"
      fi
    fi
  done
}

study_bench_programs() { printf '%s\n' "${study_benches[@]}" | awk 'NF { print $2 }' | sort -u; }

study_services() { printf '%s\n' "${study_systems[@]}" | awk '{ print $2 }' | sort -u; }

study_groups() { printf '%s\n' "${study_sources[@]}" | awk '!seen[$2]++ { print $2 }'; }

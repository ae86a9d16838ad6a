#!/usr/bin/env bash
# evaluator report on real results of two systems, opened in Chromium: nothing fails, every figure is drawn, on desktop and phone.
set -euo pipefail
. "$(dirname "$0")/../support/script.sh"

main() {
  make_results
  check "a page of many episodes" "$bin/evaluator" report results --out report.html
  check "a page of one run" "$bin/evaluator" report results/seed_1 --out run.html
  check "it needs nothing else" no_links report.html
  check_refused "no such folder" 3 nowhere "$bin/evaluator" report nowhere --out x.html
  check_refused "no results in it" 3 _metrics.json "$bin/evaluator" report report_files --out x.html
  check_refused "a rule that is none" 2 failure "$bin/evaluator" report results --failure 0 --out x.html
  if [[ -z $(command -v chromium) ]]; then
    finish_test
    echo "SKIPPED: no chromium" && exit 77
  fi
  for page in report run; do
    open_page "$page" 1280
    open_page "$page" 500
  done
  finish_test
}

make_results() {
  local seed system folder
  for seed in 1 2; do
    folder=results/seed_$seed
    mkdir -p "$folder"
    "$bin/sensor-bridge" simulate --episode "$root/replay/episodes/room5_low.pbtxt" --seed "$seed" --quiet --log-out input.lcm
    "$bin/sdf2d-slam" --quiet --timings --log-in input.lcm --log-out one.lcm --out "$folder"
    "$bin/occupancy2d-slam" --quiet --timings --log-in one.lcm --log-out run.lcm --out "$folder"
    "$bin/ground-truth-logger" --quiet --log-in input.lcm --out "$folder"
    for system in sdf2d-slam occupancy2d-slam; do
      "$bin/evaluator" --quiet --log-in run.lcm --estimate "$(pose_channel "$system")" --json "$folder/${system}_metrics.json"
    done
  done >/dev/null 2>&1
}

no_links() { ! grep -nE '(src|href)="(https?:|file:|/)|@import|url\(http' "$1"; }

# Measures every picture in the page as the browser lays it out.
open_page() {
  # shellcheck disable=SC2016  # JavaScript templates, not the shell's
  local probe='<script>addEventListener("load", () => {
    const bad = [...document.querySelectorAll("figure")].filter(f => {
      const svg = f.querySelector("svg"), img = f.querySelector("img");
      if (img) return img.naturalWidth < 10 || img.getBoundingClientRect().width < 100;
      return svg.getBoundingClientRect().width < 200 || svg.querySelectorAll("path").length < 10;
    });
    document.body.insertAdjacentHTML("beforeend", `<pre>figures ${document.querySelectorAll("figure").length} bad ${bad.length} ` +
      `overflow ${document.documentElement.scrollWidth - innerWidth}</pre>`);
  });</script>'
  { cat "$1.html" && echo "$probe"; } >probe.html
  chromium --headless --no-sandbox --disable-gpu --disable-quic --no-first-run --disable-background-networking \
    --disable-component-update --disable-sync --user-data-dir="$work/chromium" --enable-logging=stderr --v=0 \
    --window-size="$2,900" --dump-dom "file://$work/probe.html" >dom.txt 2>browser.txt || true
  check "$1 at $2 px: every figure is drawn, nothing sticks out" grep -E '^<pre>figures [1-9][0-9]* bad 0 overflow (0|-[0-9]+)<' dom.txt
  check "$1 at $2 px: no console messages" test "$(grep -c CONSOLE browser.txt)" = 0
}

main "$@"

#include "evaluator/report/style.h"

namespace lcmslam::report {

const char* const kStyleSheet = R"css(
:root { color-scheme: light dark; --ink: #1b1b1b; --soft: #5c5c5c; --paper: #ffffff; --panel: #f5f6f8; --line: #d9dce1; }
@media (prefers-color-scheme: dark) {
  :root { --ink: #e8e8e8; --soft: #a5a5a5; --paper: #16181b; --panel: #202327; --line: #3a3e44; }
}
* { box-sizing: border-box; }
body { margin: 0 auto; max-width: 80rem; padding: 1.5rem 1rem 4rem; background: var(--paper); color: var(--ink);
       font: 16px/1.5 system-ui, sans-serif; overflow-wrap: break-word; }
h1 { font-size: 1.7rem; line-height: 1.2; margin: 0 0 .5rem; }
h2 { font-size: 1.3rem; margin: 2.5rem 0 .5rem; padding-top: .8rem; border-top: 1px solid var(--line); }
h3 { font-size: 1.05rem; margin: 1.8rem 0 .3rem; }
p { max-width: 48rem; }
.verdict { font-size: 1.1rem; margin: .3rem 0; }
.soft, caption, figcaption { color: var(--soft); font-size: .85rem; }
.scroll { overflow-x: auto; margin: 1rem 0; }
table { border-collapse: collapse; font-size: .85rem; }
caption { text-align: left; padding-bottom: .3rem; max-width: min(60rem, calc(100vw - 3.5rem)); }
th, td { padding: .25rem .55rem; border-bottom: 1px solid var(--line); text-align: left; white-space: nowrap; }
thead th { border-bottom: 2px solid var(--soft); vertical-align: bottom; white-space: normal; }
tbody tr.group td { border-top: 2px solid var(--line); }
th:first-child, td:first-child { position: sticky; left: 0; background: var(--paper); padding-left: 0; }
@media (max-width: 40rem) { td:first-child { white-space: normal; min-width: 5.5rem; } }
.number { text-align: right; font-variant-numeric: tabular-nums; }
.figures { display: grid; grid-template-columns: repeat(auto-fill, minmax(min(26rem, 100%), 1fr)); gap: 1rem; margin: 1rem 0; }
figure { margin: 0; padding: .6rem; background: var(--panel); border-radius: .5rem; }
figure svg { display: block; width: 100%; height: auto; }
figure img { display: block; width: 100%; max-height: 32rem; object-fit: contain; image-rendering: pixelated; }
/* gnuplot draws in black; here that is the ink of the page */
figure svg [stroke="black"] { stroke: var(--ink); }
figure svg [fill="black"] { fill: var(--ink); }
figure svg [color="black"] { color: var(--ink); }
@media (prefers-color-scheme: dark) { /* the palette's blue is too dark there */
  figure svg [stroke="rgb(  0, 114, 178)"] { stroke: #3d9fdc; }
  figure svg [fill="rgb(  0, 114, 178)"] { fill: #3d9fdc; }
  figure svg [color="rgb(  0, 114, 178)"] { color: #3d9fdc; }
}
figure svg text, figure svg tspan { font-family: system-ui, sans-serif; }
details { margin: .8rem 0; }
summary { cursor: pointer; }
pre { background: var(--panel); padding: .7rem; border-radius: .5rem; overflow-x: auto; font-size: .8rem; }
code { font-size: .85rem; }
.hash td { font-family: ui-monospace, monospace; font-size: .75rem; }
@media print { body { max-width: none; font-size: 10pt; } figure { break-inside: avoid; background: none; } }
)css";

}  // namespace lcmslam::report

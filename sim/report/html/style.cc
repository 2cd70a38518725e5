#include "sim/report/html/style.h"

#include <fmt/format.h>

#include "sim/report/charts/palette.h"

namespace assay::report {
namespace {

// The rules contain no &, <, > or quotes. Element escapes these characters, but a browser does not
// decode them in a style sheet.
constexpr const char* kPageRules = R"css(
* { box-sizing: border-box; }
html { font: 16px/1.5 system-ui, -apple-system, Segoe UI, Roboto, Noto Sans, DejaVu Sans, sans-serif;
  color: var(--ink); background: var(--ground); -webkit-text-size-adjust: 100%; }
body { margin: 0; }
header, main, footer { max-width: 78rem; margin: 0 auto; padding: 0 1.5rem; }
header { padding-top: 2.5rem; }
footer { padding: 1.5rem; color: var(--soft); font-size: .875rem; border-top: 1px solid var(--rule);
  margin-top: 3rem; }
h1 { font-size: clamp(1.5rem, 4vw, 2.1rem); line-height: 1.2; margin: 0 0 .4rem;
  letter-spacing: -.015em; text-wrap: balance; }
h2 { font-size: 1.35rem; line-height: 1.3; margin: 3rem 0 .5rem; padding-top: 1rem;
  border-top: 2px solid var(--ink); }
h3 { font-size: 1.08rem; margin: 2rem 0 .3rem; }
h4 { font-size: .95rem; margin: 1.4rem 0 .2rem; color: var(--soft); }
p, li, dd { max-width: 46rem; overflow-wrap: anywhere; }
p { margin: .4rem 0 .8rem; }
.lead { font-size: 1.1rem; }
.about { color: var(--soft); margin: 0; }
.note { color: var(--soft); font-size: .9rem; }
.warning { border-left: 4px solid var(--inconclusive); padding: .3rem .8rem; }
a { color: var(--link); }
:focus-visible { outline: 3px solid var(--predicted); outline-offset: 2px; }
.skip { position: absolute; left: -100vw; }
.skip:focus { left: 1rem; top: .5rem; background: var(--ground); padding: .3rem .6rem; z-index: 1; }
nav ul { list-style: none; display: flex; flex-wrap: wrap; gap: .2rem 1.1rem; padding: 0;
  margin: 1rem 0 0; font-size: .9rem; }
.tiles { display: grid; grid-template-columns: repeat(auto-fit, minmax(13.5rem, 1fr)); gap: 1px;
  background: var(--rule); border: 1px solid var(--rule); border-radius: .6rem; overflow: hidden;
  margin: 1.2rem 0; padding: 0; }
.tile { background: var(--panel); padding: 1rem 1.2rem 1.1rem; margin: 0; }
.tile dt { font-size: .85rem; color: var(--soft); }
.tile dd { margin: 0; font-size: .85rem; }
.tile .big { font-size: 2.1rem; line-height: 1.25; font-weight: 650; letter-spacing: -.02em;
  font-variant-numeric: tabular-nums; display: flex; align-items: center; gap: .5rem; }
.tile .big svg { width: 1.1rem; height: 1.1rem; }
.key { display: flex; flex-wrap: wrap; gap: .5rem 1.6rem; list-style: none; padding: 0;
  font-size: .875rem; }
.key li { display: flex; align-items: center; gap: .45rem; max-width: none; }
.scroll { overflow-x: auto; margin: .6rem 0 1.4rem; border: 1px solid var(--rule);
  border-radius: .5rem; background: var(--panel); }
table { border-collapse: collapse; width: 100%; font-size: .875rem;
  font-variant-numeric: tabular-nums; }
caption { text-align: left; padding: .6rem .8rem; color: var(--soft); }
caption span { display: inline-block; position: sticky; left: .8rem;
  max-width: min(60rem, calc(100vw - 4rem)); }
th, td { padding: .35rem .8rem; text-align: left; vertical-align: middle; }
thead th { vertical-align: bottom; font-weight: 600; border-bottom: 1.5px solid var(--ink); }
tbody tr + tr th, tbody tr + tr td { border-top: 1px solid var(--rule); }
tbody th { font-weight: 600; }
tr.group th { color: var(--soft); font-weight: 500; padding-top: .9rem; background: var(--ground); }
.number { text-align: right; white-space: nowrap; }
.chart { white-space: nowrap; }
td.chart { padding-top: 0; padding-bottom: 0; }
.short { min-width: 9rem; }
th.chart svg { display: block; margin-bottom: -.35rem; }
svg { vertical-align: middle; flex: none; }
svg text { font: 10px system-ui, sans-serif; fill: var(--soft); font-variant-numeric: tabular-nums; }
.definitions { position: absolute; }
.verdict { white-space: nowrap; }
.contained { fill: var(--contained); stroke: var(--contained); }
.within-resolution { fill: var(--within-resolution); stroke: var(--within-resolution); }
.inconclusive { fill: var(--inconclusive); stroke: var(--inconclusive); }
.violated { fill: var(--violated); stroke: var(--violated); }
.not-claimed { fill: var(--not-claimed); stroke: var(--not-claimed); }
symbol circle, symbol path { stroke-width: 0; }
symbol .stroke { fill: none; stroke-width: 3; }
symbol .thin { stroke-width: 2; }
rect.share { stroke: var(--panel); stroke-width: 1; }
rect.predicted { fill: var(--predicted); fill-opacity: .5; }
rect.unproved { fill-opacity: .12; stroke: var(--predicted); stroke-dasharray: 3 2; }
rect.gate { fill: var(--predicted); fill-opacity: .2; }
line.end { stroke: var(--predicted); stroke-width: 2; }
line.observed { stroke: var(--observed); stroke-width: 1.5; }
rect.observed { fill: var(--observed); fill-opacity: .75; }
line.median { stroke: var(--panel); stroke-width: 2; }
line.axis { stroke: var(--rule-strong); }
line.grid { stroke: var(--rule); }
line.rate, line.control { stroke: var(--observed); stroke-width: 2; }
circle.rate { fill: var(--observed); }
line.control { stroke: var(--not-claimed); }
circle.control { fill: var(--panel); stroke: var(--not-claimed); stroke-width: 2; }
code, pre { font: .82rem/1.45 ui-monospace, SFMono-Regular, Menlo, DejaVu Sans Mono, monospace; }
code.command { background: var(--ground); border: 1px solid var(--rule); border-radius: .3rem;
  padding: .1rem .4rem; user-select: all; white-space: nowrap; }
pre { overflow-x: auto; background: var(--panel); border: 1px solid var(--rule);
  border-radius: .5rem; padding: .8rem 1rem; }
.example { border: 1px solid var(--rule); border-left: 4px solid var(--violated);
  border-radius: .5rem; padding: .2rem 1rem .8rem; margin: 1rem 0; background: var(--panel);
  overflow-wrap: anywhere; }
.example h4 { color: var(--ink); }
.example code.command { white-space: normal; display: inline-block; }
.facts { display: grid; grid-template-columns: max-content 1fr; gap: .25rem 1.2rem; }
.facts dt { color: var(--soft); }
.facts dd { margin: 0; }
figure { margin: 1.2rem 0; }
figure img { display: block; max-width: 100%; height: auto; border: 1px solid var(--rule);
  border-radius: .5rem; }
figcaption { font-size: .875rem; color: var(--soft); margin-top: .4rem; }
@media (max-width: 40rem) {
  header, main, footer { padding-left: 1rem; padding-right: 1rem; }
  th, td { padding-left: .55rem; padding-right: .55rem; }
  .key li.drawn { display: block; }
  .facts { grid-template-columns: 1fr; gap: 0; }
  .facts dd { margin-bottom: .5rem; }
}
@media print {
  html { font-size: 10.5pt; print-color-adjust: exact; -webkit-print-color-adjust: exact; }
  header, main, footer { max-width: none; padding-left: 0; padding-right: 0; }
  nav, .skip { display: none; }
  .scroll, pre { overflow: visible; border: 0; }
  table { font-size: 7.5pt; }
  th, td { padding: .15rem .35rem; }
  code.command { white-space: normal; border: 0; padding: 0; }
  tr, figure, .example, .tile { break-inside: avoid; }
  h2, h3, h4, caption { break-after: avoid; }
  thead { display: table-header-group; }
}
)css";

}  // namespace

std::string StyleSheet() {
  std::string light;
  std::string dark;
  for (const Colour& colour : kPalette) {
    light += fmt::format(" --{}: {};", colour.name, colour.light);
    dark += fmt::format(" --{}: {};", colour.name, colour.dark);
  }
  return fmt::format(
      ":root {{ color-scheme: light dark;{}\n  --ground: "
      "#f6f7f9; --panel: {}; --ink: #14202e;"
      " --soft: #52606f; --rule: #dde2e8; --rule-strong: "
      "#98a2ad; --link: #17609c; }}\n"
      "@media screen and (prefers-color-scheme: dark) {{ :root "
      "{{{}\n  --ground: #0b0f14;"
      " --panel: {}; --ink: #e9eef4; --soft: #a3afbc; --rule: "
      "#2a333e; --rule-strong: #66727f;"
      " --link: #7fbcf0; }} }}\n{}",
      light, kLightGround, dark, kDarkGround, kPageRules);
}

}  // namespace assay::report

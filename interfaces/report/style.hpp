// The look of the reports: one style sheet, inlined into each.
#pragma once

namespace swiftlet::interfaces::html {

inline constexpr const char* kStyle = R"css(
:root { color-scheme: light dark; --ground: #f6f7f9; --card: #ffffff; --ink: #1a2230; --quiet: #5b6675; --line: #dde2e9;
  --accent: #1f6feb; --good: #12703a; --good-ground: #d9f2e3; --bad: #a11a22; --bad-ground: #fbdfe0;
  --warn: #8a5a00; --plain-ground: #e8ecf2; }
@media (prefers-color-scheme: dark) { :root { --ground: #0f141b; --card: #171e28; --ink: #e4e9f0; --quiet: #97a3b4;
  --line: #2a3442; --accent: #6ea8ff; --good: #7fdca4; --good-ground: #143524; --bad: #ff9a9e; --bad-ground: #431d21;
  --warn: #f0c060; --plain-ground: #243040; } }
* { box-sizing: border-box; }
body { margin: 0; background: var(--ground); color: var(--ink);
  font: 15px/1.5 system-ui, -apple-system, "Segoe UI", Roboto, "Helvetica Neue", Arial, sans-serif; }
header, main { max-width: 1200px; margin: 0 auto; padding: 0 20px; }
header { padding-top: 36px; padding-bottom: 8px; }
h1 { font-size: 26px; line-height: 1.25; margin: 0 0 6px; letter-spacing: -0.01em; }
h2 { font-size: 16px; margin: 0 0 14px; }
header p { margin: 4px 0; color: var(--quiet); }
section { background: var(--card); border: 1px solid var(--line); border-radius: 10px; padding: 20px; margin: 18px 0; }
.facts { display: grid; grid-template-columns: repeat(auto-fill, minmax(150px, 1fr)); gap: 16px 20px; margin: 0; }
.facts dt { color: var(--quiet); font-size: 13px; }
.facts dd { margin: 0; font-size: 20px; font-weight: 600; font-variant-numeric: tabular-nums; overflow-wrap: anywhere; }
.pill { display: inline-block; padding: 1px 10px; border-radius: 99px; font-size: 13px; font-weight: 600;
  background: var(--plain-ground); vertical-align: 0.1em; }
.pill.good { color: var(--good); background: var(--good-ground); }
.pill.bad { color: var(--bad); background: var(--bad-ground); }
.wide { overflow-x: auto; }
table { border-collapse: collapse; width: 100%; font-size: 14px; font-variant-numeric: tabular-nums; }
th { text-align: left; color: var(--quiet); font-weight: 500; font-size: 13px; }
th, td { padding: 6px 14px 6px 0; border-bottom: 1px solid var(--line); vertical-align: top; }
tr:last-child td { border-bottom: 0; }
th.number, td.number { text-align: right; } td.number { white-space: nowrap; } th { vertical-align: bottom; }
td.good { color: var(--good); } td.bad { color: var(--bad); font-weight: 600; } td.warn { color: var(--warn); }
td.quiet { color: var(--quiet); }
a { color: var(--accent); }
img, svg { max-width: 100%; height: auto; }
img { border-radius: 6px; border: 1px solid var(--line); display: block; }
figure { margin: 0; } figcaption { color: var(--quiet); font-size: 13px; padding-top: 6px; }
.map svg { width: 100%; max-height: 860px; }
.pictures { display: grid; grid-template-columns: repeat(auto-fill, minmax(230px, 1fr)); gap: 18px; }
.pictures img { width: 100%; }
.plots { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(100%, 460px), 1fr)); gap: 22px; }
.bar { display: flex; height: 26px; border-radius: 6px; overflow: hidden; margin-bottom: 14px; }
.bar span { min-width: 1px; }
.dot { display: inline-block; width: 10px; height: 10px; border-radius: 3px; margin-right: 8px; }
pre { margin: 12px 0 0; overflow-x: auto; font: 13px/1.45 ui-monospace, "SF Mono", Menlo, Consolas, monospace; }
summary { cursor: pointer; font-weight: 600; }
.empty { color: var(--quiet); margin: 0; }
footer { color: var(--quiet); font-size: 13px; max-width: 1200px; margin: 0 auto; padding: 4px 20px 40px; }
@media print { body { background: #fff; } section { break-inside: avoid; } }
)css";

}  // namespace swiftlet::interfaces::html

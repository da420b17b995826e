#include "rendering/svg.hpp"

#include <iterator>

#include <fmt/format.h>

namespace swiftlet::rendering::svg {

std::vector<std::string> pointLists(const std::vector<Eigen::Vector2d>& pixels) {
  std::vector<std::string> lists;
  bool open = false;
  for (const Eigen::Vector2d& p : pixels) {
    if (!p.allFinite()) {
      open = false;
      continue;
    }
    if (!open) lists.emplace_back();
    fmt::format_to(std::back_inserter(lists.back()), "{}{:.1f},{:.1f}", open ? " " : "", p.x(), p.y());
    open = true;
  }
  return lists;
}

std::string_view style() {
  return R"css(<style>
.sw{font:12px system-ui,-apple-system,"Segoe UI",Roboto,sans-serif;--ink:#2b3947;--soft:#66788a;--line:#d5dce4;--paper:#fff;
--c1:#1f6fe0;--c2:#d9480f;--c3:#0a8f6c;--c4:#9c36b5;--c5:#b7791f;--c6:#c2255c}
@media (prefers-color-scheme:dark){.sw{--ink:#d5dee8;--soft:#8fa1b3;--line:#334252;--paper:#1a222b;
--c1:#6ea2ff;--c2:#ff922b;--c3:#3ddbab;--c4:#da77f2;--c5:#f0b44c;--c6:#ff6b9d}}
.sw text{fill:var(--soft)}.sw .title{fill:var(--ink);font-size:14px;font-weight:600}.sw .name{fill:var(--ink)}
.sw .halo{paint-order:stroke;stroke:#fff;stroke-width:3px;stroke-linejoin:round}
.sw .tick{font-variant-numeric:tabular-nums}.sw .frame{fill:var(--paper)}.sw .axis{stroke:var(--soft);fill:none}
.sw .rule{stroke:var(--line);fill:none}.sw .span{fill:var(--soft);opacity:.16}.sw .odd{opacity:.05}
.sw .s{fill:none;stroke-width:1.6;stroke-linejoin:round;stroke-linecap:round}.sw .dash{stroke-dasharray:5 4}
.sw .s1{stroke:var(--c1)}.sw .s2{stroke:var(--c2)}.sw .s3{stroke:var(--c3)}
.sw .s4{stroke:var(--c4)}.sw .s5{stroke:var(--c5)}.sw .s6{stroke:var(--c6)}
</style>)css";
}

}  // namespace swiftlet::rendering::svg

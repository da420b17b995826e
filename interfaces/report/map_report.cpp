#include <fmt/format.h>

#include "common/markup.hpp"
#include "interfaces/report/html.hpp"
#include "interfaces/report/report.hpp"

namespace swiftlet::interfaces {

using common::escaped;

std::string mapReport(const MapReport& report) {
  const std::string header = fmt::format("<h1>{}</h1>\n<p>{}</p>", escaped(report.title), escaped(report.subtitle));
  std::string body = html::section("Summary", html::facts(report.facts));
  if (!report.warnings.empty()) {
    std::string list = "<ul>\n";
    for (const std::string& warning : report.warnings) list += "<li class=\"warn\">" + escaped(warning) + "</li>\n";
    body += html::section("About the log", list + "</ul>");
  }
  body += html::section("Map", fmt::format("<figure class=\"map\">{}</figure>", report.map_svg));
  if (!report.plots_svg.empty()) body += html::section("Along the way", html::plots(report.plots_svg));
  return html::page(report.title, header, body);
}

}  // namespace swiftlet::interfaces

#include <fmt/format.h>

#include "common/markup.hpp"
#include "interfaces/report/html.hpp"
#include "interfaces/report/report.hpp"

namespace swiftlet::interfaces {

using common::escaped;

namespace {

std::string warningsSection(const std::vector<std::string>& warnings) {
  if (warnings.empty()) return "";
  std::string list = "<ul>\n";
  for (const std::string& warning : warnings) list += "<li class=\"warn\">" + escaped(warning) + "</li>\n";
  return html::section("About the recording", list + "</ul>");
}

std::string mapPicture(const std::string& map_svg) {
  return html::section("Map", fmt::format("<figure class=\"map\">{}</figure>", map_svg));
}

}  // namespace

std::string localizationReport(const LocalizationReport& report) {
  std::string body = html::section("Summary", html::facts(report.facts)) + warningsSection(report.warnings) +
                     mapPicture(report.map_svg);
  body +=
      html::section("Events", report.events.rows.empty() ? "<p class=\"empty\">None.</p>" : html::table(report.events));
  if (!report.plots_svg.empty()) body += html::section("Along the path", html::plots(report.plots_svg));
  return html::page(report.title, fmt::format("<h1>{}</h1>", escaped(report.title)), body, report.version);
}

std::string mapReport(const MapReport& report) {
  const std::string header = fmt::format("<h1>{}</h1>\n<p>{}</p>", escaped(report.title), escaped(report.subtitle));
  std::string body = html::section("Summary", html::facts(report.facts));
  body += warningsSection(report.warnings);
  body += html::map3dSection(report.map3d_jpeg);
  body += mapPicture(report.map_svg);
  if (!report.plots_svg.empty()) body += html::section("Along the path", html::plots(report.plots_svg));
  return html::page(report.title, header, body, report.version);
}

}  // namespace swiftlet::interfaces

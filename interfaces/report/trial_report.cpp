#include <fmt/format.h>

#include "common/markup.hpp"
#include "interfaces/report/html.hpp"
#include "interfaces/report/report.hpp"

namespace swiftlet::interfaces {
namespace {

using common::escaped;
using common::Mark;

std::string pictureOf(const TrialPicture& picture) {
  std::string image = fmt::format("<img loading=\"lazy\" src=\"{}\" alt=\"{}\">", html::relativeUrl(picture.file),
                                  escaped(picture.caption));
  if (!picture.link.empty()) image = fmt::format("<a href=\"{}\">{}</a>", html::relativeUrl(picture.link), image);
  return fmt::format("<figure>{}<figcaption>{} {}</figcaption></figure>\n", image, escaped(picture.caption),
                     picture.passed ? "" : html::pill("failed", Mark::kBad));
}

}  // namespace

std::string trialReport(const TrialReport& report) {
  std::string verdict;
  if (report.passed)
    verdict = *report.passed ? html::pill("passed", Mark::kGood) : html::pill("not passed", Mark::kBad);
  const std::string header =
      fmt::format("<h1>{} {}</h1>\n<p>{}</p>", escaped(report.title), verdict, escaped(html::moment(report.subtitle)));
  std::string body;
  for (const std::string& svg : report.plots_svg) body += svg;
  for (const common::Table& table : report.tables) body += html::section(table.title, html::table(table));
  if (!report.pictures.empty()) {
    std::string pictures = "<div class=\"pictures\">\n";
    for (const TrialPicture& picture : report.pictures) pictures += pictureOf(picture);
    body += html::section("Maps", pictures + "</div>");
  }
  return html::page(report.title, header, body, report.version);
}

}  // namespace swiftlet::interfaces

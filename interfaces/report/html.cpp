#include "interfaces/report/html.hpp"

#include <algorithm>
#include <cstdint>

#include <fmt/format.h>

#include "common/check.hpp"
#include "common/markup.hpp"
#include "interfaces/report/style.hpp"

namespace swiftlet::interfaces::html {
namespace {

using common::escaped;

const char* classOf(common::Mark mark) {
  switch (mark) {
    case common::Mark::kNone:
      return "";
    case common::Mark::kGood:
      return "good";
    case common::Mark::kBad:
      return "bad";
  }
  SWIFTLET_CHECK(false, static_cast<int>(mark));
}

std::string cell(const common::TableCell& cell, bool numeric) {
  std::string text = escaped(cell.text);
  if (!cell.link.empty()) text = fmt::format("<a href=\"{}\">{}</a>", relativeUrl(cell.link), text);
  return fmt::format("<td class=\"{}{}\">{}</td>", numeric ? "number " : "", classOf(cell.mark), text);
}

}  // namespace

std::string relativeUrl(std::string_view path) {
  std::string url = "./";
  for (const char c : path) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '/' ||
                       c == '.' || c == '-' || c == '_';
    url += plain ? std::string(1, c) : fmt::format("%{:02X}", static_cast<std::uint8_t>(c));
  }
  return url;
}

std::string moment(std::string started) {
  constexpr std::string_view kForm = "####-##-##_##-##-##";
  const auto digit = [](char c) { return c >= '0' && c <= '9'; };
  if (!std::equal(started.begin(), started.end(), kForm.begin(), kForm.end(),
                  [&](char c, char form) { return form == '#' ? digit(c) : c == form; }))
    return started;
  started[10] = ' ';
  started[13] = started[16] = ':';
  return started;
}

std::string pill(const std::string& text, common::Mark mark) {
  return fmt::format("<span class=\"pill {}\">{}</span>", classOf(mark), escaped(text));
}

std::string section(const std::string& title, const std::string& body) {
  return fmt::format("<section>\n<h2>{}</h2>\n{}\n</section>\n", escaped(title), body);
}

std::string facts(const std::vector<std::pair<std::string, std::string>>& facts) {
  std::string body = "<dl class=\"facts\">\n";
  for (const auto& [label, value] : facts)
    body += fmt::format("<div><dt>{}</dt><dd>{}</dd></div>\n", escaped(label), escaped(value));
  return body + "</dl>";
}

std::string map3dSection(const std::string& jpeg_base64) {
  if (jpeg_base64.empty()) return "";
  return section("3D map", fmt::format("<figure class=\"map\"><img alt=\"The 3D map with the path through it\" "
                                       "src=\"data:image/jpeg;base64,{}\"></figure>",
                                       jpeg_base64));
}

std::string plots(const std::vector<std::string>& svg) {
  std::string body = "<div class=\"plots\">\n";
  for (const std::string& plot : svg) body += fmt::format("<figure>{}</figure>\n", plot);
  return body + "</div>";
}

std::string table(const common::Table& table) {
  if (table.rows.empty()) return "<p class=\"empty\">None.</p>";
  std::vector<bool> numeric;
  std::string body = "<div class=\"wide\"><table>\n<thead><tr>";
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    numeric.push_back(common::isNumeric(table, i));
    body += fmt::format("<th class=\"{}\">{}</th>", numeric[i] ? "number" : "", escaped(table.columns[i]));
  }
  body += "</tr></thead>\n<tbody>\n";
  for (const auto& row : table.rows) {
    body += "<tr>";
    for (std::size_t i = 0; i < row.size(); ++i) body += cell(row[i], numeric[i]);
    body += "</tr>\n";
  }
  return body + "</tbody></table></div>";
}

std::string page(const std::string& title, const std::string& header, const std::string& body,
                 const common::BuildVersion& version) {
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>{}</title>\n<style>{}</style>\n"
      "</head>\n<body>\n<header>\n{}\n</header>\n<main>\n{}</main>\n<footer>Swiftlet {}</footer>\n</body>\n</html>\n",
      escaped(title), kStyle, header, body, escaped(toString(version)));
}

}  // namespace swiftlet::interfaces::html

#include "rendering/envelope_svg.hpp"

#include <algorithm>
#include <iterator>

#include <fmt/format.h>

#include "common/markup.hpp"
#include "rendering/svg.hpp"

namespace swiftlet::rendering {
namespace {

using Out = std::back_insert_iterator<std::string>;

constexpr double kWidth_px = 860, kLeft_px = 210, kBars_px = 330, kTop_px = 70, kRow_px = 26, kBarHeight_px = 12;
constexpr double kBottom_px = 44, kArrow_px = 7;

double xOf(double multiple) {
  return kLeft_px + kBars_px * std::clamp(multiple, 0.0, kEnvelopeAxisEnd) / kEnvelopeAxisEnd;
}

/// The class of the colour of a bar; see envelopeSvg().
const char* colorOf(const EnvelopeBar& bar) {
  if (!bar.fails) return "good";
  if (bar.inner && *bar.fails <= *bar.inner) return "bad";
  return bar.outer && *bar.fails <= 1.0 ? "poor" : "good";
}

void drawAxis(const EnvelopePicture& picture, double bottom, Out out) {
  for (int i = 0; i <= static_cast<int>(kEnvelopeAxisEnd); ++i) {
    fmt::format_to(out, R"(<path class="{}" d="M{:.1f} {:.1f}V{:.1f}"/>)", i == 1 ? "edge" : "rule", xOf(i),
                   kTop_px - 6.0, bottom);
    fmt::format_to(out, R"(<text class="tick" x="{:.1f}" y="{:.1f}" text-anchor="middle">{}</text>)", xOf(i),
                   bottom + 16.0, i);
  }
  fmt::format_to(out, R"(<text class="name" x="{:.1f}" y="{:.1f}" text-anchor="middle">{}</text>)", xOf(1.0),
                 kTop_px - 12.0, common::escaped(picture.outer_name));
  fmt::format_to(out,
                 R"(<text x="{:.1f}" y="{:.1f}" text-anchor="middle">distance from the base, worst of {} = 1</text>)",
                 kLeft_px + 0.5 * kBars_px, bottom + 34.0, common::escaped(picture.outer_name));
}

void drawBar(const EnvelopeBar& bar, double y, Out out) {
  const double end = xOf(bar.acceptable), top = y - 0.5 * kBarHeight_px;
  const char* color = colorOf(bar);
  fmt::format_to(out,
                 R"(<rect class="{}" x="{:.1f}" y="{:.1f}" width="{:.1f}" height="{:.1f}"><title>{}</title></rect>)",
                 color, xOf(0), top, end - xOf(0), kBarHeight_px, common::escaped(bar.acceptable_text));
  if (bar.fails) {  // Between the last acceptable and the first failed value it is not known.
    fmt::format_to(out, R"(<rect class="{} unsure" x="{:.1f}" y="{:.1f}" width="{:.1f}" height="{:.1f}"/>)", color, end,
                   top, xOf(*bar.fails) - end, kBarHeight_px);
    if (*bar.fails <= kEnvelopeAxisEnd)
      fmt::format_to(out, R"(<path class="fails" d="M{:.1f} {:.1f}v{:.1f}"/>)", xOf(*bar.fails), top - 3.0,
                     kBarHeight_px + 6.0);
  }
  if (!bar.fails || *bar.fails > kEnvelopeAxisEnd)
    fmt::format_to(out, R"(<path class="{}" d="M{:.1f} {:.1f}l{:.1f} {:.1f}l{:.1f} {:.1f}z"/>)", color,
                   std::max(end, bar.fails ? xOf(*bar.fails) : end), top, kArrow_px, 0.5 * kBarHeight_px, -kArrow_px,
                   0.5 * kBarHeight_px);
  if (bar.inner)
    fmt::format_to(out, R"(<path class="inner" d="M{:.1f} {:.1f}v{:.1f}"><title>{}</title></path>)", xOf(*bar.inner),
                   top - 3.0, kBarHeight_px + 6.0, common::escaped(bar.inner_text));
}

void drawRow(const EnvelopeBar& bar, double y, Out out) {
  fmt::format_to(out, R"(<text class="name" x="{:.1f}" y="{:.1f}" text-anchor="end">{}{}</text>)", kLeft_px - 10.0,
                 y + 4.0, common::escaped(bar.name), bar.outer ? "" : " *");
  drawBar(bar, y, out);
  fmt::format_to(out, R"(<text x="{:.1f}" y="{:.1f}">{}</text>)", kLeft_px + kBars_px + 16.0, y + 4.0,
                 common::escaped(bar.text));
}

void drawLegend(const EnvelopePicture& picture, Out out) {
  double x = kLeft_px;
  const auto entry = [&](const char* color, const std::string& text) {
    fmt::format_to(out,
                   R"(<rect class="{}" x="{:.1f}" y="32" width="12" height="8"/><text x="{:.1f}" y="40">{}</text>)",
                   color, x, x + 17.0, common::escaped(text));
    x += 34.0 + 6.2 * static_cast<double>(text.size());
  };
  entry("bad", "fails within " + picture.inner_name);
  entry("poor", "fails within " + picture.outer_name);
  entry("good", "beyond both");
  fmt::format_to(out, R"(<path class="inner" d="M{:.1f} 29v14"/><text x="{:.1f}" y="40">worst of {}</text>)", x + 2.0,
                 x + 10.0, common::escaped(picture.inner_name));
}

constexpr const char* kStyle =
    "<style>.sw .good{fill:var(--c3)}.sw .poor{fill:var(--c5)}.sw .bad{fill:var(--c6)}.sw .unsure{opacity:.35}"
    ".sw .fails{stroke:var(--ink);stroke-width:2.2;fill:none}.sw .inner{stroke:var(--c1);stroke-width:2;fill:none}"
    ".sw .edge{stroke:var(--soft);stroke-dasharray:4 3;fill:none}</style>";

}  // namespace

std::string envelopeSvg(const EnvelopePicture& picture) {
  const double bottom = kTop_px + kRow_px * static_cast<double>(picture.bars.size());
  const bool starred =
      std::any_of(picture.bars.begin(), picture.bars.end(), [](const EnvelopeBar& bar) { return !bar.outer; });
  std::string text;
  const Out out = std::back_inserter(text);
  fmt::format_to(out,
                 R"(<svg class="sw" xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {0} {1}" width="{0}" height="{1}" )"
                 R"(style="max-width:100%;height:auto" role="img" aria-label="{2}">{3}{4})",
                 kWidth_px, bottom + kBottom_px + (starred ? 18.0 : 0.0), common::escaped(picture.title), svg::style(),
                 kStyle);
  fmt::format_to(out, R"(<rect class="frame" width="100%" height="100%" rx="8"/>)");
  fmt::format_to(out, R"(<text class="title" x="14" y="21">{}</text>)", common::escaped(picture.title));
  drawLegend(picture, out);
  drawAxis(picture, bottom, out);
  for (std::size_t i = 0; i < picture.bars.size(); ++i)
    drawRow(picture.bars[i], kTop_px + kRow_px * (static_cast<double>(i) + 0.5), out);
  if (starred)
    fmt::format_to(out, R"(<text x="{:.1f}" y="{:.1f}">* not drawn by {}: the axis is the range that was flown</text>)",
                   14.0, bottom + 54.0, common::escaped(picture.outer_name));
  text += "</svg>\n";
  return text;
}

}  // namespace swiftlet::rendering

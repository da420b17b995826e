// The page and its reference know every reason of a frontier, and the page's colours are those of the streams.
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <string>
#include <utility>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/world/frontier.hpp"
#include "rendering/theme.hpp"
#include "web/server/assets.hpp"

namespace swiftlet::web {
namespace {

using rendering::Scheme;

std::string asset(std::string_view name) {
  for (const Asset& asset : assets())
    if (asset.name == name) return std::string(asset.content);
  ADD_FAILURE() << name;
  return {};
}

std::set<std::string> quotedIn(const std::string& text) {
  static const std::regex kQuoted("['`]([a-z ]+)['`]");
  std::set<std::string> words;
  for (std::sregex_iterator it(text.begin(), text.end(), kQuoted), end; it != end; ++it) words.insert((*it)[1]);
  return words;
}

/// The text from `begin` to `end`, without both.
std::string between(const std::string& text, const std::string& begin, const std::string& end) {
  const std::size_t from = text.find(begin);
  if (from == std::string::npos) return {};
  const std::size_t to = text.find(end, from + begin.size());
  return text.substr(from + begin.size(), to - from - begin.size());
}

std::set<std::string> reasons() {
  std::set<std::string> words;
  for (const common::FrontierReason reason : common::kFrontierReasons) words.insert(toString(reason));
  return words;
}

TEST(FrontierWordsTest, TheListHasEveryReasonOnce) {
  EXPECT_EQ(reasons().size(), common::kFrontierReasons.size());
  for (std::size_t i = 0; i < common::kFrontierReasons.size(); ++i)
    EXPECT_EQ(static_cast<std::size_t>(common::kFrontierReasons[i]), i);
  EXPECT_EQ(common::kFrontierReasons.back(), common::FrontierReason::kPositionUncertain) << "a new one is not listed";
}

TEST(FrontierWordsTest, ThePageHasAColourForEveryReasonAndForNoOther) {
  EXPECT_EQ(quotedIn(between(asset("map_colors.js"), "color.frontier = Object.fromEntries(", ".map((reason)")),
            reasons());
}

TEST(FrontierWordsTest, TheReferenceNamesEveryReasonAndNoOther) {
  std::ifstream file(std::filesystem::path(SWIFTLET_SOURCE_DIR) / "docs/state.md");
  const std::string page{std::istreambuf_iterator<char>(file), {}};
  EXPECT_EQ(quotedIn(between(page, "| `frontiers` | `reason` (", ")")), reasons());
}

TEST(MapColoursTest, TheStyleSheetHasThoseOfTheStreams) {
  const std::string style = asset("style.css");
  const auto inCss = [](rendering::Color color) {
    return color.alpha == 255 ? fmt::format("#{:02x}{:02x}{:02x}", color.red, color.green, color.blue)
                              : fmt::format("rgb({} {} {} / {:.0f}%)", color.red, color.green, color.blue,
                                            100.0 * color.alpha / 255.0);
  };
  for (const Scheme scheme : {Scheme::kLight, Scheme::kDark}) {
    const std::string block = between(style, scheme == Scheme::kLight ? ":root {" : "dark) {\n  :root {", "}");
    const rendering::Theme& theme = themeOf(scheme);
    const std::pair<const char*, rendering::Color> named[] = {
        {"unknown", theme.unknown}, {"free", theme.free}, {"wall", theme.wall},   {"behind-3d", theme.behind_3d},
        {"grid", theme.grid},       {"text", theme.text}, {"trail", theme.trail}, {"plan", theme.plan},
        {"goal", theme.goal},       {"home", theme.home}, {"laser", theme.laser}, {"level", theme.level},
        {"vehicle", theme.vehicle}};
    for (const auto& [name, color] : named)
      EXPECT_THAT(block, testing::HasSubstr(fmt::format("--map-{}: {};", name, inCss(color))));
  }
}

TEST(FrontierWordsTest, TheStyleSheetHasTheColoursOfTheStreams) {
  const std::string style = asset("style.css");
  const std::string light = between(style, ":root {", "}"), dark = between(style, "dark) {\n  :root {", "}");
  for (const common::FrontierReason reason : common::kFrontierReasons) {
    const std::string name = std::regex_replace(std::string(toString(reason)), std::regex(" "), "-");
    for (const Scheme scheme : {Scheme::kLight, Scheme::kDark}) {
      const rendering::Color color = frontierColor(reason, scheme);
      const std::string line =
          fmt::format("--frontier-{}: #{:02x}{:02x}{:02x};", name, color.red, color.green, color.blue);
      // The dark scheme inherits what it does not change.
      const bool inherited = scheme == Scheme::kDark && dark.find("--frontier-" + name + ":") == std::string::npos &&
                             light.find(line) != std::string::npos;
      EXPECT_TRUE(inherited || (scheme == Scheme::kLight ? light : dark).find(line) != std::string::npos) << line;
    }
    EXPECT_THAT(style, testing::HasSubstr(fmt::format(".{} {{ --dot: var(--frontier-{}); }}", name, name)));
  }
}

}  // namespace
}  // namespace swiftlet::web

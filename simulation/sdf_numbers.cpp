#include "simulation/sdf_numbers.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "common/misleading.hpp"
#include "common/printable.hpp"
#include "common/text_parts.hpp"

namespace swiftlet::simulation {
namespace {

constexpr std::string_view kBlanks = " \t\r\n\v\f";

/// How many numbers an element takes.
struct Count {
  std::size_t least = 0;
  std::size_t most = 0;
};

/// An element by its own name and that of the element around it.
struct NumberElement {
  std::string_view parent;
  std::string_view name;
  Count count;
};

constexpr std::array kNumberElements{NumberElement{"box", "size", {3, 3}},
                                     NumberElement{"plane", "size", {2, 2}},
                                     NumberElement{"plane", "normal", {3, 3}},
                                     NumberElement{"cylinder", "radius", {1, 1}},
                                     NumberElement{"cylinder", "length", {1, 1}},
                                     NumberElement{"sphere", "radius", {1, 1}},
                                     NumberElement{"capsule", "radius", {1, 1}},
                                     NumberElement{"capsule", "length", {1, 1}},
                                     NumberElement{"cone", "radius", {1, 1}},
                                     NumberElement{"cone", "length", {1, 1}},
                                     NumberElement{"ellipsoid", "radii", {3, 3}},
                                     NumberElement{"polyline", "height", {1, 1}},
                                     NumberElement{"polyline", "point", {2, 2}},
                                     NumberElement{"heightmap", "size", {3, 3}},
                                     NumberElement{"heightmap", "pos", {3, 3}},
                                     NumberElement{"mesh", "scale", {3, 3}},
                                     NumberElement{"model", "scale", {3, 3}},
                                     NumberElement{"link", "scale", {3, 3}},
                                     NumberElement{"visual", "transparency", {1, 1}},
                                     NumberElement{"material", "diffuse", {3, 4}}};
constexpr std::array<std::string_view, 6> kPlaced{"model", "link", "collision", "visual", "frame", "include"};

std::optional<Count> countOf(const SdfTag& tag, std::string_view parent) {
  if (tag.name == "pose" && std::find(kPlaced.begin(), kPlaced.end(), parent) != kPlaced.end()) {
    const std::size_t count = attributeOf(tag, "rotation_format").value_or("") == "quat_xyzw" ? 7 : 6;
    return Count{count, count};
  }
  for (const NumberElement& element : kNumberElements)
    if (element.parent == parent && element.name == tag.name) return element.count;
  return std::nullopt;
}

bool isNumber(std::string_view word) {
  word = common::withoutPlus(word);
  double value = 0.0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  return error == std::errc() && end == word.data() + word.size();
}

/// The number of numbers in a text; nullopt if it is anything else.
std::optional<std::size_t> numbersIn(std::string_view text) {
  std::size_t count = 0;
  while (true) {
    text.remove_prefix(std::min(text.find_first_not_of(kBlanks), text.size()));
    if (text.empty()) return count;
    const std::size_t end = std::min(text.find_first_of(kBlanks), text.size());
    if (!isNumber(text.substr(0, end))) return std::nullopt;
    ++count;
    text.remove_prefix(end);
  }
}

std::string replaced(std::string text, std::string_view from, std::string_view to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
    text.replace(at, from.size(), to);
  return text;
}

/// The letters of units at the ends of numbers, "1.5m" and "2 m", left out.
std::string withoutMetres(std::string text) {
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool alone = i + 1 == text.size() || kBlanks.find(text[i + 1]) != std::string_view::npos;
    const std::size_t number = text.find_last_not_of(kBlanks, i == 0 ? 0 : i - 1);
    const bool behind = i > 0 && number != std::string::npos && std::isdigit(static_cast<unsigned char>(text[number]));
    if (text[i] == 'm' && alone && behind) text[i] = ' ';
  }
  return text;
}

/// What the text most likely means, written as SDF wants it; nullopt if that is unclear.
std::optional<std::string> meant(const std::string& text, Count count) {
  const std::string plain = withoutMetres(replaced(common::asSeen(text), ";", " "));
  for (const std::string& guess : {plain, replaced(replaced(plain, ", ", " "), ",", "."), replaced(plain, ",", " ")})
    if (const auto found = numbersIn(guess); found && *found >= count.least && *found <= count.most) {
      std::string words;
      for (const char c : guess) {
        const bool blank = kBlanks.find(c) != std::string_view::npos;
        if (!blank || (!words.empty() && words.back() != ' ')) words += blank ? ' ' : c;
      }
      return words.substr(0, words.find_last_not_of(' ') + 1);
    }
  return std::nullopt;
}

/// Whether an element of that name around it makes an element another tool's.
bool isSdfs(const std::vector<SdfTag>& tags, const SdfTag& tag) {
  for (int parent = tag.parent; parent >= 0; parent = tags[static_cast<std::size_t>(parent)].parent)
    if (const std::string_view name = tags[static_cast<std::size_t>(parent)].name; name == "plugin" || name == "gui")
      return false;
  return true;
}

std::string wanted(Count count) {
  const std::string most = count.most == 1 ? "one number" : fmt::format("{} numbers", count.most);
  return count.least == count.most ? most : fmt::format("{} or {}", count.least, most);
}

common::Message faultOf(const std::string& written, std::optional<std::size_t> found, Count count) {
  if (found)
    return common::Message("sdf.number-count", "`{}` has {} numbers, expected is {}", common::printable(written),
                           *found, wanted(count));
  const auto odd = common::misleadingIn(written);
  return common::Message("sdf.no-number", "`{}` is not {}{}", common::printable(written), wanted(count),
                         odd ? fmt::format(": it has {}", odd->what) : "");
}

std::string hintFor(const std::string& written, Count count) {
  if (const auto guess = meant(written, count)) return fmt::format("write `{}`", *guess);
  if (std::string hint = common::misleadingHint(written); !hint.empty()) return hint;
  return "SDF writes metres and radians without units, decimals with a point, and blanks between numbers, as in `1.5 "
         "-2 0.1`";
}

}  // namespace

std::vector<common::Problem> numberProblems(const std::string& file, std::string_view text,
                                            const std::vector<SdfTag>& tags) {
  std::vector<common::Problem> problems;
  for (const SdfTag& tag : tags) {
    if (tag.parent < 0) continue;
    const auto count = countOf(tag, tags[static_cast<std::size_t>(tag.parent)].name);
    if (!count || !isSdfs(tags, tag)) continue;
    const std::string written = textOf(tag, text);
    const auto found = numbersIn(written);
    if (written.empty() || (found && *found >= count->least && *found <= count->most)) continue;
    problems.push_back({locationIn(file, text, tag.begin), std::string(tag.name), faultOf(written, found, *count),
                        hintFor(written, *count)});
  }
  return problems;
}

std::vector<std::string> numberElementsOf(std::string_view parent) {
  std::vector<std::string> names;
  for (const NumberElement& element : kNumberElements)
    if (element.parent == parent) names.emplace_back(element.name);
  if (std::find(kPlaced.begin(), kPlaced.end(), parent) != kPlaced.end()) names.emplace_back("pose");
  return names;
}

}  // namespace swiftlet::simulation

#include "interfaces/files/header_unit.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include "common/lower_case.hpp"

namespace swiftlet::interfaces {
namespace {

struct LengthUnit {
  double metres;
  std::array<std::string_view, 5> words;  ///< The first one is short, and may be another word.
};

constexpr std::array<LengthUnit, 8> kLengthUnits{
    {{0.001, {"mm", "millimeter", "millimeters", "millimetre", "millimetres"}},
     {0.01, {"cm", "centimeter", "centimeters", "centimetre", "centimetres"}},
     {0.1, {"dm", "decimeter", "decimeters", "decimetre", "decimetres"}},
     {1.0, {"m", "meter", "meters", "metre", "metres"}},
     {1000.0, {"km", "kilometer", "kilometers", "kilometre", "kilometres"}},
     {0.0254, {"in", "inch", "inches"}},
     {0.3048, {"ft", "foot", "feet"}},
     {0.9144, {"yd", "yard", "yards"}}}};

std::vector<std::string_view> commentWords(std::string_view text) {
  constexpr std::string_view kMarks = " \t\r#:=,;()[]\"'";
  std::vector<std::string_view> words;
  for (std::size_t begin = 0; (begin = text.find_first_not_of(kMarks, begin)) != text.npos;) {
    const std::size_t end = std::min(text.find_first_of(kMarks, begin), text.size());
    words.push_back(text.substr(begin, end - begin));
    begin = end;
  }
  return words;
}

}  // namespace

std::optional<HeaderUnit> unitIn(std::string_view comment) {
  const std::vector<std::string_view> words = commentWords(comment);
  bool announced = false;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const std::string word = common::lowerCase(words[i]);
    for (const auto& [metres, names] : kLengthUnits) {
      const auto* const found = std::find(names.begin(), names.end(), word);
      const bool is_last = i + 1 == words.size(), is_short = found == names.begin();
      // In "units are in mm" the `in` is no inch.
      if (found == names.end() || (word == "in" && !is_last) || !(announced || (words.size() == 1 && !is_short)))
        continue;
      return HeaderUnit{std::string(words[i]), metres};
    }
    announced = announced || word.ends_with("unit") || word.ends_with("units") || word.starts_with("unit_");
  }
  return std::nullopt;
}

}  // namespace swiftlet::interfaces

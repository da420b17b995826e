#include "behaviors/tree/value.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <utility>
#include <vector>

namespace swiftlet::tree {
namespace {

constexpr double kLongest_ns = 9e18;  ///< Of a duration.

struct Unit {
  std::string_view name;
  std::string_view words;
  double seconds = 0.0;  ///< Seconds in a unit of time.
};

constexpr std::array kUnits = {Unit{"m", "metres"},
                               Unit{"cm", "centimetres"},
                               Unit{"mm", "millimetres"},
                               Unit{"km", "kilometres"},
                               Unit{"m_s", "metres per second"},
                               Unit{"m_s2", "metres per second squared"},
                               Unit{"rad", "radians"},
                               Unit{"rad_s", "radians per second"},
                               Unit{"deg", "degrees"},
                               Unit{"deg_s", "degrees per second"},
                               Unit{"hz", "hertz"},
                               Unit{"kg", "kilograms"},
                               Unit{"v", "volts"},
                               Unit{"px", "pixels"},
                               Unit{"ns", "nanoseconds", 1e-9},
                               Unit{"us", "microseconds", 1e-6},
                               Unit{"ms", "milliseconds", 1e-3},
                               Unit{"msec", "milliseconds", 1e-3},
                               Unit{"s", "seconds", 1.0},
                               Unit{"sec", "seconds", 1.0},
                               Unit{"min", "minutes", 60.0}};

const Unit* findUnit(std::string_view name) {
  for (const Unit& unit : kUnits)
    if (unit.name == name) return &unit;
  return nullptr;
}

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kBlanks = " \t\r\n";
  const std::size_t first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

template <typename Number>
std::optional<Number> parseNumber(std::string_view text) {
  text = trimmed(text);
  Number number{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{} || end != text.data() + text.size() || text.empty()) return std::nullopt;
  if constexpr (std::is_same_v<Number, double>)
    if (!std::isfinite(number)) return std::nullopt;
  return number;
}

std::optional<Value> parseBool(std::string_view text) {
  text = trimmed(text);
  if (text == "1" || text == "0") return Value(text == "1");
  const auto truth = truthOfWord(text);
  return truth ? std::optional<Value>(*truth) : std::nullopt;
}

/// Numbers between semicolons, at most `most`; nothing if one of them is not a number.
std::optional<std::vector<double>> parseNumbers(std::string_view text, std::size_t most) {
  std::vector<double> numbers;
  while (true) {
    const std::size_t end = text.find(';');
    const auto number = parseNumber<double>(text.substr(0, end));
    if (!number || numbers.size() == most) return std::nullopt;
    numbers.push_back(*number);
    if (end == std::string_view::npos) return numbers;
    text.remove_prefix(end + 1);
  }
}

std::optional<Value> parsePoint(std::string_view text) {
  const auto numbers = parseNumbers(text, 3);
  if (!numbers || numbers->size() < 2) return std::nullopt;
  return Point{(*numbers)[0], (*numbers)[1], numbers->size() == 3 ? std::optional((*numbers)[2]) : std::nullopt};
}

std::optional<Value> parsePoints(std::string_view text) {
  Points path;
  while (true) {
    const std::size_t end = text.find('|');
    const auto point = parsePoint(text.substr(0, end));
    if (!point) return std::nullopt;
    path.points.push_back(std::get<Point>(*point));
    if (end == std::string_view::npos) return path;
    text.remove_prefix(end + 1);
  }
}

std::optional<Value> parseRectangle(std::string_view text) {
  const auto numbers = parseNumbers(text, 4);
  if (!numbers || numbers->size() != 4) return std::nullopt;
  const Rectangle rectangle{(*numbers)[0], (*numbers)[1], (*numbers)[2], (*numbers)[3]};
  if (rectangle.x_min >= rectangle.x_max || rectangle.y_min >= rectangle.y_max) return std::nullopt;
  return rectangle;
}

std::string numberText(double number) {
  std::array<char, 32> buffer{};
  const auto result = std::to_chars(buffer.data(), buffer.data() + buffer.size(), number);
  return {buffer.data(), result.ptr};
}

struct ToText {
  std::string operator()(const std::string& text) const { return text; }
  std::string operator()(double number) const { return numberText(number); }
  std::string operator()(std::int64_t number) const { return std::to_string(number); }
  std::string operator()(bool yes) const { return yes ? "true" : "false"; }
  std::string operator()(const Point& point) const {
    return numberText(point.x) + ";" + numberText(point.y) + (point.z ? ";" + numberText(*point.z) : std::string());
  }
  std::string operator()(const Points& path) const {
    std::string text;
    for (const Point& point : path.points) text += (text.empty() ? "" : " | ") + (*this)(point);
    return text;
  }
  std::string operator()(const Rectangle& r) const {
    return numberText(r.x_min) + ";" + numberText(r.y_min) + ";" + numberText(r.x_max) + ";" + numberText(r.y_max);
  }
  std::string operator()(const Duration& duration) const {
    return numberText(static_cast<double>(duration.nanoseconds) / 1e9) + " s";
  }
};

}  // namespace

const char* toString(PortType type) {
  switch (type) {
    case PortType::kAny:
    case PortType::kString:
      return "text";
    case PortType::kDouble:
      return "number";
    case PortType::kInt:
      return "whole number";
    case PortType::kBool:
      return "true or false";
    case PortType::kPoint:
      return "point";
    case PortType::kPoints:
      return "points";
    case PortType::kRectangle:
      return "rectangle";
    case PortType::kDuration:
      return "duration";
    case PortType::kScript:
      return "script";
  }
  return "?";
}

std::string_view unitOf(std::string_view port_name) {
  if (findUnit(port_name) != nullptr) return port_name;
  // `coverage_min` is the least one; a time in minutes has a port named after something else.
  if (port_name.ends_with("_min")) return {};
  // The longest ending that is a unit: `speed_m_s` is in m_s, not in s.
  for (std::size_t i = port_name.find('_'); i != std::string_view::npos; i = port_name.find('_', i + 1))
    if (findUnit(port_name.substr(i + 1)) != nullptr) return port_name.substr(i + 1);
  return {};
}

std::string_view unitInWords(std::string_view unit) {
  const Unit* known = findUnit(unit);
  return known == nullptr ? std::string_view() : known->words;
}

std::string_view withoutUnit(std::string_view port_name) {
  const std::string_view unit = unitOf(port_name);
  if (unit.empty() || unit.size() == port_name.size()) return port_name;
  return port_name.substr(0, port_name.size() - unit.size() - 1);
}

double longestTime(std::string_view unit) {
  const Unit* known = findUnit(unit);
  return known == nullptr || known->seconds == 0.0 ? 0.0 : kLongest_ns / (known->seconds * 1e9);
}

std::optional<Duration> durationOf(double number, std::string_view unit) {
  const Unit* known = findUnit(unit);
  if (known == nullptr || known->seconds == 0.0) return std::nullopt;
  const double nanoseconds = std::round(number * known->seconds * 1e9);
  if (!(std::abs(nanoseconds) <= kLongest_ns)) return std::nullopt;
  return Duration{static_cast<std::int64_t>(nanoseconds)};
}

std::optional<bool> truthOfWord(std::string_view word) {
  if (word == "true" || word == "True" || word == "TRUE") return true;
  if (word == "false" || word == "False" || word == "FALSE") return false;
  return std::nullopt;
}

std::optional<Value> parseValue(std::string_view text, PortType type, std::string_view unit) {
  switch (type) {
    case PortType::kAny:
    case PortType::kString:
    case PortType::kScript:
      return Value(std::string(text));
    case PortType::kDouble:
      return parseNumber<double>(text);
    case PortType::kInt:
      return parseNumber<std::int64_t>(text);
    case PortType::kBool:
      return parseBool(text);
    case PortType::kPoint:
      return parsePoint(text);
    case PortType::kPoints:
      return parsePoints(text);
    case PortType::kRectangle:
      return parseRectangle(text);
    case PortType::kDuration: {
      const auto number = parseNumber<double>(text);
      const auto duration = number ? durationOf(*number, unit) : std::nullopt;
      return duration ? std::optional<Value>(*duration) : std::nullopt;
    }
  }
  return std::nullopt;
}

std::optional<Value> numberOfText(std::string_view text) {
  if (trimmed(text) != text) return std::nullopt;
  if (const auto whole = parseNumber<std::int64_t>(text)) return *whole;
  const auto number = parseNumber<double>(text);
  return number ? std::optional<Value>(*number) : std::nullopt;
}

std::string toString(const Value& value) { return std::visit(ToText{}, value); }

}  // namespace swiftlet::tree

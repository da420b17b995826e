// The values of ports and blackboard entries, and how they are parsed from text.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace swiftlet::tree {

/// "x;y" or "x;y;z".
struct Point {
  double x = 0.0;
  double y = 0.0;
  std::optional<double> z;
  bool operator==(const Point&) const = default;
};

/// "x;y | x;y;z | ...", at least one point.
struct Points {
  std::vector<Point> points;
  bool operator==(const Points&) const = default;
};

/// "x_min;y_min;x_max;y_max", each minimum below its maximum.
struct Rectangle {
  double x_min = 0.0;
  double y_min = 0.0;
  double x_max = 0.0;
  double y_max = 0.0;
  bool operator==(const Rectangle&) const = default;
};

/// A span of time; in text a number whose unit is the ending of the port's name (`msec`, `_ms`, `_s`, `_min`).
struct Duration {
  std::int64_t nanoseconds = 0;
  auto operator<=>(const Duration&) const = default;
};

/// Text from SetBlackboard or a literal stays text until a typed port reads it.
using Value = std::variant<std::string, double, std::int64_t, bool, Point, Points, Rectangle, Duration>;

enum class PortType : unsigned char {
  kAny,
  kString,
  kDouble,
  kInt,
  kBool,
  kPoint,
  kPoints,
  kRectangle,
  kDuration,
  kScript
};

/// "number", "whole number", "point" ...: for messages.
const char* toString(PortType type);

/// The unit that ends a port's name ("clearance_m" -> "m", "msec" -> "msec"); empty without a unit.
std::string_view unitOf(std::string_view port_name);
/// "m" -> "metres"; empty if it is not a unit.
std::string_view unitInWords(std::string_view unit);
/// The name without its unit: "clearance_m" -> "clearance".
std::string_view withoutUnit(std::string_view port_name);

/// nullopt if `text` is not of that type. Numbers are finite, in the C locale, and may have blanks around them; bool is
/// a word of truthOfWord(), 1 or 0. `unit` is that of the port and is used for kDuration only.
std::optional<Value> parseValue(std::string_view text, PortType type, std::string_view unit);

/// The number that the whole text is, without blanks around it: a whole one if it can be; nullopt for any other text.
std::optional<Value> numberOfText(std::string_view text);

/// The greatest number that durationOf() takes in a unit of time.
double longestTime(std::string_view unit);
/// `number` times the unit of time; nothing if it is no unit of time, or the time too long.
std::optional<Duration> durationOf(double number, std::string_view unit);

/// Names with a number: the enumerators that an application gives to scripts.
using Constants = std::map<std::string, std::int64_t, std::less<>>;

/// Of true, True, TRUE, false, False and FALSE; nullopt for any other word.
std::optional<bool> truthOfWord(std::string_view word);

/// A text that parseValue reads back (durations: nanoseconds, for people).
std::string toString(const Value& value);

}  // namespace swiftlet::tree

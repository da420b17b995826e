#include "behaviors/tree/port.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <type_traits>

#include <fmt/core.h>

namespace swiftlet::tree {
namespace {

/// The quantity that a range limits: the number itself, or a duration in the unit of its port.
std::optional<double> magnitude(const Value& value, std::string_view port_name) {
  if (const auto* number = std::get_if<double>(&value)) return *number;
  if (const auto* number = std::get_if<std::int64_t>(&value)) return static_cast<double>(*number);
  if (const auto* duration = std::get_if<Duration>(&value)) {
    const auto one = parseValue("1", PortType::kDuration, unitOf(port_name));
    if (one)
      return static_cast<double>(duration->nanoseconds) / static_cast<double>(std::get<Duration>(*one).nanoseconds);
  }
  return std::nullopt;
}

bool inRange(const PortManifest& port, const Value& value) {
  if (!port.minimum && !port.maximum) return true;
  const auto number = magnitude(value, port.name);
  return !number || ((!port.minimum || *number >= *port.minimum) && (!port.maximum || *number <= *port.maximum));
}

/// The value of an entry in the type of this port: a whole number is also a number, a number is a time in the port's
/// unit, text is parsed, and numbers are also text.
template <typename T>
std::optional<T> converted(const PortManifest& port, const Value& value) {
  if (allowedTexts(port).empty())
    if (const T* exact = std::get_if<T>(&value)) return inRange(port, value) ? std::optional<T>(*exact) : std::nullopt;
  if constexpr (std::is_same_v<T, double>)
    if (const auto* number = std::get_if<std::int64_t>(&value); number != nullptr && inRange(port, value))
      return static_cast<double>(*number);
  // Scripts compute with numbers: 3.0 is a whole number, and 0 and 1 are truth values.
  const auto* number = std::get_if<double>(&value);
  if constexpr (std::is_same_v<T, std::int64_t>)
    if (number != nullptr && std::trunc(*number) == *number && std::abs(*number) < 9e15 && inRange(port, value))
      return static_cast<std::int64_t>(*number);
  const auto* whole = std::get_if<std::int64_t>(&value);
  if constexpr (std::is_same_v<T, Duration>)
    if (number != nullptr || whole != nullptr) {
      const auto duration = durationOf(number != nullptr ? *number : static_cast<double>(*whole), unitOf(port.name));
      return duration && inRange(port, *duration) ? duration : std::nullopt;
    }
  if constexpr (std::is_same_v<T, bool>) {
    const double bit = number != nullptr ? *number : whole != nullptr ? static_cast<double>(*whole) : -1.0;
    if (bit == 0.0 || bit == 1.0) return bit == 1.0;
  }
  if constexpr (std::is_same_v<T, std::string>)
    if (number != nullptr || std::holds_alternative<std::int64_t>(value) || std::holds_alternative<bool>(value)) {
      const ReadValue read = readValue(port, toString(value));
      return read.value ? std::optional<T>(std::get<std::string>(*read.value)) : std::nullopt;
    }
  if (const auto* text = std::get_if<std::string>(&value)) {
    const ReadValue read = readValue(port, *text);
    if (read.value)
      if (const T* result = std::get_if<T>(&*read.value)) return *result;
  }
  return std::nullopt;
}

}  // namespace

namespace {

std::string expectedValueOf(const PortManifest& port) {
  std::string text;
  for (const std::string& allowed : allowedTexts(port)) text += (text.empty() ? "" : " or ") + allowed;
  if (!text.empty()) return text;
  if (port.names_entry) return "an entry";
  if (port.elements && *port.elements != PortType::kString)
    return fmt::format("a list with `;` between, each element a {}", toString(*port.elements));
  if (port.elements) return "a list of texts with `;` between";
  switch (port.type) {
    case PortType::kAny:
    case PortType::kString:
      return "text";
    case PortType::kDouble:
      text = "a number";
      break;
    case PortType::kInt:
      text = "a whole number";
      break;
    case PortType::kBool:
      return "true or false";
    case PortType::kPoint:
      return "a point `x;y` or `x;y;z` in metres";
    case PortType::kPoints:
      return "points `x;y | x;y;z | ...` in metres";
    case PortType::kRectangle:
      return "a rectangle `x_min;y_min;x_max;y_max` in metres, each minimum below its maximum";
    case PortType::kScript:
      return "a script";
    case PortType::kDuration:
      text = "a time";
      break;
  }
  if (const auto words = unitInWords(unitOf(port.name)); !words.empty()) text += fmt::format(" in {}", words);
  if (port.minimum && port.maximum)
    text += fmt::format(" from {} to {}", toString(Value(*port.minimum)), toString(Value(*port.maximum)));
  else if (port.minimum)
    text += " not below " + toString(Value(*port.minimum));
  else if (port.maximum)
    text += " not above " + toString(Value(*port.maximum));
  return text;
}

/// The text itself if any text is allowed; else the allowed text that it is, or the choice with this number.
std::optional<std::string_view> choiceOf(const PortManifest& port, std::string_view text) {
  const auto& allowed = allowedTexts(port);
  if (allowed.empty() || std::find(allowed.begin(), allowed.end(), text) != allowed.end()) return text;
  const auto& choices = port.choices;
  const auto number = parseValue(text, PortType::kInt, {});
  const std::int64_t index = number ? std::get<std::int64_t>(*number) : -1;
  if (index < 0 || index >= static_cast<std::int64_t>(choices.size())) return std::nullopt;
  return choices[static_cast<std::size_t>(index)];
}

/// The first element that is not of the type; nothing if all are.
std::optional<std::string_view> wrongElement(std::string_view list, PortType type) {
  while (!list.empty()) {
    const std::size_t end = list.find(';');
    const std::string_view element = list.substr(0, end);
    if (!parseValue(element, type, {})) return element;
    list.remove_prefix(end == std::string_view::npos ? list.size() : end + 1);
  }
  return std::nullopt;
}

Message outOfRange(const PortManifest& port, std::string_view text) {
  return Message("tree.value-range", "`{}` is out of range, expected {}", text, expectedOf(port));
}

/// A time whose number is right, but too large for any port.
Message longTime(PortManifest port, std::string_view text) {
  port.maximum = longestTime(unitOf(port.name));
  return outOfRange(port, text);
}

}  // namespace

const std::vector<std::string>& allowedTexts(const PortManifest& port) {
  static const std::vector<std::string> kStatuses = {"SUCCESS", "FAILURE", "RUNNING", "SKIPPED"};
  return port.names_status ? kStatuses : port.choices;
}

std::string expectedOf(const PortManifest& port) {
  if (port.direction != Direction::kOutput) return expectedValueOf(port);
  return port.type == PortType::kAny ? "an entry" : "an entry for " + expectedValueOf(port);
}

ReadValue readValue(const PortManifest& port, std::string_view text) {
  ReadValue read;
  if (const auto chosen = choiceOf(port, text)) read.value = parseValue(*chosen, port.type, unitOf(port.name));
  if (!read.value && port.type == PortType::kDuration && parseValue(text, PortType::kDouble, {})) {
    read.problem = longTime(port, text);
  } else if (!read.value) {
    read.problem = Message("tree.value-type", "`{}` is not {}", text, expectedOf(port));
  } else if (!inRange(port, *read.value)) {
    read.value.reset();
    read.problem = outOfRange(port, text);
  } else if (const auto wrong = port.elements ? wrongElement(text, *port.elements) : std::nullopt) {
    read.value.reset();
    read.problem =
        Message("tree.list-element", "the element `{}` of `{}` is not a {}", *wrong, text, toString(*port.elements));
  }
  return read;
}

void Slot::writeText(std::string_view text) {
  auto* held = value ? std::get_if<std::string>(&*value) : nullptr;
  if (held == nullptr) return write(std::string(text));
  held->assign(text);
  number_of_text.reset();
  ++writes;
}

const PortBinding& NodeSetup::port(std::string_view port_name) const {
  for (const PortBinding& binding : ports)
    if (binding.manifest->name == port_name) return binding;
  assert(!"the manifest does not declare this port");
  static const PortBinding kNothing;
  return kNothing;
}

template <typename T>
std::optional<T> Input<T>::get() const {
  if (binding_.literal) {
    const T* value = std::get_if<T>(&*binding_.literal);
    return value == nullptr ? std::nullopt : std::optional<T>(*value);
  }
  if (binding_.slot == nullptr || !binding_.slot->value) return std::nullopt;
  return converted<T>(*binding_.manifest, *binding_.slot->value);
}

template <typename T>
std::string Input<T>::problem() const {
  if (binding_.manifest == nullptr) return "no such port";
  const std::string& port = binding_.manifest->name;
  const Slot* slot = binding_.slot;
  if (slot == nullptr) return fmt::format("port {}: not given", port);
  if (!slot->value) return fmt::format("port {}: the entry {{{}}} is not set", port, slot->name);
  return fmt::format("port {}: the entry {{{}}} is `{}`, expected {}", port, slot->name, toString(*slot->value),
                     expectedOf(*binding_.manifest));
}

namespace {

template <typename T>
std::string problemAs(const PortBinding& binding) {
  const Input<T> input(binding);
  return !input.given() || input.get() ? std::string() : input.problem();
}

}  // namespace

std::string readingProblem(const PortBinding& binding) {
  switch (binding.manifest->type) {
    case PortType::kAny:
    case PortType::kScript:
      return binding.slot == nullptr || binding.slot->value ? "" : problemAs<std::string>(binding);
    case PortType::kString:
      return problemAs<std::string>(binding);
    case PortType::kDouble:
      return problemAs<double>(binding);
    case PortType::kInt:
      return problemAs<std::int64_t>(binding);
    case PortType::kBool:
      return problemAs<bool>(binding);
    case PortType::kPoint:
      return problemAs<Point>(binding);
    case PortType::kPoints:
      return problemAs<Points>(binding);
    case PortType::kRectangle:
      return problemAs<Rectangle>(binding);
    case PortType::kDuration:
      return problemAs<Duration>(binding);
  }
  return {};
}

template class Input<std::string>;
template class Input<double>;
template class Input<std::int64_t>;
template class Input<bool>;
template class Input<Point>;
template class Input<Points>;
template class Input<Rectangle>;
template class Input<Duration>;

}  // namespace swiftlet::tree

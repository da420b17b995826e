#include "behaviors/tree/script/operand.hpp"

#include <charconv>
#include <cmath>
#include <limits>
#include <string>

namespace swiftlet::tree {
namespace {

struct ToOperand {
  const Value& value;
  Operand operator()(const std::string& text) const { return std::string_view(text); }
  Operand operator()(double number) const { return number; }
  Operand operator()(std::int64_t number) const { return number; }
  Operand operator()(bool yes) const { return yes; }
  template <typename Other>
  Operand operator()(const Other&) const {
    return &value;
  }
};

struct ToValue {
  Value operator()(std::string_view text) const { return std::string(text); }
  Value operator()(const Value* value) const { return *value; }
  template <typename Number>
  Value operator()(Number number) const {
    return number;
  }
};

/// The number that an operand is beside a number or a truth value: the word `true` is 1.
std::optional<double> comparedAs(const Operand& operand) {
  if (const auto* text = std::get_if<std::string_view>(&operand))
    if (const auto truth = truthOfWord(*text)) return *truth ? 1.0 : 0.0;
  return numberOf(operand);
}

}  // namespace

const char* kindOf(const Operand& operand) {
  constexpr const char* kKinds[] = {"a number", "a number", "true or false", "text"};
  if (operand.index() < std::size(kKinds)) return kKinds[operand.index()];
  const Value& value = *std::get<const Value*>(operand);
  if (std::holds_alternative<Point>(value)) return "a point";
  if (std::holds_alternative<Points>(value)) return "points";
  return std::holds_alternative<Rectangle>(value) ? "a rectangle" : "a time";
}

Operand operandOf(const Value& value) { return std::visit(ToOperand{value}, value); }
Value valueOf(const Operand& operand) { return std::visit(ToValue{}, operand); }

std::optional<double> numberOf(const Operand& operand) {
  if (const auto* number = std::get_if<double>(&operand)) return *number;
  if (const auto* whole = std::get_if<std::int64_t>(&operand)) return static_cast<double>(*whole);
  if (const auto* yes = std::get_if<bool>(&operand)) return *yes ? 1.0 : 0.0;
  const auto* text = std::get_if<std::string_view>(&operand);
  if (text == nullptr) return std::nullopt;
  double number = 0.0;
  const auto [end, error] = std::from_chars(text->data(), text->data() + text->size(), number);
  const bool all = error == std::errc{} && end == text->data() + text->size();
  return all && std::isfinite(number) ? std::optional(number) : std::nullopt;
}

std::optional<double> numberNamed(std::string_view text, const Constants* constants) {
  if (constants != nullptr && !constants->empty())
    if (const auto known = constants->find(text); known != constants->end()) return static_cast<double>(known->second);
  return comparedAs(text);
}

std::optional<std::int64_t> wholeOf(const Operand& operand) {
  if (const auto* whole = std::get_if<std::int64_t>(&operand)) return *whole;
  const auto number = numberOf(operand);
  constexpr double kExact = 9007199254740992.0;  // 2^53: every whole number up to it is a double.
  if (!number || std::trunc(*number) != *number || std::abs(*number) > kExact) return std::nullopt;
  return static_cast<std::int64_t>(*number);
}

std::optional<bool> truthOf(const Operand& operand) {
  if (const auto* yes = std::get_if<bool>(&operand)) return *yes;
  if (const auto* text = std::get_if<std::string_view>(&operand))
    if (const auto truth = truthOfWord(*text)) return truth;
  const auto number = numberOf(operand);
  return number ? std::optional(*number != 0.0) : std::nullopt;
}

std::optional<std::partial_ordering> compare(const Operand& a, const Operand& b) {
  const auto* text_a = std::get_if<std::string_view>(&a);
  const auto* text_b = std::get_if<std::string_view>(&b);
  if (text_a != nullptr && text_b != nullptr) return text_a->compare(*text_b) <=> 0;
  const auto* other_a = std::get_if<const Value*>(&a);
  const auto* other_b = std::get_if<const Value*>(&b);
  if (other_a != nullptr && other_b != nullptr) {
    const auto* time_a = std::get_if<Duration>(*other_a);
    const auto* time_b = std::get_if<Duration>(*other_b);
    if (time_a != nullptr && time_b != nullptr) return *time_a <=> *time_b;
    if ((*other_a)->index() != (*other_b)->index()) return std::nullopt;
    return **other_a == **other_b ? std::partial_ordering::equivalent : std::partial_ordering::unordered;
  }
  const auto number_a = comparedAs(a), number_b = comparedAs(b);
  return number_a && number_b ? std::optional(*number_a <=> *number_b) : std::nullopt;
}

bool areEqual(double a, double b) {
  return a == b || std::abs(a - b) <= static_cast<double>(std::numeric_limits<float>::epsilon());
}

bool areEqual(const Operand& a, const Operand& b) {
  const bool texts = std::holds_alternative<std::string_view>(a) && std::holds_alternative<std::string_view>(b);
  const auto number_a = texts ? std::nullopt : comparedAs(a), number_b = texts ? std::nullopt : comparedAs(b);
  if (number_a && number_b) return areEqual(*number_a, *number_b);
  const auto order = compare(a, b);
  return order && *order == 0;
}

}  // namespace swiftlet::tree

// The values that a script computes with: numbers, truth values, text, and other values of entries as a whole.
#pragma once

#include <compare>
#include <cstdint>
#include <optional>
#include <string_view>
#include <variant>

#include "behaviors/tree/value.hpp"

namespace swiftlet::tree {

/// Text and other values are not copied: they belong to an entry or to the script, and are valid until it is written.
using Operand = std::variant<double, std::int64_t, bool, std::string_view, const Value*>;

/// "number", "text", "point" ...: for messages.
const char* kindOf(const Operand& operand);

Operand operandOf(const Value& value);
Value valueOf(const Operand& operand);

/// Truth values are 0 or 1, and text that is a number is that number; nothing for all else.
std::optional<double> numberOf(const Operand& operand);
/// Only of numbers without a fraction.
std::optional<std::int64_t> wholeOf(const Operand& operand);
/// Numbers are true unless they are 0, text is `true` or `false`, also `True` and `TRUE`; nothing for all else.
std::optional<bool> truthOf(const Operand& operand);

/// The number that a text is beside a number: a numeral, the word `true` as 1, a constant as its number.
std::optional<double> numberNamed(std::string_view text, const Constants* constants);

/// Two texts as text, numbers as numbers (the words `true` and `false` are 1 and 0 beside one), other values only if
/// they are of one kind; nothing if they cannot be compared or, as two points, have no order.
std::optional<std::partial_ordering> compare(const Operand& a, const Operand& b);
/// Within the spacing of floats at 1, 1.2e-7, as in BehaviorTree.CPP: 0.1 + 0.2 is 0.3.
bool areEqual(double a, double b);
/// As compare() says; numbers as above. Values that cannot be compared are not equal.
bool areEqual(const Operand& a, const Operand& b);

}  // namespace swiftlet::tree

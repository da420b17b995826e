#include "behaviors/tree/script/script.hpp"

#include <cmath>
#include <utility>

#include <fmt/core.h>

namespace swiftlet::tree {
namespace {

/// Whole numbers stay whole while they fit.
std::optional<std::int64_t> wholeResult(char op, std::int64_t a, std::int64_t b) {
  std::int64_t result = 0;
  const bool too_large = op == '+'   ? __builtin_add_overflow(a, b, &result)
                         : op == '-' ? __builtin_sub_overflow(a, b, &result)
                                     : __builtin_mul_overflow(a, b, &result);
  return too_large ? std::nullopt : std::optional(result);
}

double realResult(ScriptOp op, double a, double b) {
  switch (op) {
    case ScriptOp::kAdd:
      return a + b;
    case ScriptOp::kSubtract:
      return a - b;
    case ScriptOp::kMultiply:
      return a * b;
    default:
      return a / b;
  }
}

void append(std::string& text, const Operand& operand) {
  if (const auto* words = std::get_if<std::string_view>(&operand))
    text += *words;
  else
    text += toString(valueOf(operand));
}

}  // namespace

Scripts::Added Scripts::add(std::string_view text) {
  ScriptCompiler::Result result = compiler_.compile(text, code_);
  if (result.problem) return {nullptr, std::move(result.problem)};
  slots_.resize(code_.entries.size());
  joined_.resize(code_.joins);
  return {&scripts_.emplace_back(*this, result.program), {}};
}

std::span<const ScriptEntry> Script::entries() const { return program_.entries.of(owner_->code_.entries); }
std::span<const ScriptWrite> Script::writes() const { return program_.writes.of(owner_->code_.writes); }
std::span<const ScriptPairing> Script::pairings() const { return program_.pairings.of(owner_->code_.pairings); }
void Script::bind(std::size_t entry, Slot* slot) { owner_->slots_[program_.entries.begin + entry] = slot; }
const Slot& Script::slot(std::size_t entry) const { return *owner_->slots_[program_.entries.begin + entry]; }
const Value& Script::constant(std::size_t index) const { return owner_->code_.constants[index]; }

std::optional<Operand> Script::run() {
  std::optional<Operand> last;
  for (const std::uint32_t statement : program_.statements.of(owner_->code_.statements)) {
    last = evaluate(statement);
    if (!last) return std::nullopt;
  }
  return last;
}

std::optional<bool> Script::holds() {
  const auto value = run();
  if (!value) return std::nullopt;
  const auto truth = truthOf(*value);
  if (!truth) return fail(fmt::format("is {}, expected true or false", kindOf(*value)));
  return truth;
}

std::nullopt_t Script::fail(std::string problem) {
  problem_ = std::move(problem);
  return std::nullopt;
}

std::nullopt_t Script::failUnset(std::uint32_t entry, std::string_view remedy) {
  return fail(fmt::format("the entry {{{}}} is not set{}", owner_->code_.entries[entry].name, remedy));
}

std::optional<Operand> Script::evaluate(std::uint32_t index) {
  const Expression& expression = owner_->code_.expressions[index];
  switch (expression.op) {
    case Op::kConstant:
      return operandOf(owner_->code_.constants[expression.of]);
    case Op::kEntry: {
      const Slot& slot = *owner_->slots_[expression.of];
      if (!slot.value) return failUnset(expression.of, {});
      return operandOf(slot.number_of_text ? *slot.number_of_text : *slot.value);
    }
    case Op::kAnd:
    case Op::kOr: {
      const auto a = truth(expression.a);
      if (!a) return std::nullopt;
      if (*a == (expression.op == Op::kOr)) return *a;
      const auto b = truth(expression.b);
      return b ? std::optional<Operand>(*b) : std::nullopt;
    }
    case Op::kChoice: {
      const auto a = chosen(expression.a);
      if (!a) return std::nullopt;
      return evaluate(*a ? expression.b : expression.c);
    }
    case Op::kMake:
    case Op::kAssign:
      return assign(expression);
    case Op::kNot: {
      const auto a = truth(expression.a);
      return a ? std::optional<Operand>(!*a) : std::nullopt;
    }
    case Op::kNegate:
    case Op::kInvertBits: {
      const auto a = evaluate(expression.a);
      return a ? evaluateUnary(expression, *a) : std::nullopt;
    }
    case Op::kEqual:
    case Op::kUnequal:
    case Op::kLess:
    case Op::kLessEqual:
    case Op::kGreater:
    case Op::kGreaterEqual: {
      const auto link = evaluateLink(expression);
      return link ? std::optional<Operand>(link->holds) : std::nullopt;
    }
    default: {
      auto a = evaluate(expression.a);
      if (!a) return std::nullopt;
      std::optional<Value> kept;
      const auto b = evaluateRight(expression, *a, kept);
      return b ? evaluateBinary(expression, *a, *b) : std::nullopt;
    }
  }
}

/// The right operand. The left one may refer to an entry; it is copied into `kept` if the right one assigns.
std::optional<Operand> Script::evaluateRight(const Expression& expression, Operand& a, std::optional<Value>& kept) {
  if (expression.keeps) {
    kept = valueOf(a);
    a = operandOf(*kept);
  }
  return evaluate(expression.b);
}

std::optional<Script::Link> Script::evaluateLink(const Expression& expression) {
  std::optional<Operand> a;
  if (expression.linked) {
    const auto before = evaluateLink(owner_->code_.expressions[expression.a]);
    if (!before || !before->holds) return before;
    a = before->right;
  } else {
    a = evaluate(expression.a);
  }
  if (!a) return std::nullopt;
  std::optional<Value> kept;
  const auto b = evaluateRight(expression, *a, kept);
  if (!b) return std::nullopt;
  const auto holds = comparison(expression.op, *a, *b);
  return holds ? std::optional(Link{*holds, *b}) : std::nullopt;
}

/// Of the condition of a choice.
std::optional<bool> Script::chosen(std::uint32_t index) {
  const auto value = evaluate(index);
  if (!value) return std::nullopt;
  if (const auto truth = truthOf(*value)) return truth;
  const auto* text = std::get_if<std::string_view>(&*value);
  if (text != nullptr && !text->empty()) return true;
  return fail(std::string(kindOf(*value)) + " is neither true nor false");
}

std::optional<bool> Script::truth(std::uint32_t index) {
  const auto value = evaluate(index);
  if (!value) return std::nullopt;
  const auto truth = truthOf(*value);
  if (!truth) return fail(std::string(kindOf(*value)) + " is neither true nor false");
  return truth;
}

std::optional<Operand> Script::evaluateUnary(const Expression& expression, const Operand& a) {
  if (expression.op == Op::kInvertBits) {
    const auto whole = wholeOf(a);
    return whole ? std::optional<Operand>(~*whole) : fail("`~` needs a whole number");
  }
  return arithmetic(Op::kSubtract, std::int64_t{0}, a);
}

std::optional<Operand> Script::evaluateBinary(const Expression& expression, const Operand& a, const Operand& b) {
  switch (expression.op) {
    case Op::kAdd:
      return sum(expression, a, b);
    case Op::kSubtract:
    case Op::kMultiply:
    case Op::kDivide:
      return arithmetic(expression.op, a, b);
    case Op::kAndBits:
    case Op::kXorBits:
    case Op::kOrBits:
      return bits(expression.op, a, b);
    default:
      return join(expression.of, a, b);
  }
}

std::optional<Operand> Script::sum(const Expression& expression, const Operand& a, const Operand& b) {
  const bool texts = std::holds_alternative<std::string_view>(a) && std::holds_alternative<std::string_view>(b);
  return texts ? join(expression.of, a, b) : arithmetic(Op::kAdd, a, b);
}

std::optional<Operand> Script::arithmetic(Op op, const Operand& a, const Operand& b) {
  const auto* whole_a = std::get_if<std::int64_t>(&a);
  const auto* whole_b = std::get_if<std::int64_t>(&b);
  if (whole_a != nullptr && whole_b != nullptr && op != Op::kDivide) {
    const char sign = op == Op::kAdd ? '+' : op == Op::kSubtract ? '-' : '*';
    if (const auto whole = wholeResult(sign, *whole_a, *whole_b)) return *whole;
  }
  const auto number_a = numberOf(a), number_b = numberOf(b);
  if (!number_a || !number_b) return fail(fmt::format("{} is not a number", kindOf(number_a ? b : a)));
  if (op == Op::kDivide && *number_b == 0.0) return fail("division by zero");
  const double result = realResult(op, *number_a, *number_b);
  return std::isfinite(result) ? std::optional<Operand>(result) : fail("the result is not a finite number");
}

std::optional<Operand> Script::bits(Op op, const Operand& a, const Operand& b) {
  const auto whole_a = wholeOf(a), whole_b = wholeOf(b);
  if (!whole_a || !whole_b) return fail("`&`, `|` and `^` need whole numbers");
  if (op == Op::kAndBits) return *whole_a & *whole_b;
  return op == Op::kXorBits ? *whole_a ^ *whole_b : *whole_a | *whole_b;
}

std::optional<bool> Script::comparison(Op op, const Operand& a, const Operand& b) {
  const Operand left = constantBeside(a, b), right = constantBeside(b, a);
  if (op == Op::kEqual) return areEqual(left, right);
  if (op == Op::kUnequal) return !areEqual(left, right);
  const auto order = compare(left, right);
  if (!order || *order == std::partial_ordering::unordered)
    return fail(fmt::format("{} and {} have no order", kindOf(a), kindOf(b)));
  if (op == Op::kLess) return *order < 0;
  if (op == Op::kLessEqual) return *order <= 0;
  return op == Op::kGreater ? *order > 0 : *order >= 0;
}

/// Beside a number, the text 'RED' is the constant RED.
Operand Script::constantBeside(const Operand& operand, const Operand& other) const {
  const auto* text = std::get_if<std::string_view>(&operand);
  if (text == nullptr || owner_->constants_.empty() || std::holds_alternative<std::string_view>(other)) return operand;
  const auto known = owner_->constants_.find(*text);
  return known == owner_->constants_.end() ? operand : Operand(known->second);
}

std::optional<Operand> Script::join(std::uint32_t buffer, const Operand& a, const Operand& b) {
  std::string& text = owner_->joined_[buffer];
  text.clear();
  append(text, a);
  append(text, b);
  constexpr std::size_t kLongest = 65'536;  // A tree that joins at every tick must not fill the memory.
  if (text.size() > kLongest) return fail("a text grew longer than 65536 characters");
  return std::string_view(text);
}

std::optional<Operand> Script::assign(const Expression& expression) {
  const auto value = evaluate(expression.a);
  if (!value) return std::nullopt;
  Slot& slot = *owner_->slots_[expression.of];
  if (expression.op == Op::kAssign && !slot.value) return failUnset(expression.of, "; `:=` makes it");
  const auto* words = std::get_if<std::string_view>(&*value);
  if (words != nullptr)
    slot.writeText(*words);
  else
    slot.write(valueOf(*value));
  return operandOf(*slot.value);
}

}  // namespace swiftlet::tree

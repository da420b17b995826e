#include "behaviors/tree/script/compiler.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>

#include <fmt/core.h>

#include "behaviors/tree/characters.hpp"
#include "behaviors/tree/script/operand.hpp"

namespace swiftlet::tree {
namespace {

/// Parentheses and signs within each other; each takes some frames of the stack.
constexpr int kDeepest = 100;
/// Bounds the depth of the expression of `a + a + a ...`, which is evaluated from the left.
constexpr std::size_t kMostTokens = 2000;

/// From loose to tight.
constexpr int kComparison = 2;
struct BinarySign {
  std::string_view text;
  ScriptOp op;
  int level;
};
constexpr std::array<BinarySign, 16> kBinarySigns = {{{"||", ScriptOp::kOr, 0},
                                                      {"&&", ScriptOp::kAnd, 1},
                                                      {"==", ScriptOp::kEqual, kComparison},
                                                      {"!=", ScriptOp::kUnequal, kComparison},
                                                      {"<=", ScriptOp::kLessEqual, kComparison},
                                                      {">=", ScriptOp::kGreaterEqual, kComparison},
                                                      {"<", ScriptOp::kLess, kComparison},
                                                      {">", ScriptOp::kGreater, kComparison},
                                                      {"|", ScriptOp::kOrBits, 3},
                                                      {"^", ScriptOp::kXorBits, 3},
                                                      {"&", ScriptOp::kAndBits, 4},
                                                      {"..", ScriptOp::kJoin, 5},
                                                      {"+", ScriptOp::kAdd, 5},
                                                      {"-", ScriptOp::kSubtract, 5},
                                                      {"*", ScriptOp::kMultiply, 6},
                                                      {"/", ScriptOp::kDivide, 6}}};

/// The sign between two operands that the token is, if it is one and not looser than `loosest`.
const BinarySign* binarySign(const Token& token, int loosest) {
  if (token.kind != TokenKind::kSign) return nullptr;
  const auto* sign = std::find_if(kBinarySigns.begin(), kBinarySigns.end(),
                                  [&](const BinarySign& known) { return token.isSign(known.text); });
  return sign == kBinarySigns.end() || sign->level < loosest ? nullptr : sign;
}

std::string place(std::string_view text, const Token& token) {
  if (token.kind == TokenKind::kEnd) return fmt::format("at the end of `{}`", text);
  const std::string where = fmt::format("at `{}`", token.text);
  if (token.kind != TokenKind::kBad) return where;
  if (token.text.front() == '\'' || token.text.front() == '"') return where + ", a text without an end";
  const bool ascii = static_cast<unsigned char>(token.text.front()) < 0x80;
  return ascii ? where : fmt::format("{}, which is {}: only texts may hold it", where, nameOfCharacter(token.text, 0));
}

/// For people who write the operators of other languages: `and` and `or` stand where a sign is expected, and what
/// follows `not` does.
std::string_view wordHint(const Token& before, const Token& token) {
  if (before.kind == TokenKind::kName && before.text == "not") return "; write ! for `not`";
  if (token.kind != TokenKind::kName) return {};
  if (token.text == "and") return "; write && (in XML &amp;&amp;)";
  return token.text == "or" ? "; write ||" : "";
}

}  // namespace

ScriptCompiler::Result ScriptCompiler::compile(std::string_view text, ScriptCode& code) {
  text_ = text;
  code_ = &code;
  first_entry_ = code.entries.size();
  readTokens(text, tokens_);
  position_ = 0;
  depth_ = 0;
  problem_.reset();
  const std::size_t first_statement = code.statements.size(), first_write = code.writes.size(),
                    first_pairing = code.pairings.size();
  if (tokens_.size() > kMostTokens) problem_ = Message("tree.script-long", "it is longer than {} words", kMostTokens);
  while (!problem_) {
    while (take(";")) {}
    if (next().kind == TokenKind::kEnd) break;
    code.statements.push_back(expression());
    if (!problem_ && next().kind != TokenKind::kEnd && !at(";")) fail(next(), "an operator or `;`");
  }
  if (!problem_ && code.statements.size() == first_statement)
    problem_ = Message("tree.script-empty", "it has no statement");
  return {{.text = text,
           .statements = {first_statement, code.statements.size()},
           .entries = {first_entry_, code.entries.size()},
           .writes = {first_write, code.writes.size()},
           .pairings = {first_pairing, code.pairings.size()}},
          problem_};
}

/// An assignment, or a choice: what a statement and parentheses hold.
ScriptCompiler::Index ScriptCompiler::expression() {
  constexpr std::array<std::string_view, 6> kAssignments = {":=", "=", "+=", "-=", "*=", "/="};
  if (next().kind != TokenKind::kName) return choice();
  const Token& second = tokens_[position_ + 1];
  const auto* sign = std::find_if(kAssignments.begin(), kAssignments.end(),
                                  [&](std::string_view known) { return second.isSign(known); });
  if (sign == kAssignments.end()) return choice();
  const std::string_view name = next().text;
  if (name == "true" || name == "false" || constants_.contains(name))
    return fail(next(), fmt::format("the name of an entry before `{}`, but it is a constant", *sign));
  position_ += 2;
  if (++depth_ > kDeepest) return fail(next(), "fewer than 100 levels");
  const Index assigned = assignment(name, *sign);
  --depth_;
  return assigned;
}

/// `x += a` is `x = x + a`.
ScriptCompiler::Index ScriptCompiler::assignment(std::string_view name, std::string_view sign) {
  const bool makes = sign == ":=";
  const bool computes = sign.size() == 2 && !makes;
  std::optional<Index> old;
  if (computes) old = add({.op = Op::kEntry, .of = entry(name, true)});
  const std::size_t writes_before = code_->writes.size();
  Index value = expression();
  if (computes) {
    const Op op = sign == "+=" ? Op::kAdd : sign == "-=" ? Op::kSubtract : sign == "*=" ? Op::kMultiply : Op::kDivide;
    value = addBinary(op, *old, value, writes_before);
  }
  if (problem_) return 0;
  const Index written = entry(name, !makes);
  recordWrite(written, makes, code_->expressions[value]);
  return add({.op = makes ? Op::kMake : Op::kAssign, .a = value, .of = written});
}

void ScriptCompiler::recordWrite(Index entry, bool makes, ScriptExpression value) {
  while (value.op == Op::kMake || value.op == Op::kAssign) value = code_->expressions[value.a];
  code_->entries[entry].set = true;
  ScriptWrite& write = code_->writes.emplace_back();
  write.entry = entry - first_entry_;
  write.makes = makes;
  if (value.op == Op::kConstant)
    write.constant = value.of;
  else if (value.op == Op::kEntry)
    write.copied = value.of - first_entry_;
  else if (value.op >= Op::kEqual && value.op <= Op::kOr)
    write.type = PortType::kBool;
  else if (value.op == Op::kJoin)
    write.type = PortType::kString;
}

ScriptCompiler::Index ScriptCompiler::choice() {
  if (++depth_ > kDeepest) return fail(next(), "fewer than 100 levels");
  Index condition = binary(0);
  if (take("?")) {
    const Index yes = expression();
    if (!take(":")) return fail(next(), "`:`");
    const Index no = choice();
    condition = add({.op = Op::kChoice, .a = condition, .b = yes, .c = no});
  }
  --depth_;
  return condition;
}

/// An operand, and what the signs that are not looser than `loosest` make of it (precedence climbing).
ScriptCompiler::Index ScriptCompiler::binary(int loosest) {
  Index left = unary();
  while (const BinarySign* sign = binarySign(next(), loosest)) {
    if (sign->level == kComparison) {
      left = comparison(left);
      continue;
    }
    ++position_;
    const std::size_t writes_before = code_->writes.size();
    const Index right = binary(sign->level + 1);
    left = addBinary(sign->op, left, right, writes_before);
  }
  return left;
}

/// A chain `a < b < c` is `a < b && b < c`, but b is evaluated once: the second comparison is linked to the first.
ScriptCompiler::Index ScriptCompiler::comparison(Index left) {
  bool linked = false;
  while (const BinarySign* sign = binarySign(next(), kComparison)) {
    ++position_;
    const std::size_t writes_before = code_->writes.size();
    const Index right = binary(kComparison + 1);
    if (!problem_) recordPairing(sign->op, linked ? code_->expressions[left].b : left, right);
    left = addBinary(sign->op, left, right, writes_before);
    if (!problem_) code_->expressions[left].linked = linked;
    linked = true;
  }
  return left;
}

ScriptCompiler::Index ScriptCompiler::unary() {
  if (next().kind != TokenKind::kSign) return operand();
  for (const auto& [sign, op] : Signs{{"-", Op::kNegate}, {"!", Op::kNot}, {"~", Op::kInvertBits}}) {
    if (!take(sign)) continue;
    if (++depth_ > kDeepest) return fail(next(), "fewer than 100 levels");
    const Index inner = unary();
    --depth_;
    return add({.op = op, .a = inner});
  }
  return operand();
}

ScriptCompiler::Index ScriptCompiler::operand() {
  const Token token = next();
  if (take("(")) {
    const Index inner = expression();
    return take(")") ? inner : fail(next(), "`)`");
  }
  if (token.kind == TokenKind::kSign || token.kind == TokenKind::kEnd || token.kind == TokenKind::kBad)
    return fail(token, "a value");
  ++position_;
  if (token.kind == TokenKind::kNumber) return number(token);
  if (token.kind == TokenKind::kText) return constant(std::string(token.text));
  return name(token);
}

ScriptCompiler::Index ScriptCompiler::number(const Token& token) {
  const bool hex = token.text.size() > 1 && (token.text[1] == 'x' || token.text[1] == 'X');
  const std::string_view digits = hex ? token.text.substr(2) : token.text;
  const char* end = digits.data() + digits.size();
  std::int64_t whole = 0;
  const auto read_whole = std::from_chars(digits.data(), end, whole, hex ? 16 : 10);
  if (read_whole.ec == std::errc{} && read_whole.ptr == end) return constant(whole);
  double number = 0.0;
  const auto read = std::from_chars(digits.data(), end, number);
  const bool beyond = hex ? read_whole.ec == std::errc::result_out_of_range : read.ec == std::errc::result_out_of_range;
  if (beyond) return fail(token, hex ? "a number of at most 63 bits" : "a number from 1e-307 to 1e308, or 0,");
  if (hex || read.ec != std::errc{} || read.ptr != end) return fail(token, "a number");
  return constant(number);
}

ScriptCompiler::Index ScriptCompiler::name(const Token& token) {
  if (token.text == "true" || token.text == "false") return constant(token.text == "true");
  if (const auto known = constants_.find(token.text); known != constants_.end()) return constant(known->second);
  return add({.op = Op::kEntry, .of = entry(token.text, true)});
}

bool ScriptCompiler::isZero(const ScriptExpression& expression) const {
  if (expression.op != Op::kConstant) return false;
  const auto number = numberOf(operandOf(code_->constants[expression.of]));
  return number && *number == 0.0;
}

/// `right` was compiled when the code had `writes_before` assignments.
ScriptCompiler::Index ScriptCompiler::addBinary(Op op, Index left, Index right, std::size_t writes_before) {
  if (op == Op::kDivide && !problem_ && isZero(code_->expressions[right]))
    problem_ = Message("tree.script-division", "division by zero");
  if (op == Op::kAdd && !problem_) recordPairing(op, left, right);
  const auto buffer = static_cast<Index>(code_->joins);
  if (op == Op::kJoin || op == Op::kAdd) ++code_->joins;
  return add({.op = op, .keeps = code_->writes.size() > writes_before, .a = left, .b = right, .of = buffer});
}

std::optional<ScriptSide> ScriptCompiler::sideOf(Index operand) const {
  const ScriptExpression& expression = code_->expressions[operand];
  if (expression.op == Op::kEntry) return ScriptSide{true, expression.of - first_entry_};
  return expression.op == Op::kConstant ? std::optional(ScriptSide{false, expression.of}) : std::nullopt;
}

void ScriptCompiler::recordPairing(Op op, Index left, Index right) {
  const auto a = sideOf(left), b = sideOf(right);
  if (a && b) code_->pairings.push_back({op, *a, *b});
}

ScriptCompiler::Index ScriptCompiler::add(ScriptExpression expression) {
  code_->expressions.push_back(expression);
  return static_cast<Index>(code_->expressions.size() - 1);
}

template <typename T>
ScriptCompiler::Index ScriptCompiler::constant(T value) {
  code_->constants.emplace_back(std::move(value));
  return add({.op = Op::kConstant, .of = static_cast<Index>(code_->constants.size() - 1)});
}

ScriptCompiler::Index ScriptCompiler::entry(std::string_view name, bool read) {
  std::vector<ScriptEntry>& entries = code_->entries;
  std::size_t index = first_entry_;
  while (index < entries.size() && entries[index].name != name) ++index;
  if (index == entries.size()) entries.push_back({.name = name});
  entries[index].read = entries[index].read || (read && !entries[index].set);
  return static_cast<Index>(index);
}

bool ScriptCompiler::take(std::string_view sign) {
  if (!at(sign)) return false;
  ++position_;
  return true;
}

ScriptCompiler::Index ScriptCompiler::fail(const Token& token, std::string_view expected) {
  if (!problem_)
    problem_ = Message("tree.script-syntax", "expected {} {}{}", expected, place(text_, token),
                       wordHint(tokens_[position_ > 0 ? position_ - 1 : 0], token));
  position_ = tokens_.size() - 1;
  return 0;
}

}  // namespace swiftlet::tree

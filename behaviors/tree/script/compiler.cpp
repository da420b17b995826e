#include "behaviors/tree/script/compiler.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>

namespace swiftlet::tree {
namespace {

/// Parentheses and signs within each other; each takes some frames of the stack.
constexpr int kDeepest = 100;
/// Bounds the depth of the expression of `a + a + a ...`, which is evaluated from the left.
constexpr std::size_t kMostTokens = 2000;

std::string place(std::string_view text, const Token& token) {
  if (token.kind == TokenKind::kEnd) return "at the end of `" + std::string(text) + "`";
  const bool endless = token.kind == TokenKind::kBad && token.text.front() == '\'';
  return "at `" + std::string(token.text) + "`" + (endless ? ", a text without an end" : "");
}

}  // namespace

ProgramResult ScriptProgram::compile(std::string_view text, const Constants& constants) {
  return ScriptCompiler(text, constants).compile();
}

ProgramResult ScriptCompiler::compile() {
  if (tokens_.size() > kMostTokens) problem_ = "it is longer than " + std::to_string(kMostTokens) + " words";
  program_.expressions.reserve(tokens_.size());
  while (problem_.empty()) {
    while (take(";")) {}
    if (next().kind == TokenKind::kEnd) break;
    program_.statements.push_back(statement());
    if (problem_.empty() && next().kind != TokenKind::kEnd && !at(";")) fail(next(), "an operator or `;`");
  }
  if (problem_.empty() && program_.statements.empty()) problem_ = "it has no statement";
  if (!problem_.empty()) return {nullptr, problem_};
  program_.text = text_;
  return {std::make_shared<const ScriptProgram>(std::move(program_)), {}};
}

ScriptCompiler::Index ScriptCompiler::statement() {
  constexpr std::array<std::string_view, 6> kAssignments = {":=", "=", "+=", "-=", "*=", "/="};
  const bool named = next().kind == TokenKind::kName && tokens_[position_ + 1].kind == TokenKind::kSign;
  if (named) {
    const std::string_view name = next().text, sign = tokens_[position_ + 1].text;
    if (std::find(kAssignments.begin(), kAssignments.end(), sign) != kAssignments.end()) {
      if (name == "true" || name == "false" || constants_.contains(name))
        return fail(next(), "the name of an entry before `" + std::string(sign) + "`, but it is a constant");
      position_ += 2;
      return assignment(name, sign);
    }
  }
  return choice();
}

/// `x += a` is `x = x + a`.
ScriptCompiler::Index ScriptCompiler::assignment(std::string_view name, std::string_view sign) {
  const bool makes = sign == ":=";
  const bool computes = sign.size() == 2 && !makes;
  std::optional<Index> old;
  if (computes) old = add({.op = Op::kEntry, .of = static_cast<Index>(entry(name, true))});
  Index value = choice();
  if (computes) {
    const Op op = sign == "+=" ? Op::kAdd : sign == "-=" ? Op::kSubtract : sign == "*=" ? Op::kMultiply : Op::kDivide;
    value = add({.op = op, .a = *old, .b = value});
  }
  if (!problem_.empty()) return 0;
  const std::size_t written = entry(name, !makes);
  recordWrite(written, makes, program_.expressions[value]);
  return add({.op = makes ? Op::kMake : Op::kAssign, .a = value, .of = static_cast<Index>(written)});
}

void ScriptCompiler::recordWrite(std::size_t entry, bool makes, const ScriptProgram::Expression& value) {
  program_.entries[entry].set = true;
  ScriptWrite write{.entry = entry, .makes = makes, .literal = {}, .copied = {}, .type = PortType::kAny};
  if (value.op == Op::kConstant)
    write.literal = toString(program_.constants[value.of]);
  else if (value.op == Op::kEntry)
    write.copied = value.of;
  else if (value.op >= Op::kEqual && value.op <= Op::kOr)
    write.type = PortType::kBool;
  else if (value.op == Op::kJoin)
    write.type = PortType::kString;
  program_.writes.push_back(std::move(write));
}

ScriptCompiler::Index ScriptCompiler::choice() {
  if (++depth_ > kDeepest) return fail(next(), "fewer than 100 levels");
  Index condition = logic(0);
  if (take("?")) {
    const Index yes = choice();
    if (!take(":")) return fail(next(), "`:`");
    const Index no = choice();
    condition = add({.op = Op::kChoice, .a = condition, .b = yes, .c = no});
  }
  --depth_;
  return condition;
}

ScriptCompiler::Index ScriptCompiler::logic(std::size_t level) {
  if (level == 2) return comparison();
  const std::string_view sign = level == 0 ? "||" : "&&";
  Index left = logic(level + 1);
  while (take(sign)) left = add({.op = level == 0 ? Op::kOr : Op::kAnd, .a = left, .b = logic(level + 1)});
  return left;
}

/// A chain `a < b < c` is `a < b && b < c`.
ScriptCompiler::Index ScriptCompiler::comparison() {
  constexpr std::array<std::pair<std::string_view, Op>, 6> kSigns = {{{"==", Op::kEqual},
                                                                      {"!=", Op::kUnequal},
                                                                      {"<=", Op::kLessEqual},
                                                                      {">=", Op::kGreaterEqual},
                                                                      {"<", Op::kLess},
                                                                      {">", Op::kGreater}}};
  Index left = binary(0);
  std::optional<Index> chain;
  while (true) {
    const auto* sign = std::find_if(kSigns.begin(), kSigns.end(), [&](const auto& known) { return at(known.first); });
    if (sign == kSigns.end()) return chain.value_or(left);
    ++position_;
    const Index right = binary(0);
    const Index link = add({.op = sign->second, .a = left, .b = right});
    chain = chain ? add({.op = Op::kAnd, .a = *chain, .b = link}) : link;
    left = right;
  }
}

ScriptCompiler::Index ScriptCompiler::binary(std::size_t level) {
  static const std::array<std::vector<std::pair<std::string_view, Op>>, 6> kLevels = {
      {{{"|", Op::kOrBits}},
       {{"^", Op::kXorBits}},
       {{"&", Op::kAndBits}},
       {{"..", Op::kJoin}},
       {{"+", Op::kAdd}, {"-", Op::kSubtract}},
       {{"*", Op::kMultiply}, {"/", Op::kDivide}}}};
  if (level == kLevels.size()) return unary();
  Index left = binary(level + 1);
  while (true) {
    const auto& signs = kLevels[level];
    const auto sign = std::find_if(signs.begin(), signs.end(), [&](const auto& known) { return at(known.first); });
    if (sign == signs.end()) return left;
    ++position_;
    const Index right = binary(level + 1);
    const auto buffer = static_cast<Index>(program_.joins);
    if (sign->second == Op::kJoin) ++program_.joins;
    left = add({.op = sign->second, .a = left, .b = right, .of = buffer});
  }
}

ScriptCompiler::Index ScriptCompiler::unary() {
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
    const Index inner = choice();
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
  if (hex || read.ec != std::errc{} || read.ptr != end) return fail(token, "a number");
  return constant(number);
}

ScriptCompiler::Index ScriptCompiler::name(const Token& token) {
  if (token.text == "true" || token.text == "false") return constant(token.text == "true");
  if (const auto known = constants_.find(token.text); known != constants_.end()) return constant(known->second);
  return add({.op = Op::kEntry, .of = static_cast<Index>(entry(token.text, true))});
}

ScriptCompiler::Index ScriptCompiler::add(ScriptProgram::Expression expression) {
  program_.expressions.push_back(expression);
  return static_cast<Index>(program_.expressions.size() - 1);
}

ScriptCompiler::Index ScriptCompiler::constant(Value value) {
  program_.constants.push_back(std::move(value));
  return add({.op = Op::kConstant, .of = static_cast<Index>(program_.constants.size() - 1)});
}

std::size_t ScriptCompiler::entry(std::string_view name, bool read) {
  std::vector<ScriptEntry>& entries = program_.entries;
  auto known = std::find_if(entries.begin(), entries.end(), [&](const auto& other) { return other.name == name; });
  if (known == entries.end()) known = entries.insert(entries.end(), {.name = std::string(name)});
  known->read = known->read || (read && !known->set);
  return static_cast<std::size_t>(known - entries.begin());
}

bool ScriptCompiler::take(std::string_view sign) {
  if (!at(sign)) return false;
  ++position_;
  return true;
}

ScriptCompiler::Index ScriptCompiler::fail(const Token& token, std::string_view expected) {
  if (problem_.empty()) problem_ = "expected " + std::string(expected) + " " + place(text_, token);
  position_ = tokens_.size() - 1;
  return 0;
}

}  // namespace swiftlet::tree

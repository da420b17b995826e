// The scripts of BehaviorTree.CPP 4: assignments to entries, and expressions over them, as in
// `count += 1; ready := count > 3 && color != RED`.
//
//   statements   a; b; c                       the value of a script is that of its last statement
//   assignment   x := a   x = a   x += a  x -= a  x *= a  x /= a     := makes the entry, the others need it
//   choice       a ? b : c
//   logic        a || b   a && b   !a          the right side is evaluated only if it decides
//   comparison   a == b   a != b   a < b   a <= b   a > b   a >= b   also in chains: 0 < x <= 3
//   bits         a | b   a ^ b   a & b   ~a    of whole numbers
//   text         a .. b                        joins two texts
//   arithmetic   a + b   a - b   a * b   a / b   -a
//   operands     42  0x2A  3.14  'text'  true  false  NAME of a constant  name or @name of an entry  (a)
//
// From loose to tight, as in C. A script is compiled once, when the file is read; running it allocates nothing unless a
// text grows. There are no loops and no calls, so a script always ends.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "behaviors/tree/port.hpp"
#include "behaviors/tree/script/operand.hpp"

namespace swiftlet::tree {

/// Names with a number: the enumerators that an application gives to scripts.
using Constants = std::map<std::string, std::int64_t, std::less<>>;

/// An entry that a script uses.
struct ScriptEntry {
  std::string name;      ///< As written; with `@` for an entry of the main tree.
  bool read = false;     ///< Its value is needed before the script sets it.
  bool set = false;      ///< The script assigns to it.
  Slot* slot = nullptr;  ///< Bound before the first run.
};

/// An assignment, as far as it is known before the script runs.
struct ScriptWrite {
  std::size_t entry = 0;               ///< Index into Script::entries.
  bool makes = false;                  ///< By `:=`; the others change an entry that exists.
  std::optional<std::string> literal;  ///< The text of the constant that is assigned.
  std::optional<std::size_t> copied;   ///< The entry whose value is assigned unchanged.
  PortType type = PortType::kAny;      ///< Of what is assigned, if it is known.
};

struct ScriptResult;

class Script {
 public:
  static ScriptResult compile(std::string_view text, const Constants& constants);

  /// As it was compiled.
  const std::string& text() const { return text_; }
  const std::vector<ScriptEntry>& entries() const { return entries_; }
  const std::vector<ScriptWrite>& writes() const { return writes_; }
  bool assigns() const { return !writes_.empty(); }
  void bind(std::size_t entry, Slot* slot) { entries_[entry].slot = slot; }

  /// The value of the last statement, valid until the next run or a write to an entry. Nothing if it cannot be
  /// evaluated; then `problem` says why. Statements before the one that fails have been carried out.
  std::optional<Operand> run();
  /// The same as a condition; nothing also if the value is not true or false.
  std::optional<bool> holds();
  const std::string& problem() const { return problem_; }

 private:
  friend class ScriptCompiler;

  enum class Op : unsigned char {
    kConstant,
    kEntry,
    kNegate,
    kNot,
    kInvertBits,
    kAdd,
    kSubtract,
    kMultiply,
    kDivide,
    kJoin,
    kAndBits,
    kXorBits,
    kOrBits,
    kEqual,
    kUnequal,
    kLess,
    kLessEqual,
    kGreater,
    kGreaterEqual,
    kAnd,
    kOr,
    kChoice,
    kMake,
    kAssign,
  };
  /// A node of the expression; `a`, `b` and `c` are its operands, as indices of expressions.
  struct Expression {
    Op op = Op::kConstant;
    std::uint32_t a = 0, b = 0, c = 0;
    std::uint32_t of = 0;  ///< Of kConstant, kEntry, kMake, kAssign and kJoin: which one.
  };

  std::optional<Operand> evaluate(std::uint32_t index);
  std::optional<Operand> evaluateUnary(const Expression& expression, const Operand& a);
  std::optional<Operand> evaluateBinary(const Expression& expression, const Operand& a, const Operand& b);
  std::optional<Operand> arithmetic(Op op, const Operand& a, const Operand& b);
  std::optional<Operand> bits(Op op, const Operand& a, const Operand& b);
  std::optional<Operand> comparison(Op op, const Operand& a, const Operand& b);
  std::optional<Operand> join(std::uint32_t buffer, const Operand& a, const Operand& b);
  std::optional<Operand> assign(const Expression& expression);
  std::optional<bool> truth(std::uint32_t index);
  std::nullopt_t fail(std::string problem);

  std::string text_;
  std::vector<Expression> expressions_;
  std::vector<std::uint32_t> statements_;
  std::vector<Value> constants_;
  std::vector<std::string> joined_;  ///< Texts made by `..`, kept so that their memory is used again.
  std::vector<ScriptEntry> entries_;
  std::vector<ScriptWrite> writes_;
  std::string problem_;
};

struct ScriptResult {
  std::unique_ptr<Script> script;
  std::string problem;  ///< What is wrong with the text, if there is no script.
};

}  // namespace swiftlet::tree

// The scripts of BehaviorTree.CPP 4: assignments to entries, and expressions over them, as in
// `count += 1; ready := count > 3 && color != RED`.
//
//   statements   a; b; c                       the value of a script is that of its last statement
//   assignment   x := a   x = a   x += a  x -= a  x *= a  x /= a     := makes the entry, the others need it; has the
//                                              value that it assigns: x := y := 1
//   choice       a ? b : c                     a text that is no truth value is true
//   logic        a || b   a && b   !a          the right side is evaluated only if it decides
//   comparison   a == b   a != b   a < b   a <= b   a > b   a >= b   also in chains: 0 < x <= 3; two numbers are equal
//                                              within 1.2e-7
//   bits         a | b   a ^ b   a & b   ~a    of whole numbers; `|` and `^` on one level
//   text         a .. b   a + b                join two texts; `..`, `+` and `-` on one level
//   arithmetic   a + b   a - b   a * b   a / b   -a
//   operands     42  0x2A  3.14  'text'  true  false  NAME of a constant  name or @name of an entry  (a)
//
// From loose to tight, as in BehaviorTree.CPP. A script is compiled once, when the file is read; running it allocates
// nothing unless a text grows. There are no loops and no calls, so a script always ends.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "behaviors/tree/port.hpp"
#include "behaviors/tree/script/compiler.hpp"
#include "behaviors/tree/script/operand.hpp"
#include "behaviors/tree/script/program.hpp"

namespace swiftlet::tree {

class Scripts;

class Script {
 public:
  /// Made by Scripts, which own the code and the memory that it uses.
  Script(Scripts& owner, const ScriptProgram& program) : owner_(&owner), program_(program) {}

  /// As it was compiled.
  std::string_view text() const { return program_.text; }
  std::span<const ScriptEntry> entries() const;
  std::span<const ScriptWrite> writes() const;
  std::span<const ScriptPairing> pairings() const;
  /// Each entry is bound before the first run.
  void bind(std::size_t entry, Slot* slot);
  const Slot& slot(std::size_t entry) const;
  const Value& constant(std::size_t index) const;

  /// The value of the last statement, valid until the next run or a write to an entry. nullopt if it cannot be
  /// evaluated; then `problem` says why. Statements before the one that fails have been carried out.
  std::optional<Operand> run();
  /// Runs the script as a condition: the value of the last statement. nullopt if the script cannot be evaluated or the
  /// value is not true or false.
  std::optional<bool> holds();
  const std::string& problem() const { return problem_; }

 private:
  using Op = ScriptOp;
  using Expression = ScriptExpression;

  /// A comparison, and its right operand, which the next comparison of a chain needs.
  struct Link {
    bool holds = false;
    Operand right;
  };

  std::optional<Operand> evaluate(std::uint32_t index);
  std::optional<Operand> evaluateRight(const Expression& expression, Operand& a, std::optional<Value>& kept);
  std::optional<Link> evaluateLink(const Expression& expression);
  std::optional<Operand> evaluateUnary(const Expression& expression, const Operand& a);
  std::optional<Operand> evaluateBinary(const Expression& expression, const Operand& a, const Operand& b);
  std::optional<Operand> sum(const Expression& expression, const Operand& a, const Operand& b);
  std::optional<Operand> arithmetic(Op op, const Operand& a, const Operand& b);
  std::optional<Operand> bits(Op op, const Operand& a, const Operand& b);
  std::optional<bool> comparison(Op op, const Operand& a, const Operand& b);
  Operand constantBeside(const Operand& operand, const Operand& other) const;
  std::optional<Operand> join(std::uint32_t buffer, const Operand& a, const Operand& b);
  std::optional<Operand> assign(const Expression& expression);
  std::optional<bool> truth(std::uint32_t index);
  std::optional<bool> chosen(std::uint32_t index);
  std::nullopt_t fail(std::string problem);
  std::nullopt_t failUnset(std::uint32_t entry, std::string_view remedy);

  Scripts* owner_;
  ScriptProgram program_;
  std::string problem_;
};

/// The scripts of a tree. Does not move, because each of them refers to it.
class Scripts {
 public:
  /// The constants must outlive this object.
  explicit Scripts(const Constants& constants) : constants_(constants), compiler_(constants) {}
  Scripts(const Scripts&) = delete;
  Scripts& operator=(const Scripts&) = delete;

  struct Added {
    Script* script = nullptr;        ///< Lives as long as this object.
    std::optional<Message> problem;  ///< What is wrong with the text, if there is no script.
  };
  /// The text must outlive this object.
  Added add(std::string_view text);

 private:
  friend class Script;
  const Constants& constants_;
  ScriptCompiler compiler_;
  ScriptCode code_;
  std::vector<Slot*> slots_;         ///< Of the entries of the code.
  std::vector<std::string> joined_;  ///< Texts made by `..` and `+`, kept so that their memory is used again.
  std::deque<Script> scripts_;       ///< Stable addresses.
};

}  // namespace swiftlet::tree

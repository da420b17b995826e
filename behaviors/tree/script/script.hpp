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
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "behaviors/tree/port.hpp"
#include "behaviors/tree/script/operand.hpp"
#include "behaviors/tree/script/program.hpp"

namespace swiftlet::tree {

struct ScriptResult;

class Script {
 public:
  explicit Script(std::shared_ptr<const ScriptProgram> program);
  static ScriptResult compile(std::string_view text, const Constants& constants);

  /// As it was compiled.
  const std::string& text() const { return program_->text; }
  const std::vector<ScriptEntry>& entries() const { return program_->entries; }
  const std::vector<ScriptWrite>& writes() const { return program_->writes; }
  bool assigns() const { return !program_->writes.empty(); }
  /// Each entry is bound before the first run.
  void bind(std::size_t entry, Slot* slot) { slots_[entry] = slot; }
  const Slot& slot(std::size_t entry) const { return *slots_[entry]; }

  /// The value of the last statement, valid until the next run or a write to an entry. Nothing if it cannot be
  /// evaluated; then `problem` says why. Statements before the one that fails have been carried out.
  std::optional<Operand> run();
  /// The same as a condition; nothing also if the value is not true or false.
  std::optional<bool> holds();
  const std::string& problem() const { return problem_; }

 private:
  using Op = ScriptProgram::Op;
  using Expression = ScriptProgram::Expression;

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

  std::shared_ptr<const ScriptProgram> program_;
  std::vector<Slot*> slots_;         ///< Of the entries.
  std::vector<std::string> joined_;  ///< Texts made by `..`, kept so that their memory is used again.
  std::string problem_;
};

struct ScriptResult {
  std::unique_ptr<Script> script;
  std::string problem;  ///< What is wrong with the text, if there is no script.
};

}  // namespace swiftlet::tree

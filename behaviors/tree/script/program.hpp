// What a script does, as it was compiled. It is never changed, so that scripts of the same text share it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "behaviors/tree/port.hpp"
#include "behaviors/tree/value.hpp"

namespace swiftlet::tree {

/// Names with a number: the enumerators that an application gives to scripts.
using Constants = std::map<std::string, std::int64_t, std::less<>>;

/// An entry that a script uses.
struct ScriptEntry {
  std::string name;   ///< As written; with `@` for an entry of the main tree.
  bool read = false;  ///< Its value is needed before the script sets it.
  bool set = false;   ///< The script assigns to it.
};

/// An assignment, as far as it is known before the script runs.
struct ScriptWrite {
  std::size_t entry = 0;               ///< Index of the entry.
  bool makes = false;                  ///< By `:=`; the others change an entry that exists.
  std::optional<std::string> literal;  ///< The text of the constant that is assigned.
  std::optional<std::size_t> copied;   ///< The entry whose value is assigned unchanged.
  PortType type = PortType::kAny;      ///< Of what is assigned, if it is known.
};

struct ProgramResult;

/// Safe from any thread.
struct ScriptProgram {
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

  static ProgramResult compile(std::string_view text, const Constants& constants);

  std::string text;
  std::vector<Expression> expressions;
  std::vector<std::uint32_t> statements;
  std::vector<Value> constants;
  std::size_t joins = 0;  ///< Texts that `..` makes.
  std::vector<ScriptEntry> entries;
  std::vector<ScriptWrite> writes;
};

struct ProgramResult {
  std::shared_ptr<const ScriptProgram> program;
  std::string problem;  ///< What is wrong with the text, if there is no program.
};

}  // namespace swiftlet::tree

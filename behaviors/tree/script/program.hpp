// What scripts do, as they were compiled.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "behaviors/tree/port.hpp"
#include "behaviors/tree/value.hpp"

namespace swiftlet::tree {

/// An entry that a script uses.
struct ScriptEntry {
  std::string_view name;  ///< As written; with `@` for an entry of the main tree.
  bool read = false;      ///< Its value is needed before the script sets it.
  bool set = false;       ///< The script assigns to it.
};

/// An assignment, as far as it is known before the script runs.
struct ScriptWrite {
  std::size_t entry = 0;                ///< Index of the script's entry.
  bool makes = false;                   ///< By `:=`; the others change an entry that exists.
  std::optional<std::size_t> constant;  ///< The constant of the code that is assigned.
  std::optional<std::size_t> copied;    ///< The script's entry whose value is assigned unchanged.
  PortType type = PortType::kAny;       ///< Of what is assigned, if it is known.
};

enum class ScriptOp : unsigned char {
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

/// A node of an expression; `a`, `b` and `c` are its operands, as indices of expressions.
struct ScriptExpression {
  ScriptOp op = ScriptOp::kConstant;
  bool linked = false;  ///< A comparison whose left operand is the right one of `a`, which must hold: a < b < c.
  bool keeps = false;   ///< `b` assigns, so that the value of `a` is copied before.
  std::uint32_t a = 0, b = 0, c = 0;
  std::uint32_t of = 0;  ///< Of kConstant, kEntry, kMake, kAssign, kAdd and kJoin: which one.
};

/// An operand that is the entry of a script, by its index there, or a constant of the code.
struct ScriptSide {
  bool is_entry = false;
  std::size_t index = 0;
};

/// A comparison or a sum of two such operands: texts are compared and joined as texts, whatever they look like.
struct ScriptPairing {
  ScriptOp op = ScriptOp::kAdd;
  ScriptSide left, right;
};

/// The code of all scripts in a row: a few long lists are made and freed faster than lists for each of thousands
/// of scripts. All indices are those of these lists, unless it says otherwise.
struct ScriptCode {
  std::vector<ScriptExpression> expressions;
  std::vector<std::uint32_t> statements;
  std::vector<Value> constants;
  std::vector<ScriptEntry> entries;
  std::vector<ScriptWrite> writes;
  std::vector<ScriptPairing> pairings;
  std::size_t joins = 0;  ///< Texts that `..` and `+` may make.
};

/// Elements of a list of the code.
struct ScriptRange {
  std::size_t begin = 0, end = 0;

  template <typename T>
  std::span<const T> of(const std::vector<T>& list) const {
    return std::span(list).subspan(begin, end - begin);
  }
};

/// Where the code of one script is.
struct ScriptProgram {
  std::string_view text;
  ScriptRange statements, entries, writes, pairings;
};

}  // namespace swiftlet::tree

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/core.h>

#include "behaviors/tree/builder.hpp"

namespace swiftlet::tree {
namespace {

/// A text that looks like a number, as one side of a comparison or a sum may hold it.
struct NumberText {
  std::string text;
  double number = 0.0;
};

/// 0x10 is a number for scripts, and for no port.
std::optional<double> hexNumber(const std::string& text) {
  if (!text.starts_with("0x") && !text.starts_with("0X")) return std::nullopt;
  std::uint64_t number = 0;
  const char* const end = text.data() + text.size();
  const auto [read, error] = std::from_chars(text.data() + 2, end, number, 16);
  return error == std::errc() && read == end ? std::optional(static_cast<double>(number)) : std::nullopt;
}

std::optional<NumberText> numberText(const std::string& text) {
  if (const auto hex = hexNumber(text)) return NumberText{text, *hex};
  const auto number = parseValue(text, PortType::kDouble, {});
  return number ? std::optional(NumberText{text, std::get<double>(*number)}) : std::nullopt;
}

const char* signOf(ScriptOp op) {
  switch (op) {
    case ScriptOp::kEqual:
      return "==";
    case ScriptOp::kUnequal:
      return "!=";
    case ScriptOp::kLess:
      return "<";
    case ScriptOp::kLessEqual:
      return "<=";
    case ScriptOp::kGreater:
      return ">";
    case ScriptOp::kGreaterEqual:
      return ">=";
    default:
      return "+";
  }
}

class NumberTexts {
 public:
  NumberTexts(const TreeParts& tree, const PairedOperands& paired) : tree_(tree), paired_(paired) {}

  std::optional<Problem> warning() const {
    const ScriptPairing& pairing = paired_.pairing;
    const std::vector<NumberText> left = textsOf(pairing.left), right = textsOf(pairing.right);
    const bool equality = pairing.op == ScriptOp::kEqual || pairing.op == ScriptOp::kUnequal;
    for (const NumberText& a : left)
      for (const NumberText& b : right)
        if (!equality || (a.text != b.text && a.number == b.number)) return warningOf(a, b);
    return std::nullopt;
  }

 private:
  Problem warningOf(const NumberText& a, const NumberText& b) const {
    const ScriptPairing& pairing = paired_.pairing;
    const std::string shown = fmt::format("{} {} {}", nameOf(pairing.left), signOf(pairing.op), nameOf(pairing.right));
    const Message what =
        pairing.op == ScriptOp::kAdd
            ? Message("tree.texts-joined", "`{0}` joins texts, `{1}` and `{2}` give `{1}{2}`", shown, a.text, b.text)
            : Message("tree.texts-compared", "`{}` compares `{}` and `{}` as texts, not as numbers", shown, a.text,
                      b.text);
    const ScriptSide& entry = pairing.left.is_entry ? pairing.left : pairing.right;
    const std::string& number = pairing.left.is_entry ? a.text : b.text;
    const std::string hint = entry.is_entry
                                 ? fmt::format("<Script code=\"{} := {}\"/> makes it a number", nameOf(entry), number)
                                 : "write them without quotes";
    const EntryRead& read = paired_.read;
    return {tree_.locate(read.origin, read.port->name), read.owner + "." + read.port->name, what, hint,
            tree_.pathOf(read.origin.node)};
  }

  std::string nameOf(const ScriptSide& side) const {
    return side.is_entry ? std::string(paired_.script->entries()[side.index].name)
                         : "'" + toString(paired_.script->constant(side.index)) + "'";
  }

  std::vector<NumberText> textsOf(const ScriptSide& side) const {
    std::vector<NumberText> texts;
    const auto add = [&](const std::string& text) {
      constexpr std::size_t kMost = 20;
      if (auto number = numberText(text); number && texts.size() < kMost) texts.push_back(std::move(*number));
    };
    if (!side.is_entry) {
      const auto* text = std::get_if<std::string>(&paired_.script->constant(side.index));
      if (text != nullptr) add(*text);
      return texts;
    }
    for (const std::size_t source : tree_.sourcesOf(paired_.script->slot(side.index).id))
      for (const LiteralWrite& literal : tree_.flows[source].literals)
        if (literal.is_text) add(literal.text);
    return texts;
  }

  const TreeParts& tree_;
  const PairedOperands& paired_;
};

}  // namespace

void warnOfNumberTexts(const TreeParts& tree, Problems& problems) {
  for (const PairedOperands& paired : tree.pairings) {
    if (problems.fullOfWarnings()) return;
    if (auto warning = NumberTexts(tree, paired).warning()) problems.warn(std::move(*warning));
  }
}

}  // namespace swiftlet::tree

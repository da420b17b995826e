#include "behaviors/tree/version3.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include <fmt/core.h>

#include "behaviors/tree/conditions.hpp"
#include "behaviors/tree/elements.hpp"
#include "behaviors/tree/script/lexer.hpp"
#include "behaviors/tree/xml_text.hpp"

namespace swiftlet::tree {
namespace {

using Names = std::pair<std::string_view, std::string_view>;

/// Types that version 4 names differently.
constexpr std::array<Names, 4> kRenamedTypes = {{{"SequenceStar", "SequenceWithMemory"},
                                                 {"FallbackStar", "Fallback"},
                                                 {"RetryUntilSuccesful", "RetryUntilSuccessful"},
                                                 {"SubTreePlus", "SubTree"}}};

/// Ports of Parallel.
constexpr std::array<Names, 3> kRenamedCounts = {
    {{"threshold", "success_count"}, {"success_threshold", "success_count"}, {"failure_threshold", "failure_count"}}};

constexpr std::array<std::string_view, 22> kTypesOfVersion4 = {"AsyncFallback",
                                                               "AsyncSequence",
                                                               "LoopBool",
                                                               "LoopDouble",
                                                               "LoopInt",
                                                               "LoopString",
                                                               "ParallelAll",
                                                               "Precondition",
                                                               "Priority",
                                                               "RunOnce",
                                                               "Script",
                                                               "ScriptCondition",
                                                               "Sleep",
                                                               "TestNode",
                                                               "TryCatch",
                                                               "SequenceWithMemory",
                                                               "SkipUnlessUpdated",
                                                               "UnsetBlackboard",
                                                               "WasEntryUpdated",
                                                               "WaitValueUpdate",
                                                               "ConsumeQueue",
                                                               "EntryUpdated"};

template <std::size_t N>
std::optional<std::string_view> lookUp(const std::array<Names, N>& names, std::string_view name) {
  const auto found = std::find_if(names.begin(), names.end(), [&](const Names& known) { return known.first == name; });
  return found == names.end() ? std::nullopt : std::optional(found->second);
}

class Version3Reader {
 public:
  explicit Version3Reader(const Document& document) : document_(document), source_(document.source) {}

  std::vector<Version3Use> read() {
    for (const XmlElement& element : document_.root.children)
      if (element.name == "BehaviorTree")
        for (const XmlElement& child : element.children) readElement(child);
    return std::move(uses_);
  }

 private:
  /// Depth is bounded by that of the XML.
  void readElement(const XmlElement& element) {
    const std::string& type = typeNameOf(element);
    if (type == "SubTree" || type == "SubTreePlus") readSubTree(element, type == "SubTreePlus");
    if (type.starts_with("BlackboardCheck")) readBlackboardCheck(element, type);
    if (const auto name = lookUp(kRenamedTypes, type)) renameType(element, type, *name);
    for (const XmlAttribute& attribute : element.attributes)
      if (const auto name = lookUp(kRenamedCounts, attribute.name); name && type == "Parallel")
        renameAttribute(element, *source_.spanOf(element.offset, attribute.name), attribute.name, *name);
    for (const XmlElement& child : element.children) readElement(child);
  }

  Version3Use& add(const XmlElement& element, std::size_t offset, const std::string& what, const std::string& now) {
    return uses_.emplace_back(
        Version3Use{&element,
                    offset,
                    Message("tree.version-3", "{} is of version 3, version 4 writes {}", what, now),
                    false,
                    {},
                    true});
  }

  void renameType(const XmlElement& element, const std::string& type, std::string_view name) {
    add(element, element.offset, fmt::format("`{}`", type), fmt::format("`{}`", name)).edits =
        typeEdits(element, type, name);
  }

  /// In both tags, or the attribute ID of the explicit form.
  std::vector<Edit> typeEdits(const XmlElement& element, std::string_view type, std::string_view name) const {
    if (explicitKind(element.name)) {
      const AttributeSpan span = *source_.spanOf(element.offset, "ID");
      return {{span.opening_quote + 1, span.closing_quote, std::string(name)}};
    }
    std::vector<Edit> edits = {{element.offset + 1, element.offset + 1 + type.size(), std::string(name)}};
    if (element.close_offset)
      edits.push_back({*element.close_offset + 2, *element.close_offset + 2 + type.size(), std::string(name)});
    return edits;
  }

  void renameAttribute(const XmlElement& element, const AttributeSpan& span, const std::string& from,
                       std::string_view to) {
    add(element, span.name, fmt::format("`{}`", from), fmt::format("`{}`", to)).edits = {
        {span.name, span.name_end, std::string(to)}};
  }

  void readSubTree(const XmlElement& element, bool plus) {
    const std::vector<AttributeSpan> spans = source_.spansOf(element.offset);
    for (std::size_t i = 0; i < spans.size(); ++i) {
      const XmlAttribute& attribute = element.attributes[i];
      const std::string& name = attribute.name;
      if (name == "__shared_blackboard" || name == "__autoremap")
        renameAttribute(element, spans[i], name, "_autoremap");
      else if (name != "ID" && name != "name" && !name.starts_with('_') && !plus && !entryOf(attribute.value, name))
        bindEntry(element, attribute, spans[i]);
    }
    for (const XmlElement& child : element.children)
      if (child.name == "remap") readRemap(element, child);
  }

  /// A SubTree of version 3 maps names of entries.
  void bindEntry(const XmlElement& element, const XmlAttribute& attribute, const AttributeSpan& span) {
    const std::string text = escaped(attribute.value);
    uses_.push_back({&element,
                     span.name,
                     Message("tree.version-3-entry",
                             "version 3 means the entry {{{0}}}, version 4 the text `{0}`, and writes {{{0}}} for the "
                             "entry",
                             attribute.value),
                     true,
                     {{span.opening_quote + 1, span.closing_quote, "{" + text + "}"}},
                     true});
  }

  /// <SubTree ID="X"><remap internal="a" external="b"/></SubTree>.
  void readRemap(const XmlElement& subtree, const XmlElement& remap) {
    const std::string *inner = remap.attribute("internal"), *outer = remap.attribute("external");
    if (inner == nullptr || outer == nullptr) return;
    const std::string attribute = fmt::format("{}=\"{{{}}}\"", *inner, escaped(*outer));
    const std::size_t name_end = subtree.offset + 1 + subtree.name.size();
    add(remap, remap.offset, "<remap>", fmt::format("`{}` into the <SubTree>", attribute)).edits = {
        {name_end, name_end, " " + attribute}, {withBlanksBefore(remap.offset), endOf(remap), {}}};
  }

  /// BlackboardCheckInt value_A value_B return_on_mismatch, and its kin.
  void readBlackboardCheck(const XmlElement& element, const std::string& type) {
    const std::string *a = element.attribute("value_A"), *b = element.attribute("value_B");
    if (a == nullptr || b == nullptr) return;
    const bool text = type == "BlackboardCheckString";
    const std::string script = operand(*a, text) + " == " + operand(*b, text);
    const bool writable = isOperand(*a, text) && isOperand(*b, text);
    Version3Use& use = add(element, element.offset, fmt::format("`{}`", type),
                           fmt::format("`Precondition if=\"{}\"`, which asks only before its child starts", script));
    use.rewritable = writable;
    use.edits = typeEdits(element, type, "Precondition");
    const AttributeSpan first = *source_.spanOf(element.offset, "value_A");
    use.edits.push_back({first.name, first.closing_quote + 1, "if=\"" + escaped(script) + "\""});
    use.edits.push_back(removal(element, "value_B"));
    const std::string* answer = element.attribute("return_on_mismatch");
    if (answer == nullptr) return;
    if (answer->empty()) {
      use.edits.push_back(removal(element, "return_on_mismatch"));
      return;
    }
    const AttributeSpan span = *source_.spanOf(element.offset, "return_on_mismatch");
    use.edits.push_back({span.name, span.name_end, "else"});
  }

  /// In a script an entry is its name, and a text is quoted.
  static std::string operand(const std::string& value, bool text) {
    if (const auto entry = entryOf(value, {})) return *entry;
    if (!text) return value;
    std::string quoted = "'";
    for (const char c : value) quoted += c == '\'' ? std::string("' .. \"'\" .. '") : std::string(1, c);
    return quoted + "'";
  }
  /// False for an entry whose name is several words in a script, and for text where numbers are compared.
  static bool isOperand(const std::string& value, bool text) {
    if (const auto entry = entryOf(value, {})) return isScriptName(*entry);
    return text || parseValue(value, PortType::kDouble, {}) || parseValue(value, PortType::kBool, {});
  }

  Edit removal(const XmlElement& element, std::string_view attribute) const {
    const AttributeSpan span = *source_.spanOf(element.offset, attribute);
    return {withBlanksBefore(span.name), span.closing_quote + 1, {}};
  }
  std::size_t withBlanksBefore(std::size_t offset) const {
    const std::size_t last = source_.text().find_last_not_of(" \t\r\n", offset == 0 ? 0 : offset - 1);
    return last == std::string::npos ? offset : last + 1;
  }
  std::size_t endOf(const XmlElement& element) const {
    return source_.endOfTag(element.close_offset.value_or(element.offset));
  }

  const Document& document_;
  const SourceText& source_;
  std::vector<Version3Use> uses_;
};

bool isOfVersion4(const XmlElement& element) {
  const std::string& type = typeNameOf(element);
  if (std::find(kTypesOfVersion4.begin(), kTypesOfVersion4.end(), type) != kTypesOfVersion4.end()) return true;
  const auto attributeIs4 = [&](const XmlAttribute& attribute) {
    if (conditionOf(attribute.name) || attribute.name == "_autoremap") return true;
    return isSubTree(element) && !isStructural(element, attribute.name) && entryOf(attribute.value, attribute.name);
  };
  return std::any_of(element.attributes.begin(), element.attributes.end(), attributeIs4) ||
         std::any_of(element.children.begin(), element.children.end(), isOfVersion4);
}

}  // namespace

std::vector<Version3Use> version3Uses(const Document& document) { return Version3Reader(document).read(); }

bool usesVersion4(const Document& document) {
  const auto& children = document.root.children;
  return std::any_of(children.begin(), children.end(),
                     [](const XmlElement& tree) { return tree.name == "BehaviorTree" && isOfVersion4(tree); });
}

std::string edited(std::string_view text, std::vector<Edit> edits) {
  std::stable_sort(edits.begin(), edits.end(), [](const Edit& a, const Edit& b) { return a.begin < b.begin; });
  std::string result;
  std::size_t at = 0;
  for (const Edit& edit : edits) {
    result += text.substr(at, edit.begin - at);
    result += edit.text;
    at = edit.end;
  }
  return result + std::string(text.substr(at));
}

}  // namespace swiftlet::tree

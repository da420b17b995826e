#include "behaviors/tree/migrate.hpp"

#include <optional>
#include <utility>

#include "behaviors/tree/document_problems.hpp"
#include "behaviors/tree/documents.hpp"
#include "behaviors/tree/parse_options.hpp"
#include "behaviors/tree/version3.hpp"

namespace swiftlet::tree {
namespace {

Edit formatEdit(const Document& document) {
  const XmlElement& root = document.root;
  if (const auto span = document.source.spanOf(root.offset, "BTCPP_format"))
    return {span->opening_quote + 1, span->closing_quote, "4"};
  const std::size_t name_end = root.offset + 1 + root.name.size();
  return {name_end, name_end, " BTCPP_format=\"4\""};
}

std::optional<Problem> migrationRefusal(const Document& document) {
  const XmlElement& root = document.root;
  if (root.name != "root") return notRoot(document, "");
  const std::string* format = root.attribute("BTCPP_format");
  if (format == nullptr || *format == "3" || *format == "4") return std::nullopt;
  return otherFormat(document, "3");
}

/// Names that version 3 allowed cannot all become attributes: two may be equal, or hold a character that XML does not
/// allow.
std::optional<Problem> whatIsBroken(const Document& document, const std::string& text) {
  const XmlResult xml = parseXml(SourceText(document.source.file(), text), ParseLimits{}.depth);
  if (xml.root) return std::nullopt;
  return Problem{
      document.at(document.root), "root",
      Message("tree.rewritten-malformed", "the rewritten file would not be XML ({})", xml.problem->message.text()),
      "give its SubTrees and their remaps other names first"};
}

}  // namespace

Migration migrateToVersion4(std::string text, const std::string& name) {
  constexpr ParseLimits kLimits;
  if (text.size() > kLimits.file_bytes) return {{}, {}, {{{name}, {}, fileTooLarge(name, kLimits.file_bytes)}}};
  SourceText source(name, std::move(text));
  XmlResult xml = parseXml(source, kLimits.depth);
  if (!xml.root) return {{}, {}, {std::move(*xml.problem)}};
  const Document document{std::move(source), std::move(*xml.root)};
  if (auto problem = migrationRefusal(document)) return {{}, {}, {std::move(*problem)}};

  Migration migration;
  Problems problems(kLimits.problems);
  const std::string* format = document.root.attribute("BTCPP_format");
  if (format != nullptr && *format == "4") {
    migration.text = document.source.text();
    return migration;
  }
  std::vector<Edit> edits = {formatEdit(document)};
  migration.changes.push_back(
      {document.at(document.root), "root", Message("tree.format-written", "BTCPP_format=\"4\" says the version")});
  for (Version3Use& use : version3Uses(document)) {
    Problem change{document.source.locate(use.offset), use.element->name, use.message};
    if (!use.rewritable) {
      change.hint = "but a script cannot hold one of its values: name the entry with letters, digits and `_`";
      problems.add(change);
    }
    migration.changes.push_back(std::move(change));
    edits.insert(edits.end(), use.edits.begin(), use.edits.end());
  }
  if (!problems.empty()) return {{}, {}, problems.take()};
  migration.text = edited(document.source.text(), std::move(edits));
  if (auto problem = whatIsBroken(document, migration.text)) return {{}, {}, {std::move(*problem)}};
  return migration;
}

}  // namespace swiftlet::tree

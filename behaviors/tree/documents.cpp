#include "behaviors/tree/documents.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <utility>

#include <fmt/core.h>

#include "behaviors/tree/characters.hpp"
#include "behaviors/tree/document_problems.hpp"
#include "behaviors/tree/version3.hpp"

namespace swiftlet::tree {
namespace {

namespace fs = std::filesystem;

/// Reads at most one byte more than the limit, so that a huge file is detected and not loaded.
std::optional<std::string> readFromDisk(const std::string& path, std::size_t limit) {
  std::error_code error;
  if (!fs::is_regular_file(path, error)) return std::nullopt;
  std::ifstream file(path, std::ios::binary);
  if (!file) return std::nullopt;
  const auto size = static_cast<std::size_t>(fs::file_size(path, error));
  std::string text(std::min(error ? limit + 1 : size, limit + 1), '\0');
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(file.gcount()));
  return text;
}

Problem packed(const Location& file, std::string_view by) {
  return {file,
          {},
          Message("tree.file-packed", "is packed by {}, a text was expected", by),
          fmt::format("unpack it by `{}`", by == "zip" ? "unzip" : "gunzip")};
}

/// What a clone has until Git LFS or git-annex fetches the file.
Problem pointer(const Location& file, std::string_view of, std::string_view remedy) {
  return {file,
          {},
          Message("tree.file-pointer", "this is a pointer of {}, not the file", of),
          fmt::format("run {} in its repository", remedy)};
}

/// What stands in place of a text, if anything does.
std::optional<Problem> placeholderIn(std::string_view text, const Location& file) {
  if (text.starts_with("\x1f\x8b")) return packed(file, "gzip");
  if (text.starts_with("PK\x03\x04")) return packed(file, "zip");
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  if (text.starts_with("version https://git-lfs.github.com/spec/") ||
      text.starts_with("version https://hawser.github.com/spec/"))
    return pointer(file, "Git LFS", "`git lfs pull`");
  std::string_view target = text.substr(0, text.find('\n'));
  while (target.starts_with("../")) target.remove_prefix(3);
  if (target.starts_with("/annex/objects/") ||
      (target.starts_with(".git/") && target.find("/annex/objects/") != std::string_view::npos))
    return pointer(file, "git-annex", "`git annex get` for it");
  return std::nullopt;
}

std::string normalized(const fs::path& path) { return path.lexically_normal().generic_string(); }

/// Whether these dashes within a comment look like the beginning of another.
bool beginsComment(const SourceText& source, std::size_t dashes) {
  return dashes >= 2 && source.text().compare(dashes - 2, 2, "<!") == 0;
}

/// "; also in line 5, 9 and 3 more": the other lines with such a place; empty without any.
std::string otherLines(const SourceText& source, const std::vector<std::size_t>& offsets) {
  constexpr std::size_t kMost = 10;
  std::vector<int> lines;
  for (const std::size_t offset : offsets)
    if (const int line = source.locate(offset).line; lines.empty() || lines.back() != line) lines.push_back(line);
  std::string text;
  for (std::size_t i = 1; i < std::min(lines.size(), kMost + 1); ++i)
    text += (i == 1 ? "; also in line " : i + 1 == lines.size() ? " and " : ", ") + std::to_string(lines[i]);
  return lines.size() <= kMost + 1 ? text : fmt::format("{} and {} more", text, lines.size() - 1 - kMost);
}

bool isForEditors(std::string_view attribute) {
  return attribute.starts_with("xmlns") || attribute.starts_with("xsi:") || attribute == "project_name";
}

constexpr std::array<std::string_view, 5> kModelKinds = {"Action", "Condition", "Control", "Decorator", "SubTree"};

/// What the message quotes may hold a character that cannot be seen, or that looks right.
void nameCharacters(Problem& problem) {
  if (problem.message.text().find("U+") != std::string::npos) return;
  std::string name = misleadingCharacterIn(problem.message.text());
  if (name.empty()) name = misleadingCharacterIn(problem.element);
  if (!name.empty()) problem.message.append("; it holds " + name);
}

bool isPortTag(std::string_view name) { return name == "input_port" || name == "output_port" || name == "inout_port"; }

}  // namespace

void Problems::add(Problem problem) {
  if (full()) return;
  nameCharacters(problem);
  if (list_.size() == limit_) problem = {{}, {}, Message("tree.more-problems", "there are more problems")};
  list_.push_back(std::move(problem));
}

void Problems::warn(Problem warning) {
  if (fullOfWarnings()) return;
  nameCharacters(warning);
  warnings_.push_back(std::move(warning));
}

Documents::Documents(const ParseOptions& options, Problems& problems)
    : options_(options), problems_(problems), read_file_(options.read_file) {
  if (!read_file_)
    read_file_ = [limit = options.limits.file_bytes](const std::string& path) { return readFromDisk(path, limit); };
}

bool Documents::isRead(const std::string& file) const { return seen_.contains(normalized(file)); }

void Documents::load(const std::string& path) {
  auto text = read_file_(path);
  if (!text) {
    problems_.add({{path}, {}, Message("tree.file-unreadable", "cannot be read")});
    return;
  }
  load(std::move(*text), path);
}

void Documents::load(std::string text, const std::string& name) {
  // Includes are finished first, so the main file is the last.
  if (!add(std::move(text), name, nullptr, nullptr)) return;
  const Document& main_file = *documents.back();
  if (options_.lenient) readElsewhere(main_file);
  findMain(main_file);
}

bool Documents::refuse(Problem problem) {
  problems_.add(std::move(problem));
  return false;
}

bool Documents::add(std::string text, const std::string& path, const Document* from, const XmlElement* element) {
  const Location place = from == nullptr ? Location{path, 0, 0} : from->at(*element);
  const std::string tag = from == nullptr ? std::string() : "include";
  if (auto problem = placeholderIn(text, {path})) return refuse(*std::move(problem));
  if (text.size() > options_.limits.file_bytes)
    return refuse({place, tag, fileTooLarge(path, options_.limits.file_bytes)});
  if (static_cast<int>(seen_.size()) >= options_.limits.files)
    return refuse({place, tag, Message("tree.files-many", "more than {} files", options_.limits.files)});
  seen_.insert(normalized(path));
  SourceText source(path, std::move(text));
  XmlResult xml = parseXml(source, options_.limits.depth, options_.lenient);
  warnUnescaped(source, xml.unescaped);
  if (!xml.root) return refuse(*std::move(xml.problem));
  auto document = std::make_unique<Document>(Document{std::move(source), std::move(*xml.root), is_elsewhere_});
  const Document& kept = *document;
  const bool usable = checkRoot(kept);
  if (usable) {
    open_.push_back(normalized(path));
    readChildren(kept, path);
    open_.pop_back();
  }
  documents.push_back(std::move(document));
  return usable;
}

/// A file may have dashes in each of its comments: one warning names all lines.
void Documents::warnUnescaped(const SourceText& source, const std::vector<std::size_t>& offsets) {
  std::vector<std::size_t> dashes, nested, values;
  for (const std::size_t offset : offsets)
    (source.text()[offset] != '-' ? values : beginsComment(source, offset) ? nested : dashes).push_back(offset);
  if (!dashes.empty())
    problems_.warn({source.locate(dashes.front()),
                    {},
                    Message("tree.comment-dashes", "`--` stands in a comment, which XML does not allow{}",
                            otherLines(source, dashes)),
                    "write <!-- == text == -->"});
  if (!nested.empty())
    problems_.warn({source.locate(nested.front()),
                    {},
                    Message("tree.comment-nested", "`<!--` stands in a comment, which ends at its first -->{}",
                            otherLines(source, nested)),
                    "take the inner <!-- and --> out"});
  for (const std::size_t offset : values) {
    if (problems_.fullOfWarnings()) return;
    const char c = source.text()[offset];
    problems_.warn({source.locate(offset),
                    {},
                    Message("tree.value-unescaped", "`{}` stands for itself in a value, which XML does not allow", c),
                    c == '&' ? "write &amp;" : "write &lt;"});
  }
}

bool Documents::checkRoot(const Document& document) {
  const XmlElement& root = document.root;
  if (root.name != "root") return refuse(notRoot(document, " BTCPP_format=\"4\""));
  if (!checkFormat(document)) return false;
  const std::vector<std::string> known = {"BTCPP_format", "main_tree_to_execute"};
  for (const XmlAttribute& attribute : root.attributes) {
    if (options_.lenient ? problems_.fullOfWarnings() : problems_.full()) break;
    if (!isForEditors(attribute.name) && std::find(known.begin(), known.end(), attribute.name) == known.end())
      reportForeign(unknownAttribute(document, root, attribute.name, didYouMean(attribute.name, known)));
  }
  if (root.text_offset) problems_.add(strayText(document, root));
  return true;
}

bool Documents::checkFormat(const Document& document) {
  const XmlElement& root = document.root;
  const std::string* format = root.attribute("BTCPP_format");
  if (format != nullptr && *format == "4") return true;
  if (format != nullptr && *format != "3") return refuse(otherFormat(document, "4"));
  const std::vector<Version3Use> uses = version3Uses(document);
  const auto readable = [](const Version3Use& use) { return use.readable; };
  const bool of_version3 = !std::all_of(uses.begin(), uses.end(), readable) ||
                           (!uses.empty() && !usesVersion4(document)) || format != nullptr;
  if (of_version3) {
    const std::string hint = fmt::format("`swiftlet migrate {}` rewrites it", document.source.file());
    problems_.add(format != nullptr ? otherFormat(document, "4", hint)
                                    : Problem{document.at(root), "root",
                                              Message("tree.format-missing",
                                                      "BTCPP_format is missing, and the file is not one of version 4"),
                                              hint});
    for (const Version3Use& use : uses)
      if (!problems_.full()) problems_.add({document.source.locate(use.offset), use.element->name, use.message});
    return false;
  }
  problems_.warn({document.at(root), "root",
                  Message("tree.format-assumed", "BTCPP_format is missing; the file is read as version 4, {}",
                          usesVersion4(document) ? "which its nodes are of" : "in which it means the same as in 3"),
                  "write <root BTCPP_format=\"4\">"});
  return true;
}

void Documents::readChildren(const Document& document, const std::string& path) {
  const std::vector<std::string> known = {"BehaviorTree", "TreeNodesModel", "include"};
  const bool alone = std::count_if(document.root.children.begin(), document.root.children.end(),
                                   [](const XmlElement& e) { return e.name == "BehaviorTree"; }) == 1;
  for (const XmlElement& element : document.root.children) {
    if (problems_.full()) return;
    if (element.name == "include")
      lost_a_tree_ = !include(document, element, path) || lost_a_tree_;
    else if (element.name == "BehaviorTree")
      lost_a_tree_ = !addTree(document, element, alone) || lost_a_tree_;
    else if (element.name == "TreeNodesModel")
      readModel(document, element);
    else
      reportForeign(
          {document.at(element), element.name,
           Message("tree.unknown-element", "unknown element, expected <BehaviorTree>, <include> or <TreeNodesModel>"),
           didYouMean(element.name, known)});
  }
}

void Documents::reportForeign(Problem problem) {
  if (options_.lenient)
    problems_.warn(std::move(problem));
  else
    problems_.add(std::move(problem));
}

bool Documents::include(const Document& document, const XmlElement& element, const std::string& path) {
  const std::string* wanted = element.attribute("path");
  if (element.attribute("ros_pkg") != nullptr)
    return refuse({document.at(element, "ros_pkg"), "include", Message("tree.ros-package", "ros_pkg is not supported"),
                   "give a path relative to this file"});
  if (wanted == nullptr || wanted->empty()) return refuse(missingAttribute(document, element, "path"));
  const std::string target = normalized(fs::path(path).parent_path() / *wanted);
  if (std::find(open_.begin(), open_.end(), target) != open_.end()) {
    std::string chain;
    for (const std::string& file : open_) chain += file + " -> ";
    return refuse({document.at(element), "include",
                   Message("tree.include-cycle", "files include each other: {}{}", chain, target),
                   "take this one out"});
  }
  if (seen_.contains(target)) return true;
  auto text = read_file_(target);
  if (!text)
    return refuse({document.at(element, "path"), "include",
                   Message("tree.include-unreadable", "`{}` cannot be read", target),
                   "a path begins at the folder of the file that includes"});
  return add(std::move(*text), target, &document, &element);
}

bool Documents::addTree(const Document& document, const XmlElement& element, bool alone) {
  for (const XmlAttribute& attribute : element.attributes)
    if (attribute.name != "ID" && !attribute.name.starts_with('_') && !isForEditors(attribute.name))
      reportForeign(unknownAttribute(document, element, attribute.name,
                                     attribute.name == "main_tree_to_execute"
                                         ? "write it in <root>"
                                         : didYouMean(attribute.name, std::vector<std::string>{"ID"})));
  const std::string* id = element.attribute("ID");
  if (id != nullptr && id->empty())
    return refuse({document.at(element, "ID"), element.name, Message("tree.id-empty", "the ID is empty")});
  if (id == nullptr && !alone)
    return refuse(missingAttribute(document, element, "ID", "expected where there are several"));
  const std::string name = id == nullptr ? "BehaviorTree" : *id;
  const auto [other, is_new] = trees.try_emplace(name, TreeDefinition{&document, &element});
  if (is_new || is_elsewhere_) return true;
  const Location first = other->second.document->at(*other->second.element);
  problems_.add({document.at(element), element.name,
                 Message("tree.defined-twice", "`{}` is defined twice, first at {}", name, toString(first)),
                 "give one of them another ID"});
  return true;
}

void Documents::readModel(const Document& document, const XmlElement& element) {
  for (const XmlElement& model : element.children) {
    if (std::find(kModelKinds.begin(), kModelKinds.end(), model.name) == kModelKinds.end()) continue;
    if (problems_.full()) return;
    const std::string* id = model.attribute("ID");
    if (id == nullptr) problems_.add(missingAttribute(document, model, "ID"));
    for (const XmlElement& port : model.children) {
      if (problems_.full()) return;
      if (!isPortTag(port.name)) continue;
      const std::string* name = port.attribute("name");
      if (name == nullptr) problems_.add(missingAttribute(document, port, "name"));
      if (name == nullptr || id == nullptr || model.name != "SubTree") continue;
      const std::string* value = port.attribute("default");
      subtree_models[*id][*name] = value == nullptr ? std::nullopt : std::optional(*value);
    }
  }
}

}  // namespace swiftlet::tree

// The files of one tree: the main file and what it includes, and the <BehaviorTree> elements found in them.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "behaviors/tree/document.hpp"
#include "behaviors/tree/parse_options.hpp"
#include "behaviors/tree/problem.hpp"

namespace swiftlet::tree {

/// Collects problems and warnings up to a limit.
class Problems {
 public:
  explicit Problems(int limit) : limit_(static_cast<std::size_t>(limit)) {}
  void add(Problem problem);
  bool empty() const { return list_.empty(); }
  /// The list is full; there is no need to look for more.
  bool full() const { return list_.size() > limit_; }
  std::vector<Problem> take() { return std::move(list_); }

  /// What is suspicious but can be used. Further warnings than the limit are dropped.
  void warn(Problem warning);
  bool fullOfWarnings() const { return warnings_.size() >= limit_; }
  std::vector<Problem> takeWarnings() { return std::move(warnings_); }

 private:
  std::size_t limit_;
  std::vector<Problem> list_;
  std::vector<Problem> warnings_;
};

struct TreeDefinition {
  const Document* document = nullptr;
  const XmlElement* element = nullptr;  ///< <BehaviorTree>.
};

/// Ports that <TreeNodesModel> declares for a <SubTree ID>, with their defaults.
using SubTreeModel = std::map<std::string, std::optional<std::string>, std::less<>>;

class Documents {
 public:
  Documents(const ParseOptions& options, Problems& problems);

  void load(const std::string& path);
  void load(std::string text, const std::string& name);

  std::vector<std::unique_ptr<Document>> documents;  ///< In the order they were finished reading; stable addresses.
  std::map<std::string, TreeDefinition, std::less<>> trees;
  std::map<std::string, SubTreeModel, std::less<>> subtree_models;
  /// Null if there is none, which is then reported as a problem.
  const TreeDefinition* main = nullptr;
  std::string main_id;

 private:
  /// False if this file cannot contain a tree at all.
  bool add(std::string text, const std::string& path, const Document* from, const XmlElement* include);
  /// False if a mistake keeps out what it would add, as in addTree().
  bool include(const Document& document, const XmlElement& element, const std::string& path);
  void warnUnescaped(const SourceText& source, std::size_t offset);
  bool checkRoot(const Document& document);
  /// False for a file of another version than 4.
  bool checkFormat(const Document& document);
  void reportVersion3(const Document& document, const std::string* format);
  void readChildren(const Document& document, const std::string& path);
  /// Of an element that nobody knows.
  void reportElement(Problem problem);
  bool addTree(const Document& document, const XmlElement& element, bool alone);
  void readModel(const Document& document, const XmlElement& element);
  void findMain(const Document& document);

  const ParseOptions& options_;
  Problems& problems_;
  FileReader read_file_;
  std::set<std::string> seen_;
  std::vector<std::string> open_;  ///< The chain of includes being read.
  bool lost_a_tree_ = false;       ///< A file or a tree cannot be used; what it would define is not missing.
};

}  // namespace swiftlet::tree

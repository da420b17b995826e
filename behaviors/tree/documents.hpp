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

/// The trees that these files define. A file that cannot be read defines no tree.
TreeFiles treeFiles(const std::vector<std::string>& paths);

class Documents {
 public:
  Documents(const ParseOptions& options, Problems& problems);

  void load(const std::string& path);
  void load(std::string text, const std::string& name);

  std::vector<std::unique_ptr<Document>> documents;  ///< In the order they were finished reading; stable addresses.
  std::map<std::string, TreeDefinition, std::less<>> trees;
  std::map<std::string, SubTreeModel, std::less<>> subtree_models;
  /// Null without a main tree, which is then reported as a problem.
  const TreeDefinition* main = nullptr;
  std::string main_id;

  /// What to write into `document` for the tree of another file; empty if no other has it.
  std::string includeFor(const Document& document, const std::string& id) const;

 private:
  /// Adds the problem; false.
  bool refuse(Problem problem);
  /// False if this file cannot contain a tree at all.
  bool add(std::string text, const std::string& path, const Document* from, const XmlElement* include);
  /// False if a mistake prevents the addition, as in addTree().
  bool include(const Document& document, const XmlElement& element, const std::string& path);
  void warnUnescaped(const SourceText& source, const std::vector<std::size_t>& offsets);
  bool checkRoot(const Document& document);
  /// False for a file of another version than 4.
  bool checkFormat(const Document& document);
  void readChildren(const Document& document, const std::string& path);
  /// Of an unknown element or attribute.
  void reportForeign(Problem problem);
  bool addTree(const Document& document, const XmlElement& element, bool alone);
  void readModel(const Document& document, const XmlElement& element);
  /// Reads the files of ParseOptions::trees_elsewhere whose trees are used.
  void readElsewhere(const Document& main_file);
  bool isRead(const std::string& file) const;
  const std::string* fileElsewhere(const Document& document, const std::string& id) const;
  /// All trees: those that no other tree uses first, then those of the main file, in the order of the files.
  struct Mains {
    std::vector<std::string> ids;
    std::size_t unused = 0;

    /// What to write for the first one.
    std::string hint() const;
  };
  Mains likelyMains(const Document& main_file) const;
  void findMain(const Document& main_file);

  const ParseOptions& options_;
  Problems& problems_;
  FileReader read_file_;
  std::set<std::string> seen_;
  std::vector<std::string> open_;  ///< The chain of includes being read.
  bool is_elsewhere_ = false;      ///< Of the file being read, and of what it includes.
  bool lost_a_tree_ = false;       ///< A file or a tree cannot be used; what it would define is not missing.
};

}  // namespace swiftlet::tree

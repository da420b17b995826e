// Checks the elements of every tree, used or not, against the registry: types, ports, literals, numbers of children,
// subtrees that exist and do not contain themselves.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "behaviors/tree/documents.hpp"
#include "behaviors/tree/registry.hpp"
#include "behaviors/tree/script/script.hpp"

namespace swiftlet::tree {

class Checker {
 public:
  /// Adds every script to `scripts`, and notes it at its attribute. Leniently, a problem in a tree that the main
  /// tree does not use is a warning, and so is an unknown attribute that begins with `_`, and a tree that has the name
  /// of a type which is not of the engine.
  Checker(const Documents& documents, const Registry& registry, Problems& problems, Scripts& scripts, bool lenient);
  void check();

 private:
  void checkTree(const std::string& id, const TreeDefinition& tree);
  void reportNamedAsType(const Document& document, const XmlElement& element, const std::string& id);
  void checkElement(const Document& document, const XmlElement& element);
  void reportNoTree(const Document& document, const XmlElement& element, const std::string& id);
  void checkSubTree(const Document& document, const XmlElement& element);
  void checkNode(const Document& document, const XmlElement& element, const NodeManifest& manifest);
  void checkUnknown(const Document& document, const XmlElement& element);
  void checkAttribute(const Document& document, const XmlElement& element, const XmlAttribute& attribute,
                      const NodeManifest* manifest);
  void checkPort(const Document& document, const XmlElement& element, const XmlAttribute& attribute,
                 const PortManifest& port);
  void checkScript(const Document& document, const XmlElement& element, const XmlAttribute& attribute,
                   const PortManifest& port);
  void checkCount(const Document& document, const XmlElement& element, const PortManifest& port, std::int64_t count);
  /// Leniently a tree is meant by its ID, also where a type that the program adds has that name.
  bool isTreeNotType(const std::string& id) const { return trees_not_types_.contains(id); }
  /// The tree that is being checked, and problems in it are warnings.
  bool isUnused() const;
  /// There is no need to look for more.
  bool foundEnough() const;
  void reportNoEntry(const Document& document, const XmlElement& element, const XmlAttribute& attribute);
  /// Leniently a warning.
  void reportForeign(Problem problem);
  /// With the path of the element that is being checked.
  void report(Problem problem);
  void warn(Problem warning);
  std::string path() const;
  void checkChildren(const Document& document, const XmlElement& element, const NodeManifest& manifest);
  void checkRecursion();
  bool openUpTo(const XmlElement& from, const XmlElement* wanted);

  struct Use {
    const Document* document = nullptr;
    const XmlElement* element = nullptr;
  };

  const Documents& documents_;
  const Registry& registry_;
  Problems& problems_;
  Scripts& scripts_;
  bool lenient_;
  std::set<std::string> used_;  ///< The main tree and those that it uses, if there is one.
  std::set<std::string> trees_not_types_;
  std::string tree_id_;                  ///< Of the tree that is being checked.
  std::vector<const XmlElement*> open_;  ///< From its root to the element that is being checked.
  /// By the ID of a tree: the trees that it uses, each with the first SubTree that does.
  std::map<std::string, std::map<std::string, Use>> uses_;
  std::vector<std::string> node_names_;
  std::vector<std::string> tree_names_;
};

}  // namespace swiftlet::tree

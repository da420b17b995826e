#include "behaviors/tree/parser.hpp"

#include <memory>
#include <utility>

#include "behaviors/tree/builder.hpp"
#include "behaviors/tree/checker.hpp"
#include "behaviors/tree/documents.hpp"
#include "behaviors/tree/tree_parts.hpp"

namespace swiftlet::tree {
namespace {

ParseResult finish(Documents& documents, const Registry& registry, const ParseOptions& options, Problems& problems) {
  ParseResult result;
  auto parts = std::make_unique<TreeParts>(registry.constants());
  Checker(documents, registry, problems, parts->scripts, options.lenient).check();
  // Building requires that subtrees exist and do not contain themselves.
  if (problems.empty() && documents.main != nullptr) {
    Tree tree = Builder(documents, registry, options, problems, std::move(parts)).build();
    if (problems.empty()) result.tree = std::move(tree);
  }
  result.problems = problems.take();
  result.warnings = problems.takeWarnings();
  return result;
}

}  // namespace

ParseResult parseFile(const std::string& path, const Registry& registry, const ParseOptions& options) {
  Problems problems(options.limits.problems);
  Documents documents(options, problems);
  documents.load(path);
  return finish(documents, registry, options, problems);
}

ParseResult parseText(std::string text, const std::string& name, const Registry& registry,
                      const ParseOptions& options) {
  Problems problems(options.limits.problems);
  Documents documents(options, problems);
  documents.load(std::move(text), name);
  return finish(documents, registry, options, problems);
}

}  // namespace swiftlet::tree

// A library of leaves with the mistake that is defined.
#include <stdexcept>

#include "behaviors/leaf_library.hpp"
#include "behaviors/tree/leaf.hpp"

namespace {

namespace behaviors = swiftlet::behaviors;
namespace tree = swiftlet::tree;

class Wink final : public tree::Leaf {
 public:
  using Leaf::Leaf;
  static tree::NodeManifest manifest() {
    tree::NodeManifest manifest{.id = "Wink", .description = "Winks."};
#if defined(KNOWN_NAME)
    manifest.id = "Land";
#elif defined(WRONG_DEFAULT)
    manifest.ports = {{.name = "times", .type = tree::PortType::kInt, .default_value = "twice" }};
#elif defined(OTHER_NUMBER)
    manifest.ports = {{.name = "mode", .choices = {"slow", "fast"}}};
#endif
    return manifest;
  }

 private:
  tree::Status act(tree::TickContext&) override { return tree::Status::kSuccess; }
};

[[maybe_unused]] void add(tree::Registry& leaves) {
#if defined(THROWS)
  throw std::runtime_error("the eye is shut");
#elif !defined(NO_LEAF)
  leaves.add<Wink>();
#endif
  (void)leaves;
}

}  // namespace

#if !defined(NO_ENTRY)
extern "C" behaviors::LeafLibrary swiftlet_leaves() {
  behaviors::LeafLibrary library = behaviors::leafLibrary(add);
#if defined(OTHER_RELEASE)
  library.release = "0.1.0 (g++ 11.3.0)";
#elif defined(OTHER_HEADERS)
  ++library.layout;
#endif
  return library;
}
#endif

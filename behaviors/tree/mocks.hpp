// Mocks of node types that a registry does not have, so that trees of other programs can be read and ticked. A mock has
// the ports that the file gives it, in <TreeNodesModel> or where it is used. What the file says about neither its
// ports' directions nor its rule is assumed: every port may read and write its entry, a mock with children is a
// Sequence.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "behaviors/tree/parse_options.hpp"
#include "behaviors/tree/registry.hpp"

namespace swiftlet::tree {

/// The answer of a mock without children: RUNNING, SUCCESS, FAILURE or SKIPPED. SKIPPED of a mock that is RUNNING
/// counts as RUNNING. `ticked` is false where it is only asked whether it would start, perhaps several times in a
/// tick.
using MockAnswer = std::function<Status(const Node& mock, bool ticked)>;

/// Replaces a type without children by a mock with the same ports. It fails at its start if it cannot read an input
/// from its entry. With SUCCESS it writes to the entries of its outputs: 0, false, the point `0;0` or, as text, the
/// name of the port.
void addMockLeaf(Registry& registry, const NodeManifest& manifest, const MockAnswer& answer);

struct Mock {
  std::string id;
  NodeKind kind = NodeKind::kAction;
  /// The registry has a type of this name, but without this port of the file; empty if it has no type of this name.
  std::string instead_of_port;
};

struct MockedRegistry {
  Registry registry;
  std::vector<Mock> mocks;  ///< By id.
  /// Those that were given, and lenient: the file is to be parsed with them. Unless all leaves are types of `base`, its
  /// own program may set entries.
  ParseOptions options;
};

/// `base` and a mock, with at most 200 ports, for each type that the file and what it includes use and `base` does not
/// have. Types of `base` that are not of the engine are mocked too where the file gives them a port that they do not
/// have. Files that cannot be read add nothing; the parser reports them. A null `answer` is SUCCESS. Kind of a mock:
/// that of its model, of the explicit form, or by its children: Control with several, Decorator with one, Action with
/// none.
MockedRegistry withMocks(const std::string& path, const Registry& base, const ParseOptions& options = {},
                         const MockAnswer& answer = {});

}  // namespace swiftlet::tree

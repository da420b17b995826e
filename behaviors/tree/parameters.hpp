// The values in a tree file that people change from flight to flight: the ports of an application's leaves.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "behaviors/tree/problem.hpp"
#include "behaviors/tree/registry.hpp"

namespace swiftlet::tree {

struct Parameter {
  std::string key;    ///< "Main/Sequence/TakeOff.height_m": the path of the node in the file, and the port.
  std::string node;   ///< Name of the node.
  std::string value;  ///< As in the file, else the default, else empty.
  const PortManifest* port = nullptr;  ///< Of the registry.
};

/// Inputs of the leaves of `registry` that are not of the engine, in the order of the file. Left out are outputs,
/// scripts, and ports that are bound to an entry. Empty for a file that cannot be read, and of files that it includes.
std::vector<Parameter> parametersOf(const std::string& text, const std::string& name, const Registry& registry);

struct Changed {
  std::string text;               ///< The file with these values; its layout stays.
  std::vector<Problem> problems;  ///< Unknown keys, and values that do not fit, with what would; `text` is empty then.
};

/// `values` by key; "" takes an optional port away.
Changed withParameters(const std::string& text, const std::string& name, const Registry& registry,
                       const std::map<std::string, std::string>& values);

}  // namespace swiftlet::tree

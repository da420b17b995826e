// Trees as OctoMap itself reads them.
#pragma once

#include <octomap/octomap.h>

#include <memory>
#include <sstream>
#include <string>
#include <utility>

#include "interfaces/files/octomap.hpp"

namespace swiftlet::interfaces {

/// Null if it is no tree to OctoMap. Files of both formats give their own resolution.
inline std::unique_ptr<octomap::OcTree> asOctomapReads(const std::string& bytes, OctreeFormat format) {
  std::istringstream stream(bytes);
  if (format == OctreeFormat::kLogOdds)
    return std::unique_ptr<octomap::OcTree>(dynamic_cast<octomap::OcTree*>(octomap::AbstractOcTree::read(stream)));
  auto tree = std::make_unique<octomap::OcTree>(0.05);
  return tree->readBinary(stream) ? std::move(tree) : nullptr;
}

}  // namespace swiftlet::interfaces

// A tree as a picture.
#pragma once

#include <string>

#include "behaviors/tree/tree.hpp"

namespace swiftlet::tree {

/// An SVG: a row for each node, in the order of the file, below and to the right of its parent, with the sign and the
/// color of its kind, its name, its type where that is another, and its ports as the file binds them. The same tree
/// gives the same bytes.
std::string drawTree(const Tree& tree);

}  // namespace swiftlet::tree

// Whether the nodes of a mission come in an order that can be flown.
#pragma once

#include <vector>

#include "behaviors/tree/problem.hpp"
#include "behaviors/tree/tree.hpp"

namespace swiftlet::behaviors {

/// - A node flies or lands (leaf_traits.hpp) although the vehicle is on the floor, judged by the statuses that lead
///   there; or no node ever takes off.
/// - A child of a Priority, other than the last, that is never SKIPPED: the children below it would never get the
///   vehicle.
std::vector<tree::Problem> flightOrderProblems(const tree::Tree& tree);

/// Whether some run of the tree ends with SUCCESS while the vehicle flies. A mission that fails is another matter:
/// the autonomy brings the vehicle down.
bool mayEndInTheAir(const tree::Tree& tree);

}  // namespace swiftlet::behaviors

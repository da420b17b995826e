// What `check` says of a mission that is given as a text.
#pragma once

#include <string>
#include <vector>

#include "behaviors/mission_check.hpp"
#include "tests/tree/problem_matcher.hpp"

namespace swiftlet::behaviors::testing {

using tree::testing::At;

/// Of a mission whose tree M holds this; it begins at line 3, column 1.
inline MissionVerdict verdictOn(const std::string& inside, const MissionLimits& limits = {}) {
  return judgeMissionText("<root BTCPP_format=\"4\" main_tree_to_execute=\"M\">\n<BehaviorTree ID=\"M\">\n" + inside +
                              "\n</BehaviorTree></root>",
                          "m.xml", limits);
}
inline std::vector<tree::Problem> problemsOf(const std::string& inside, const MissionLimits& limits = {}) {
  return verdictOn(inside, limits).problems;
}
/// Of a Sequence of these nodes.
inline std::vector<tree::Problem> problemsInside(const std::string& sequence, const MissionLimits& limits = {}) {
  return problemsOf("<Sequence>" + sequence + "</Sequence>", limits);
}

}  // namespace swiftlet::behaviors::testing

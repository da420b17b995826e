// What `check` says of a mission that is given as a text.
#pragma once

#include <string>
#include <vector>

#include "behaviors/mission_check.hpp"

namespace swiftlet::behaviors::testing {

inline std::vector<common::Problem> checkMissionText(const std::string& text, const std::string& name,
                                                     const MissionLimits& limits = {}) {
  return toCommon(judgeMissionText(text, name, limits).problems);
}

}  // namespace swiftlet::behaviors::testing

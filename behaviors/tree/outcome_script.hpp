// What the leaves of a tree shall answer in a dry run, as a text that people write:
//
//   # comment
//   ticks: 60                                 greatest number of ticks; 100 if not given
//   tick_ms: 100                              between two ticks; 100 if not given
//   TakeOff: RUNNING x3, SUCCESS  # as here   one answer for each tick of the leaf; the last one stays
//   Main/Priority/Hold: SKIPPED x5, RUNNING, SUCCESS, SKIPPED
//   IsBatteryLow: false x20, true             one for each tick of the tree
//
// A leaf is named by its path, its name or its type.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "behaviors/tree/problem.hpp"
#include "behaviors/tree/status.hpp"

namespace swiftlet::tree {

struct ScriptedAnswers {
  std::string leaf;
  std::vector<Status> answers;  ///< Not empty; RUNNING, SUCCESS, FAILURE or SKIPPED.
  Location location;
};

struct OutcomeScript {
  int ticks = 100;
  int tick_ms = 100;
  std::vector<ScriptedAnswers> leaves;
  std::vector<Problem> problems;  ///< The script can be used only if there are none.
};

/// Messages use `file` as the name.
OutcomeScript readOutcomeScript(std::string_view text, const std::string& file);

}  // namespace swiftlet::tree

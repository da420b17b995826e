// Finds what cannot work in flight, from the tree alone.
#pragma once

#include <string>
#include <vector>

#include "behaviors/mission_limits.hpp"
#include "behaviors/registry.hpp"
#include "behaviors/tree/parse_options.hpp"
#include "behaviors/tree/problem.hpp"
#include "behaviors/tree/tree.hpp"
#include "common/error.hpp"

namespace swiftlet::behaviors {

/// The problems in the type of common; the path of the node ends the text.
std::vector<common::Problem> toCommon(const std::vector<tree::Problem>& problems);
/// A problem of another part of the program as one of a mission.
tree::Problem toTree(const common::Problem& problem);

/// The problems that flight_order.hpp and limits_check.hpp find.
std::vector<tree::Problem> semanticProblems(const tree::Tree& tree, const MissionLimits& limits);

/// The maps that its LoadMaps name, as they name them; each once.
std::vector<std::string> mapFilesOf(const tree::Tree& tree);

/// Every problem of a mission file, without flying it: those of the XML, and what cannot work in flight (a node that
/// flies before the take-off, a clearance the reactive layer forbids, a branch that is never ticked). Empty if
/// the mission is sound.
std::vector<common::Problem> checkMission(const std::string& path, const MissionLimits& limits = {},
                                          const tree::Registry& types = missionRegistry());

/// What can be said of a mission file without flying it.
struct MissionVerdict {
  std::vector<tree::Problem> problems;  ///< As checkMission says, with the paths of the nodes.
  /// What can be flown, but is probably not meant (mission_warnings.hpp), or should be written otherwise.
  std::vector<tree::Problem> warnings;
  /// Of a mission with mocks: the owners of the tree's nodes, a line an owner: "3 of the engine: Sequence, Timeout",
  /// "1 of Swiftlet: Land", "1 of --leaves: Circle" or "2 mocks: GoTo, TakeOff (Swiftlet's has no port `height`)".
  /// Empty if there are problems.
  std::vector<std::string> whose;
};
/// `together` are the trees of the files that were named with this one (ParseOptions::trees_elsewhere).
MissionVerdict judgeMission(const std::string& path, const MissionLimits& limits = {},
                            const tree::Registry& types = missionRegistry(), const tree::TreeFiles& together = {});
/// Nodes that are not of `types` are mocks (behaviors/tree/mocks.hpp). With one in the tree only the XML is judged,
/// because the effect of a mock on the vehicle is unknown, and so is a tree without any behaviour of Swiftlet, and one
/// that another of the files uses. Such a mission cannot be flown. The file is read leniently (ParseOptions).
MissionVerdict judgeMissionWithMocks(const std::string& path, const MissionLimits& limits = {},
                                     const tree::Registry& types = missionRegistry(),
                                     const tree::TreeFiles& together = {});

/// Of a mission file that flies without an operator who says "go on" or gives goals. Empty for an unreadable file.
std::vector<tree::Problem> operatorWarnings(const std::string& path, const MissionLimits& limits,
                                            const tree::Registry& types = missionRegistry());

MissionVerdict judgeMissionText(const std::string& text, const std::string& name, const MissionLimits& limits = {});

}  // namespace swiftlet::behaviors

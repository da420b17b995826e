#include "evaluation/phase_words.hpp"

#include <algorithm>

#include "common/world.hpp"
#include "common/world/mission_layer.hpp"
#include "common/world/vehicle_layer.hpp"

namespace swiftlet::evaluation {

std::vector<std::string> phaseWords(const common::World& world) {
  const common::MissionStatus& mission = world.mission->status;
  std::vector<std::string> words{toString(world.vehicle->flight_state), mission.phase, world.mission->intent.reason};
  for (const common::TreeNodeView& node : mission.tree)
    if (node.status == "RUNNING") words.push_back(node.name);
  return words;
}

bool anyBeginsWith(const std::vector<std::string>& words, std::string_view text) {
  return std::any_of(words.begin(), words.end(), [text](const std::string& word) { return word.starts_with(text); });
}

}  // namespace swiftlet::evaluation

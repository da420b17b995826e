#include "planning/search/planner_choice.hpp"

#include "common/check.hpp"
#include "common/config_fields.hpp"
#include "planning/search/dstar_lite.hpp"
#include "planning/search/wavefront.hpp"

namespace swiftlet::planning {

void PlannerConfig::describe(common::config::Fields& fields) {
  fields.choice("kind", kind, {"dstar_lite", "wavefront", "sampling"},
                "Who finds the paths to goals and to viewpoints.");
}

std::unique_ptr<Planner> makePlanner(const PlannerConfig& config) {
  switch (config.kind) {
    case PlannerKind::kDStarLite:
    case PlannerKind::kSampling:
      return std::make_unique<DStarLite>();
    case PlannerKind::kWavefront:
      return std::make_unique<Wavefront>();
  }
  SWIFTLET_CHECK(false, static_cast<int>(config.kind));
  return nullptr;
}

}  // namespace swiftlet::planning

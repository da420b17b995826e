#include "evaluation/system_bounds.hpp"

#include <algorithm>

#include "common/config_fields.hpp"
#include "common/validation.hpp"
#include "evaluation/figures.hpp"

namespace swiftlet::evaluation {

void PhaseBounds::describe(common::config::Fields& fields) {
  fields("phase", phase, "Name of a phase of the trial.");
  fields.list("criteria", criteria,
              "Bounds of the phase's figures for this system; they take the place of those for all systems.");
}

std::vector<common::Problem> PhaseBounds::validate() const {
  return common::Validation()
      .given(!phase.empty(), "phase")
      .require(!criteria.empty(), "criteria", common::Message("config.empty", "is empty"))
      .problems();
}

void SystemBounds::describe(common::config::Fields& fields) {
  fields("system", system, "One of the trial's system profiles.");
  fields.list("figures", figures, "Bounds of figures over all flights, as in the results: estimate_rms_median_m.");
  fields.list("phases", phases, "Bounds of the figures of phases, of each flight.");
}

std::vector<common::Problem> SystemBounds::validate() const {
  common::Validation validation;
  validation.given(!system.empty(), "system");
  for (const PhaseBound& bound : figures) validation.refuse("figures", trialFigureProblem(bound.figure));
  return validation.problems();
}

std::vector<PhaseConfig> bounded(std::vector<PhaseConfig> phases, const std::vector<PhaseBounds>& bounds) {
  for (const PhaseBounds& of_phase : bounds)
    for (PhaseConfig& phase : phases) {
      if (phase.name != of_phase.phase) continue;
      for (const PhaseBound& bound : of_phase.criteria) {
        const auto same = std::find_if(phase.criteria.begin(), phase.criteria.end(),
                                       [&](const PhaseBound& had) { return had.figure == bound.figure; });
        if (same != phase.criteria.end())
          *same = bound;
        else
          phase.criteria.push_back(bound);
      }
    }
  return phases;
}

}  // namespace swiftlet::evaluation

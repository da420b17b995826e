// Criteria of a trial for one of its systems, beyond those for all: our own must reach more than the paper's.
#pragma once

#include <string>
#include <vector>

#include "common/config_fwd.hpp"
#include "evaluation/criteria.hpp"
#include "evaluation/phase_metrics.hpp"

namespace swiftlet::evaluation {

/// The bounds of one phase, by its name.
struct PhaseBounds {
  std::string phase = {};
  std::vector<PhaseBound> criteria = {};

  void describe(common::config::Fields& fields);
  std::vector<common::Problem> validate() const;
};

struct SystemBounds {
  std::string system = {};
  std::vector<PhaseBound> figures = {};  ///< Of trialFigures(), over all flights.
  std::vector<PhaseBounds> phases = {};

  void describe(common::config::Fields& fields);
  std::vector<common::Problem> validate() const;
};

/// The phases with those bounds: one of a figure that a phase has bounds of takes their place. Names of phases that
/// there are not are ignored; TrialConfig::validate() refuses them.
std::vector<PhaseConfig> bounded(std::vector<PhaseConfig> phases, const std::vector<PhaseBounds>& bounds);

}  // namespace swiftlet::evaluation

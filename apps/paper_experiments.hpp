// The experiments, tables and figures of the five papers, as config/papers.yaml lists them.
#pragma once

#include <string>
#include <vector>

#include "common/config_fwd.hpp"

namespace swiftlet::apps {

struct PaperExperiment {
  std::string paper, item, what, reported, trial, figure, profile, own = "swiftlet", shown_by, missing, shortfall;
  std::vector<std::string> code;
  double reported_at_most = 0.0;

  void describe(common::config::Fields& fields);
  std::vector<common::Problem> validate() const;
};

struct Papers {
  std::vector<PaperExperiment> experiments;
  void describe(common::config::Fields& fields);
};

/// Reads config/papers.yaml. Throws common::InputError for an experiment whose trial does not exist, or never has its
/// figure or its profiles.
Papers readPapers();

}  // namespace swiftlet::apps

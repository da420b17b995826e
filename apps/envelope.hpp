// swiftlet trial --envelope: each quantity of the plant turned up alone until flights fail.
#pragma once

#include <optional>
#include <string>

#include "behaviors/registry.hpp"

namespace swiftlet::apps {

struct EnvelopeOptions {
  std::string trial;                                       ///< One file.
  behaviors::NodeTypes types = behaviors::missionNodes();  ///< Of its mission.
  std::string quantities = "config/envelope.yaml";         ///< The quantities to vary.
  std::string only;                                        ///< Keys of these quantities alone, by commas; empty: all.
  std::optional<int> repeat;  ///< Flights at each value; nullopt: from the quantities' file.
  std::optional<int> seed;    ///< Of the first flight at each value; nullopt: from the trial.
  int jobs = 1;               ///< Quantities at the same time.
  std::string system;         ///< Empty: that of the trial.
  std::string out;
  std::string write;  ///< Page that gets picture and table; empty: no page.
  bool json = false;
};

/// Returns the exit code: kDone if the base was acceptable and nothing interrupted the search. After an interruption,
/// what was flown is in envelope.json and report.html. Throws common::InputError.
int flyEnvelope(const EnvelopeOptions& options);

}  // namespace swiftlet::apps

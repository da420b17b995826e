// swiftlet tune --gains: the gains of a profile's controller, searched by flying a trial.
#pragma once

#include <string>

namespace swiftlet::apps {

struct TuneGainsOptions {
  std::string trial;   ///< Trial file whose phases have criteria with a `max`.
  std::string system;  ///< The profile whose gains are the start.
  std::string nature;  ///< Empty: that of the trial, which must then have one.
  std::string only;    ///< Only gains whose names begin with it; empty for all.
  int flights = 120;   ///< Altogether.
  int seeds = 3;       ///< Flights of each set of gains.
  int seed = 9001;     ///< The first one.
  int jobs = 1;        ///< Flights at the same time.
  std::string out;     ///< File of the profile that was found; empty for none.
};

/// Returns the exit code of the program: kFailed if no set of gains costs less than the profile's. Throws
/// common::InputError.
int tuneGains(const TuneGainsOptions& options);

}  // namespace swiftlet::apps

// Made-up variations of a recorded log: how far a map depends on that very log, and whether its judgement does.
#pragma once

#include <string>
#include <vector>

#include "common/time.hpp"
#include "interfaces/laser_log/laser_log.hpp"

namespace swiftlet::apps {

struct KnownScan {
  interfaces::LoggedScan logged;
  common::Time known_as;  ///< The stamp of the reference, which a variation leaves.
};

/// In the order in which they are mapped.
using KnownScans = std::vector<KnownScan>;

struct LogVariation {
  std::string name;
  void (*vary)(KnownScans&);  ///< Of scans whose stamps grow.
};

/// The same for every log and every call.
const std::vector<LogVariation>& logVariations();

/// `scans` with stamps that grow by their own intervals, and then as the variation says.
KnownScans varied(KnownScans scans, const LogVariation& variation);

}  // namespace swiftlet::apps

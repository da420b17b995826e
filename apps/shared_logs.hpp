// The recorded laser logs that changes are judged on, as config/logs.yaml lists them.
#pragma once

#include <string>
#include <vector>

#include "common/config_fwd.hpp"

namespace swiftlet::apps {

struct SharedLog {
  std::string name, log, relations, poses;
  bool poses_in_log = false, wheels = false, short_part = false;
  double best_mean_m = 0.0;
  int scans = 0;

  void describe(common::config::Fields& fields);
  std::vector<common::Problem> validate() const;

  /// The log has nothing to compare the map with.
  bool isJudgedByEye() const { return relations.empty() && poses.empty() && !poses_in_log; }
  /// "whole", or "first 800 scans".
  std::string part() const;
};

struct SharedLogs {
  std::vector<SharedLog> logs;
  void describe(common::config::Fields& fields);
};

/// Reads config/logs.yaml, and makes the paths of its files absolute. They are in `folder`, or, if it is empty, in
/// $SWIFTLET_DATASETS or in ../shared/datasets beside the folder of config/. Throws common::InputError, also for a file
/// that is not there.
std::vector<SharedLog> readSharedLogs(const std::string& folder);

}  // namespace swiftlet::apps

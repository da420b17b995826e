// The configuration of the executor.
#include "autonomy/maneuvers/executor_config.hpp"

#include "common/config_fields.hpp"

namespace swiftlet::autonomy {

using common::config::kPositive;

void ExecutorConfig::describe(common::config::Fields& fields) {
  planning.describe(fields);
  fields("clearance_m", clearance_m, {0.0, 2.0}, "Distance between hull and obstacle where an intent names none.");
  fields("detour_after_s", detour_after_s, kPositive,
         "Without a path for this long the vehicle goes nearer to look, or aside to make room.");
}

}  // namespace swiftlet::autonomy

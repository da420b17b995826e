// Records, by the truth, how well the vehicle did what some behaviours promise: keeping out of zones.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "common/geometry.hpp"
#include "common/polygon.hpp"

namespace swiftlet::common {
struct World;
}

namespace swiftlet::evaluation {

struct BehaviorRecord {
  /// Least distance of the true centre of the airborne vehicle from a keep-out zone, negative inside; from when it was
  /// first outside of that zone. None without a zone.
  std::optional<double> keep_out_distance_m;
};

/// Called by the FlightRecorder, whose functions have the same names. Calls come in the order of time.
class BehaviorRecorder {
 public:
  /// `T_map_truth` is the true pose in the vehicle's `map` frame.
  void tick(const common::Pose3& T_map_truth, bool airborne);
  void world(const common::World& world);

  const BehaviorRecord& record() const { return record_; }

 private:
  BehaviorRecord record_;
  std::shared_ptr<const std::vector<common::Polygon>> zones_;
  std::vector<common::Polygon> left_;  ///< The zones that the vehicle has been outside of since they were made.
};

}  // namespace swiftlet::evaluation

#include "evaluation/behavior_recorder.hpp"

#include <algorithm>

#include "common/world.hpp"
#include "common/world/map_layer.hpp"

namespace swiftlet::evaluation {

void BehaviorRecorder::tick(const common::Pose3& T_map_truth, bool airborne) {
  if (!zones_ || !airborne) return;
  const Eigen::Vector2d position_map_m = T_map_truth.position_m.head<2>();
  for (const common::Polygon& zone : *zones_) {
    const double distance_m = zone.signedDistance_m(position_map_m);
    if (std::find(left_.begin(), left_.end(), zone) == left_.end()) {
      if (distance_m <= 0.0) continue;
      left_.push_back(zone);
    }
    record_.keep_out_distance_m = std::min(distance_m, record_.keep_out_distance_m.value_or(distance_m));
  }
}

void BehaviorRecorder::world(const common::World& world) {
  if (zones_ == world.map->keep_out) return;
  zones_ = world.map->keep_out;
  std::erase_if(left_, [&](const common::Polygon& zone) {
    return std::find(zones_->begin(), zones_->end(), zone) == zones_->end();
  });
}

}  // namespace swiftlet::evaluation

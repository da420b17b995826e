#include "evaluation/relations.hpp"

#include <algorithm>

namespace swiftlet::evaluation {
namespace {

using common::Duration;
using common::Pose3;
using common::StampedPose;

/// Logs have stamps with six decimals of a second; equal ones differ by half a microsecond at most.
constexpr Duration kSameStamp = Duration::fromNanoseconds(500);

/// Null if there is none.
const Pose3* poseOf(const common::Trajectory& trajectory, common::Time stamp) {
  if (trajectory.empty()) return nullptr;
  const StampedPose& nearest = trajectory[common::nearestTo(trajectory, stamp)];
  return std::max(nearest.stamp - stamp, stamp - nearest.stamp) <= kSameStamp ? &nearest.pose : nullptr;
}

Statistics statisticsOfSquares(std::vector<double> values) {
  for (double& value : values) value *= value;
  return statisticsOf(values);
}

}  // namespace

RelationErrors relationErrors(const common::Trajectory& estimate, const std::vector<common::Relation>& relations) {
  RelationErrors errors;
  std::vector<double> translations_m, rotations_rad;
  for (std::size_t i = 0; i < relations.size(); ++i) {
    const common::Relation& relation = relations[i];
    const Pose3* from = poseOf(estimate, relation.from);
    const Pose3* to = poseOf(estimate, relation.to);
    if (from == nullptr || to == nullptr) {
      errors.missing.push_back(i);
      continue;
    }
    const Pose3 error = relation.T_from_to.inverse() * (from->inverse() * *to);
    translations_m.push_back(error.position_m.norm());
    rotations_rad.push_back(common::logSO3(error.rotation).norm());
  }
  errors.translation_m = statisticsOf(translations_m);
  errors.rotation_rad = statisticsOf(rotations_rad);
  errors.translation_squared_m2 = statisticsOfSquares(std::move(translations_m));
  errors.rotation_squared_rad2 = statisticsOfSquares(std::move(rotations_rad));
  return errors;
}

}  // namespace swiftlet::evaluation

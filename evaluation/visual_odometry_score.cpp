#include "evaluation/visual_odometry_score.hpp"

#include <algorithm>
#include <vector>

#include "evaluation/trajectory_metrics.hpp"

namespace swiftlet::evaluation {
namespace {

/// Between two true poses that are farther apart than this the vehicle stood: nothing is known of it.
constexpr double kGap_s = 0.2;

/// The true pose at a time between two recorded ones.
std::optional<common::Pose3> poseAt(const common::Trajectory& truth, common::Time stamp) {
  const auto after = std::lower_bound(truth.begin(), truth.end(), stamp,
                                      [](const common::StampedPose& pose, common::Time at) { return pose.stamp < at; });
  if (after == truth.begin() || after == truth.end()) return std::nullopt;
  const auto before = std::prev(after);
  const double gap_s = (after->stamp - before->stamp).seconds();
  if (gap_s > kGap_s) return std::nullopt;
  const double share = (stamp - before->stamp).seconds() / gap_s;
  common::Pose3 pose;
  pose.position_m = (1.0 - share) * before->pose.position_m + share * after->pose.position_m;
  pose.rotation = before->pose.rotation.slerp(share, after->pose.rotation);
  return pose;
}

}  // namespace

std::optional<VisualOdometryScore> scoreOf(const VisualOdometryRecord& record, const common::Trajectory& truth) {
  if (record.frames == 0) return std::nullopt;
  VisualOdometryScore score;
  score.lost_share = static_cast<double>(record.lost) / static_cast<double>(record.frames);
  std::vector<PosePair> pairs;
  for (const common::StampedPose& estimate : record.body)
    if (const auto pose = poseAt(truth, estimate.stamp)) pairs.push_back({estimate.stamp, estimate.pose, *pose});
  if (const auto error = absoluteTrajectoryError(pairs, Alignment::kSpatial)) score.rms_m = error->translation_m.rmse;
  return score;
}

}  // namespace swiftlet::evaluation

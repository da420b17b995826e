// The figures of visual odometry alone.
#include <vector>

#include "evaluation/figure_measures.hpp"
#include "evaluation/trajectory_metrics.hpp"

namespace swiftlet::evaluation {
namespace {

/// Between two true poses that are farther apart than this the vehicle stood: its pose there is unknown.
constexpr common::Duration kGap = common::Duration::fromMilliseconds(200);

}  // namespace

void measureVisualOdometry(const VisualOdometryRecord& record, const common::Trajectory& truth, FlightScore& score) {
  if (record.frames == 0) return;
  score["visual_odometry_lost_share"] = static_cast<double>(record.lost) / static_cast<double>(record.frames);
  std::vector<PosePair> pairs;
  for (const common::StampedPose& estimate : record.body)
    if (const auto pose = common::poseAt(truth, estimate.stamp, kGap))
      pairs.push_back({estimate.stamp, estimate.pose, *pose});
  if (const auto error = absoluteTrajectoryError(pairs, Alignment::kSpatial))
    score["visual_odometry_rms_m"] = error->translation_m.rmse;
}

}  // namespace swiftlet::evaluation

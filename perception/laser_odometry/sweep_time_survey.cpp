#include "perception/laser_odometry/sweep_time_survey.hpp"

#include <algorithm>
#include <cmath>

namespace swiftlet::perception {
namespace {

/// A scan counts when the robot turns by as much until the next one.
constexpr double kTurned_rad = 2.0 * common::kRadPerDeg;
/// Least number of such scans for a result.
constexpr int kLeastScans = 8;

}  // namespace

void SweepTimeSurvey::add(const common::LaserScan& scan, const common::Pose2& T_robot_laser, double period_s) {
  const std::vector<SweptPoint> in_order = sweptPoints(scan, T_robot_laser);
  for (std::size_t i = 0; i < hypotheses_.size(); ++i) {
    std::vector<SweptPoint> points = in_order;
    // Scans taken at once are of the middle of their time, so that the motion before and after counts alike.
    for (SweptPoint& point : points) point.share = i == 0 ? point.share : i == 1 ? 1.0 - point.share : 0.5;
    hypotheses_[i].tracker.add(std::move(points), scan.stamps.measured, period_s);
  }
  for (;;) {
    std::array<double, 3> fits{};
    double turned_rad = 0.0;
    bool all_found = true;
    for (std::size_t i = 0; i < hypotheses_.size(); ++i) {
      if (!hypotheses_[i].tracker.hasNext()) return;
      fits[i] = hypotheses_[i].tracker.fitOfNext();
      const auto motion = hypotheses_[i].tracker.take();
      all_found &= motion.has_value();
      if (motion) turned_rad = std::max(turned_rad, std::abs(motion->at(1.0).yaw_rad - motion->at(0.0).yaw_rad));
    }
    if (!all_found || turned_rad < kTurned_rad) continue;
    ++counted_;
    for (std::size_t i = 0; i < hypotheses_.size(); ++i) hypotheses_[i].fits += fits[i];
  }
}

std::optional<bool> SweepTimeSurvey::areSwept() const {
  if (counted_ < kLeastScans) return std::nullopt;
  return std::max(hypotheses_[0].fits, hypotheses_[1].fits) > hypotheses_[2].fits;
}

}  // namespace swiftlet::perception

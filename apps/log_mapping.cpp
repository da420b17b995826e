#include "apps/log_mapping.hpp"

#include <utility>
#include <vector>

#include <fmt/format.h>

#include "common/geometry.hpp"

namespace swiftlet::apps {
namespace {

/// Sums steps of at least this length.
constexpr double kPathStep_m = 0.1;

}  // namespace

std::optional<perception::TrackedScan> LogMapping::add(common::Time known_as, const perception::LaserSlamInput& input) {
  ++scans;
  const auto tracked = slam.add(input);
  if (!tracked) return tracked;
  unmatched += tracked->matched ? 0 : 1;
  track.add({known_as, *tracked});
  return tracked;
}

void LogMapping::finish() {
  slam.finish();
  judgement = slam.judgement();
  connection = slam.connection(judgement);
}

Trust LogMapping::trust(const std::string& why_bent) const {
  if (std::string why_not = perception::whyNotTrusted(scans, unmatched, connection, judgement); !why_not.empty())
    return {false, std::move(why_not)};
  if (!why_bent.empty()) return {false, why_bent};
  if (connection.breaks == 0) return {true, "the track was never lost"};
  return {true, fmt::format("the track was lost {} {}, and all its pieces are connected", connection.breaks,
                            connection.breaks == 1 ? "time" : "times")};
}

double LogMapping::pathLength_m() const {
  const std::vector<common::Pose2> keys = slam.keyPoses();
  std::optional<Eigen::Vector2d> last_m;
  double path_length_m = 0.0;
  track.forEach([&](const StampedScan& tracked) {
    const Eigen::Vector2d now_m = tracked.scan.T_map_robot(keys).position_m();
    const double step_m = last_m ? (now_m - *last_m).norm() : 0.0;
    if (last_m && step_m < kPathStep_m) return;
    path_length_m += step_m;
    last_m = now_m;
  });
  return path_length_m;
}

common::Trajectory LogMapping::trajectory() const {
  const std::vector<common::Pose2> keys = slam.keyPoses();
  std::vector<common::StampedPose> poses;
  track.forEach([&](const StampedScan& tracked) {
    poses.push_back({tracked.stamp, common::lifted(tracked.scan.T_map_robot(keys), 0.0)});
  });
  return common::ordered(std::move(poses)).trajectory;
}

}  // namespace swiftlet::apps

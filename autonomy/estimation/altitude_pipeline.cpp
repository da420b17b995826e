#include "autonomy/estimation/altitude_pipeline.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace swiftlet::autonomy {

std::optional<double> medianBelow_m(const perception::ProjectedScan& scan) {
  if (scan.mirror.empty()) return std::nullopt;
  std::vector<double> distances_m;
  for (const auto& point : scan.mirror) distances_m.push_back(point.belowBody_m());
  const auto middle = distances_m.begin() + static_cast<std::ptrdiff_t>(distances_m.size() / 2);
  std::nth_element(distances_m.begin(), middle, distances_m.end());
  return *middle;
}

AltitudePipeline::AltitudePipeline(const perception::MultilevelFilter::Config& config, double hull_radius_m)
    : filter_(config), hull_radius_m_(hull_radius_m), published_(std::make_shared<common::LevelMap>()) {}

void AltitudePipeline::initialize(common::Time time, double height_m) {
  filter_.initialize(time, Eigen::Vector2d::Zero(), height_m);
  last_scan_ = time;
  seen_.stood(Eigen::Vector2d::Zero(), hull_radius_m_, 0.0);
}

AltitudeStep AltitudePipeline::add(const perception::ProjectedScan& scan, const common::Pose2& T_map_odom,
                                   const common::Pose2& T_odom_body,
                                   const std::optional<perception::VerticalMotion>& vertical, bool at_rest) {
  const common::Pose2 T_map_body = T_map_odom * T_odom_body;
  AltitudeStep step;
  step.below_m = medianBelow_m(scan);
  if (!vertical || scan.stamp <= last_scan_) return step;
  const double height_m = vertical->height_m;
  std::vector<perception::GroundPoint> ground;
  ground.reserve(scan.mirror.size());
  for (const auto& point : scan.mirror)
    ground.push_back({T_map_body * Eigen::Vector2d(point.x_level_m, point.y_level_m), point.belowBody_m()});
  for (const perception::GroundPoint& point : ground)
    seen_.add(point.position_map_m, height_m - point.distance_below_m);
  fan_.add(scan, T_odom_body, height_m, surface_height_m_);
  const auto update = filter_.update({.stamp = scan.stamp,
                                      .position_map_m = T_map_body.position_m(),
                                      .points = ground,
                                      .known = *vertical,
                                      .climb = vertical->climb,
                                      .at_rest = at_rest,
                                      .gradient_map = slopes_.gradientAt(T_map_body.position_m())});
  last_scan_ = scan.stamp;
  step.vertical = update.vertical;
  if (update.vertical && update.height_above_ground_m) {
    surface_height_m_ = update.vertical->height_m - *update.height_above_ground_m;
    step.slope_ended_rise_m = followSlope(update.slopes, T_odom_body.position_m());
  }
  step.levels_joined = update.levels_joined;
  step.floor_regained_m = update.floor_regained_m;
  return step;
}

/// A slope is worth a word once it has been flown over for a metre.
std::optional<double> AltitudePipeline::followSlope(bool slopes, const Eigen::Vector2d& place_odom_m) {
  constexpr double kLong_m = 1.0;
  if (slopes == slope_.has_value()) return std::nullopt;
  const std::optional<SlopeBegin> ended =
      std::exchange(slope_, slopes ? std::optional(SlopeBegin{place_odom_m, surface_height_m_}) : std::nullopt);
  if (!ended || (place_odom_m - ended->place_odom_m).norm() < kLong_m) return std::nullopt;
  return surface_height_m_ - ended->height_m;
}

std::shared_ptr<const common::LevelMap> AltitudePipeline::levels() {
  if (published_version_ != filter_.levelsVersion()) {
    published_ = std::make_shared<common::LevelMap>(filter_.levels());
    published_version_ = filter_.levelsVersion();
  }
  return published_;
}

}  // namespace swiftlet::autonomy

#include "autonomy/estimation/altitude_pipeline.hpp"

#include <algorithm>
#include <cstddef>
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
  seen_.stood(Eigen::Vector2d::Zero(), hull_radius_m_, 0.0);
}

AltitudeStep AltitudePipeline::add(const perception::ProjectedScan& scan, const common::Pose2& T_map_odom,
                                   const common::Pose2& T_odom_body,
                                   const std::optional<perception::VerticalState>& vertical) {
  const common::Pose2 T_map_body = T_map_odom * T_odom_body;
  AltitudeStep step;
  step.below_m = medianBelow_m(scan);
  if (!vertical) return step;
  if (step.below_m) step.drift = drift_.add(scan.stamp, T_odom_body.position_m(), *step.below_m, vertical->height_m);
  std::vector<perception::GroundPoint> ground;
  ground.reserve(scan.mirror.size());
  for (const auto& point : scan.mirror)
    ground.push_back({T_map_body * Eigen::Vector2d(point.x_level_m, point.y_level_m), point.belowBody_m()});
  for (const perception::GroundPoint& point : ground)
    seen_.add(point.position_map_m, vertical->height_m - point.distance_below_m);
  fan_.add(scan, T_odom_body, vertical->height_m, surface_height_m_);
  const bool was_on_slope = ramp_.onSlope();
  step.slope_ended_rise_m =
      ramp_.move(T_map_odom, T_odom_body.position_m(), slopes_.gradientAt(T_map_body.position_m()));
  step.slope_began = ramp_.onSlope() && !was_on_slope;
  if (step.slope_ended_rise_m) slope_ended_ = scan.stamp;
  // Over a slope the ground counts as the level that it rose from.
  for (perception::GroundPoint& point : ground) point.distance_below_m += ramp_.rise_m();
  perception::HeightState prior{scan.stamp, vertical->height_m, vertical->velocity_m_s, vertical->covariance};
  prior.covariance(0, 0) += ramp_.variance_m2();
  const auto update = filter_.update(prior, T_map_body.position_m(), ground, ramp_.onSlope());
  if (update.height_above_ground_m)
    surface_height_m_ = vertical->height_m - *update.height_above_ground_m + ramp_.rise_m();
  step.measurement = update.measurement;
  step.doubt_m_s = doubt_.add(scan.stamp, T_odom_body.position_m(), step.measurement);
  if (step.measurement) {
    step.measurement->level_variance_m2 += ramp_.variance_m2();
    // A measurement is of an earlier scan, which may still be one over the slope.
    if (step.measurement->stamp >= slope_ended_) ramp_.measured();
  }
  step.levels_joined = update.levels_joined;
  step.floor_regained_m = update.floor_regained_m;
  return step;
}

std::shared_ptr<const common::LevelMap> AltitudePipeline::levels() {
  if (published_version_ != filter_.levelsVersion()) {
    published_ = std::make_shared<common::LevelMap>(filter_.levels());
    published_version_ = filter_.levelsVersion();
  }
  return published_;
}

}  // namespace swiftlet::autonomy

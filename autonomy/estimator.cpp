#include "autonomy/estimator.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <fmt/format.h>

#include "common/config_fields.hpp"

namespace swiftlet::autonomy {

using common::Pose2;
using common::Pose3;
using common::Severity;
using common::Time;

namespace {

/// Vertical distance from the body down to what is below: the median of the mirror beams.
std::optional<double> medianBelow_m(const perception::ProjectedScan& scan) {
  if (scan.mirror.empty()) return std::nullopt;
  std::vector<double> distances_m;
  for (const auto& point : scan.mirror) distances_m.push_back(point.belowBody_m());
  const auto middle = distances_m.begin() + static_cast<std::ptrdiff_t>(distances_m.size() / 2);
  std::nth_element(distances_m.begin(), middle, distances_m.end());
  return *middle;
}

common::Duration sweepOf(const common::LaserScan& scan) {
  return scan.time_increment * static_cast<std::int64_t>(scan.ranges_m.size());
}

}  // namespace

void EstimatorConfig::describe(common::config::Fields& fields) {
  fields.section("projection", projection, "Scans corrected for motion and tilt.");
  fields.section("odometry", odometry, "Scans matched to the last ones.");
  fields.section("altitude", altitude, "Height and levels from the mirror beams.");
  fields.section("fusion", fusion, "Error-state filter.");
  fields.section("people", people, "People and other things that move.");
  fields.section("slam", slam, "Graph SLAM and the map.");
  fields.section("localization", localization, "Localization in a map that the flight was given.");
  fields("match_floor_m", match_floor_m, {0, 1}, "Least standard deviation of a match's position.");
  fields("match_floor_deg", match_floor_deg, {0, 10}, "Least standard deviation of a match's yaw.");
  fields("drift_floor_m", drift_floor_m, {0, 1},
         "Least position error that a new reference of the odometry adds to its drift.");
  fields("drift_floor_deg", drift_floor_deg, {0, 10},
         "Least yaw error that a new reference of the odometry adds to its drift.");
  fields("match_per_tilt_m_rad", match_per_tilt_m_rad, {0, 10},
         "Position error of a match for each radian of tilt, since the attitude is not exact.");
  fields("match_per_tilt_deg_rad", match_per_tilt_deg_rad, {0, 100},
         "Yaw error of a match for each radian of tilt, since the attitude is not exact.");
  fields("slam_latency_s", slam_latency_s, {0.01, 10},
         "Declared time of a SLAM job: loop search, optimization and redrawing the map.");
}

Estimator::Estimator(const EstimatorConfig& config, const common::LaserConfig& laser,
                     const common::VehicleConfig& vehicle, const GivenMap* given, common::JobRunner& jobs)
    : config_(config),
      laser_(laser),
      vehicle_(vehicle),
      jobs_(jobs),
      filter_(config.fusion),
      people_(config.people, {config.slam.grid.max_height_above_m, config.slam.grid.max_height_below_m}),
      odometry_(config.odometry),
      altitude_(config.altitude),
      slam_(config.slam),
      localizer_(given ? std::make_unique<FlightLocalizer>(*given, config.localization, jobs) : nullptr),
      published_grid_(std::make_shared<common::OccupancyGrid>(slam_.snapshot())),
      published_levels_(std::make_shared<common::LevelMap>()) {}

void Estimator::addImu(const common::ImuSample& sample) {
  filter_.predict(sample);
  last_imu_ = sample;
}

std::optional<ScanOutcome> Estimator::addScan(const common::LaserScan& scan, Time now) {
  if (!filter_.initialized()) {
    initialize(scan);
    return std::nullopt;
  }
  ScanOutcome outcome;
  outcome.scan = projectScan(scan);
  const bool withheld = withholds(outcome.scan);
  const Eigen::Matrix3d covariance_before = covariance_since_map_;
  const std::uint64_t restarts_before = odometry_.counts().restarts;
  const perception::ProjectedScan standing = perception::withoutPeople(
      people_.expectedAt(scan.stamps.measured), slam_.T_map_odom() * planar(outcome.scan.T_odom_body), outcome.scan);
  if (!withheld) outcome.matched = fuseOdometry(standing);

  const Pose3 T_odom_body = filter_.poseAt(outcome.scan.stamp).value_or(outcome.scan.T_odom_body);
  outcome.T_map_body = slam_.T_map_odom() * planar(T_odom_body);
  const bool interrupted = odometry_.counts().restarts != restarts_before;
  const Eigen::Matrix3d step_covariance = covariance_since_map_ - covariance_before;
  if (localizer_ && at_flight_height_)
    localizer_->add({standing, planar(T_odom_body), step_covariance, withheld, interrupted}, now);
  else if (localizer_)
    localizer_->passOver(step_covariance, interrupted);
  fuseHeight(outcome.scan, outcome.T_map_body);
  if (const auto below_m = medianBelow_m(outcome.scan))
    outcome.raw_height = control::RawHeight{outcome.scan.stamp, *below_m};

  if (outcome.matched) addToMap(outcome, now);
  people_.update(outcome.scan, outcome.T_map_body, slam_.T_map_odom(), grid());
  reportHealth(now);
  return outcome;
}

common::VehicleState Estimator::state() const {
  common::VehicleState state = filter_.state();
  state.T_map_odom = slam_.T_map_odom();
  state.height_above_ground_m = height_above_ground_m_;
  return state;
}

std::shared_ptr<const common::OccupancyGrid> Estimator::grid() {
  if (published_grid_version_ != grid_version_) {
    published_grid_ = std::make_shared<common::OccupancyGrid>(slam_.snapshot());
    published_grid_version_ = grid_version_;
  }
  return published_grid_;
}

std::shared_ptr<const common::LevelMap> Estimator::levels() {
  if (published_levels_version_ != altitude_.levelsVersion()) {
    published_levels_ = std::make_shared<common::LevelMap>(altitude_.levels());
    published_levels_version_ = altitude_.levelsVersion();
  }
  return published_levels_;
}

std::optional<common::Localization> Estimator::localization() const {
  return localizer_ ? std::optional(localizer_->localization()) : std::nullopt;
}

std::vector<common::Event> Estimator::takeEvents() {
  std::vector<common::Event> events = std::exchange(events_, {});
  if (localizer_)
    for (common::Event& event : localizer_->takeEvents()) events.push_back(std::move(event));
  return events;
}

void Estimator::initialize(const common::LaserScan& scan) {
  if (!last_imu_) return;
  const common::RollPitchYaw tilt = common::rollPitchYaw(last_imu_->rotation_ahrs_body);
  Pose3 T_level_body{common::quaternionFrom({tilt.roll_rad, tilt.pitch_rad, 0.0}), Eigen::Vector3d::Zero()};
  const auto standing = project(
      scan, laser_, [&](Time) { return T_level_body; }, config_.projection);
  const double height_m = medianBelow_m(standing).value_or(0.5 * vehicle_.hull_height_m);

  const auto initialized = filter_.initialize(height_m);
  if (!initialized) {
    if (!waiting_said_)
      say(scan.stamps.arrived, Severity::kInfo, "fusion", "waiting to stand still", initialized.error());
    waiting_said_ = true;
    return;
  }
  altitude_.initialize(filter_.newest(), Eigen::Vector2d::Zero(), height_m);
  say(scan.stamps.arrived, Severity::kInfo, "fusion",
      fmt::format("initialized, body {:.3f} m above the floor", height_m));
}

perception::ProjectedScan Estimator::projectScan(const common::LaserScan& scan) {
  const Time begin = scan.stamps.measured, end = begin + sweepOf(scan);
  const perception::PoseHistory history = filter_.poses(begin, end);
  const Pose3 newest = filter_.state().T_odom_body;
  return project(
      scan, laser_, [&](Time t) { return history.at(t).value_or(newest); }, config_.projection);
}

/// Whether a scan is kept from the odometry, so that it can weigh particles.
bool Estimator::withholds(const perception::ProjectedScan& scan) {
  return localizer_ && at_flight_height_ && localizer_->wantsScan(planar(scan.T_odom_body));
}

bool Estimator::fuseOdometry(const perception::ProjectedScan& scan) {
  // From the same history as the scan's prediction, so that a correction since the last match does not count as motion.
  const auto last_match = odometry_.lastMatch();
  const auto T_odom_last = last_match ? filter_.poseAt(*last_match) : std::nullopt;
  const auto relative = odometry_.add(scan, T_odom_last ? std::optional(planar(*T_odom_last)) : std::nullopt);
  if (!relative) return false;
  if (relative->from == relative->to) {
    // Started anew: nothing ties it to the scans before but what it would have searched for a match.
    if (last_match) {
      const double off_m = config_.odometry.max_window_m;
      const double off_rad = config_.odometry.max_window_deg * std::numbers::pi / 180.0;
      covariance_since_map_ += Eigen::Vector3d(off_m * off_m, off_m * off_m, off_rad * off_rad).asDiagonal();
    }
    anchorOdometry(relative->to);
    return true;
  }
  if (!filter_.hasClone(track_.clone)) anchorOdometry(relative->from);
  const Pose2 T_clone_body = track_.T_clone_reference * relative->T_from_to;
  const Eigen::Matrix3d covariance =
      relative->covariance + tiltCovariance(scan, config_.match_floor_m, config_.match_floor_deg);
  std::optional<Eigen::Vector2d> unseen_direction_clone;
  if (relative->unseen_direction)
    unseen_direction_clone = Eigen::Rotation2Dd(T_clone_body.yaw_rad) * *relative->unseen_direction;
  const auto inserted =
      filter_.addRelativePose(track_.clone, relative->to, T_clone_body,
                              common::turned(covariance, track_.T_clone_reference.yaw_rad), unseen_direction_clone);
  if (relative->reference_changed) {
    track_.T_clone_reference = T_clone_body;
    if (relative->unseen_direction) anchorOdometry(relative->to);
    // Within one reference the error does not grow; it accumulates from reference to reference.
    covariance_since_map_ +=
        common::turned(relative->covariance + tiltCovariance(scan, config_.drift_floor_m, config_.drift_floor_deg),
                       -relative->T_from_to.yaw_rad);
  }
  return inserted == perception::Insertion::kTaken;
}

void Estimator::anchorOdometry(Time reference) {
  (void)filter_.addClone(reference);
  track_ = {reference, {}};
}

Eigen::Matrix3d Estimator::tiltCovariance(const perception::ProjectedScan& scan, double floor_m,
                                          double floor_deg) const {
  const double tilt_rad = std::acos(std::clamp(common::cosTilt(scan.T_odom_body.rotation), -1.0, 1.0));
  const double position_m = floor_m + config_.match_per_tilt_m_rad * tilt_rad;
  const double yaw_rad = (floor_deg + config_.match_per_tilt_deg_rad * tilt_rad) * std::numbers::pi / 180.0;
  return Eigen::Vector3d(position_m * position_m, position_m * position_m, yaw_rad * yaw_rad).asDiagonal();
}

void Estimator::fuseHeight(const perception::ProjectedScan& scan, const Pose2& T_map_body) {
  std::vector<perception::GroundPoint> ground;
  ground.reserve(scan.mirror.size());
  for (const auto& point : scan.mirror)
    ground.push_back({T_map_body * Eigen::Vector2d(point.x_level_m, point.y_level_m), point.belowBody_m()});

  const auto vertical = filter_.verticalAt(scan.stamp);
  if (!vertical) return;
  const perception::HeightState prior{scan.stamp, vertical->height_m, vertical->velocity_m_s, vertical->covariance};
  const auto update = altitude_.update(scan.stamp, T_map_body.position_m(), ground, prior);
  if (update.height_above_ground_m) height_above_ground_m_ = *update.height_above_ground_m;
  if (update.measurement) {
    (void)filter_.addHeight(update.measurement->stamp, update.measurement->height_m, update.measurement->variance_m2,
                            update.measurement->level_variance_m2);
    if (update.measurement->velocity_m_s) {
      (void)filter_.addVerticalSpeed(update.measurement->stamp, *update.measurement->velocity_m_s,
                                     update.measurement->velocity_variance_m2_s2);
    }
  }
  if (update.levels_joined > 0)
    say(scan.stamp, Severity::kInfo, "altitude", fmt::format("{} levels joined", update.levels_joined));
}

void Estimator::addToMap(ScanOutcome& outcome, Time now) {
  const Pose3 T_odom_body = filter_.poseAt(outcome.scan.stamp).value_or(outcome.scan.T_odom_body);
  const auto update = slam_.addScan(outcome.scan, planar(T_odom_body), covariance_since_map_);
  covariance_since_map_.setZero();
  outcome.T_map_body = update.T_map_body;
  if (update.drawn) ++grid_version_;
  submitSlamTask(now);
}

void Estimator::submitSlamTask(Time now) {
  if (!jobs_.idle("slam")) return;
  auto task = slam_.takeTask();
  if (!task) return;
  jobs_.submit("slam", now, common::Duration::fromSeconds(config_.slam_latency_s),
               [this, task = std::move(*task)]() -> common::JobRunner::Deliver {
                 return [this, result = run(task)](Time delivered) {
                   if (slam_.apply(result)) ++grid_version_;
                   for (const auto& loop : result.accepted)
                     say(delivered, Severity::kInfo, "slam2d",
                         fmt::format("loop closed between key scans {} and {}", loop.from, loop.to),
                         fmt::format("quality {:.2f}, {:.3f} m from what was believed", loop.quality, loop.shift_m));
                 };
               });
}

void Estimator::reportHealth(Time now) {
  const auto health = filter_.health();
  if (health.status == last_health_) return;
  const Severity severity = health.status == perception::FusionStatus::kOk         ? Severity::kInfo
                            : health.status == perception::FusionStatus::kDiverged ? Severity::kError
                                                                                   : Severity::kWarning;
  say(now, severity, "fusion", fmt::format("estimate {}", perception::toString(health.status)), health.reason);
  last_health_ = health.status;
}

void Estimator::say(Time now, Severity severity, std::string source, std::string text, std::string reason) {
  events_.push_back({now, severity, std::move(source), std::move(text), std::move(reason)});
}

}  // namespace swiftlet::autonomy

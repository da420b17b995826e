#include "autonomy/estimator.hpp"

#include <cstdint>
#include <utility>

#include <Eigen/Geometry>

#include <fmt/format.h>

#include "autonomy/estimation/camera_support.hpp"
#include "common/config_fields.hpp"

namespace swiftlet::autonomy {

using common::Pose2;
using common::Pose3;
using common::Severity;
using common::Time;

namespace {

/// The place in the map counts as measured for this long after a scan that matched: six scans of a laser with 40 Hz,
/// and more than one of the slowest, 10 Hz, even if it is late.
constexpr double kSupported_s = 0.15;
/// Velocities are differences over two samples of the IMU to each side: shorter ones have more noise, and the vehicle's
/// turns last longer.
constexpr double kHalfDifference_s = 0.01;

}  // namespace

void EstimatorConfig::describe(common::config::Fields& fields) {
  laser.describe(fields);
  fields.section("altitude", altitude, "Height and levels from the mirror beams.");
  fields.section("fusion", fusion, "Error-state filter.");
  fields.section("slam", slam, "SLAM and the map.");
  fields.section("localization", localization, "Localization in a map that the flight was given.");
  fields.section("rgbd", rgbd, "The 3D map from the frames of an RGB-D camera.");
  fields.section("vertical_laser", vertical_laser, "The 3D map from a second laser whose scan plane stands upright.");
  fields.section("targets", targets, "Coloured targets that the RGB-D camera looks for.");
  fields("slam_latency_s", slam_latency_s, {0.01, 10},
         "Declared time of a SLAM job, of the method graph: loop search, optimization and redrawing the map.");
}

Estimator::Estimator(const EstimatorConfig& config, const common::LaserConfig& laser,
                     const common::VehicleConfig& vehicle, const GivenMap* given, common::JobRunner& jobs,
                     const common::RgbdCameraConfig* camera, const common::LaserConfig* vertical_laser)
    : uses_ahrs_(config.fusion.use_ahrs),
      standing_height_m_(0.5 * vehicle.hull_height_m),
      filter_(config.fusion),
      explained_within_m_(config.people.explained_within_m),
      people_(config.people, {config.slam.grid.max_height_above_m, config.slam.grid.max_height_below_m}),
      laser_(config.laser, laser),
      start_view_(config.laser, laser, standing_height_m_),
      altitude_(config.altitude, vehicle.hullRadius_m()),
      map_(config.slam, common::Duration::fromSeconds(config.slam_latency_s), jobs),
      localization_config_(config.localization),
      jobs_(jobs),
      localizer_(given ? std::make_unique<FlightLocalizer>(*given, config.localization, jobs) : nullptr),
      rgbd_(camera ? std::make_unique<RgbdPipeline>(config.rgbd, *camera, jobs) : nullptr),
      vertical_laser_(vertical_laser && !camera
                          ? std::make_unique<VerticalLaserPipeline>(config.vertical_laser, *vertical_laser, jobs)
                          : nullptr),
      targets_(camera && !config.targets.classes.empty()
                   ? std::make_unique<TargetPipeline>(config.targets, jobs, camera->range_max_m)
                   : nullptr) {}

void Estimator::addImu(const common::ImuSample& sample, bool predicted) {
  if (predicted != filter_.predicted()) tell(perception::TapedPredicted{predicted});
  tell(sample);
  imu_seen_ = true;
  if (!sample.rotation_ahrs_body.coeffs().allFinite()) return;
  last_imu_ = sample;
  if (filter_.initialized() && !predicted)
    horizon_.observe(sample.stamps.measured, sample.rotation_ahrs_body, filter_.state().T_odom_body.rotation);
}

void Estimator::setAtRest(bool at_rest) {
  if (at_rest != filter_.atRest()) tell(perception::TapedRest{at_rest});
}

std::optional<Eigen::Vector3d> Estimator::accelerationOdom_m_s2() const {
  if (!filter_.initialized()) return std::nullopt;
  return filter_.accelerationOdom_m_s2();
}

std::optional<ScanOutcome> Estimator::addScan(const common::LaserScan& scan, Time now) {
  if (!filter_.initialized()) {
    initialize(scan);
    return std::nullopt;
  }
  // Scans that were under way when the filter started are of a time of which it knows no pose.
  if (scan.stamps.measured < started_) return std::nullopt;
  if (filter_.atRest()) lookFromStart(scan, filter_.state().T_odom_body.rotation);
  ScanOutcome outcome;
  outcome.scan = project(scan);
  altitude_.removeGround(outcome.scan);
  const perception::ProjectedScan standing = withoutPeople(outcome.scan, scan.stamps.measured);
  perception::markPeople(people_.movingAt(scan.stamps.measured), map_.T_map_odom() * planar(outcome.scan.T_odom_body),
                         outcome.scan);
  if (!laser_.wants(outcome.scan.stamp)) {
    const Pose2 T_odom_body = planar(T_odom_bodyAt(outcome.scan));
    outcome.T_map_body = map_.T_map_odom() * T_odom_body;
    outcome.drift_m = drift_m_;
    measureHeight(outcome, T_odom_body, now);
    return outcome;
  }
  const bool withheld = isWithheld(outcome.scan);
  const OdometryStep odometry = withheld ? OdometryStep{} : match(standing);
  outcome.matched = fuse(odometry);
  if (outcome.matched) position_seen_ = map_seen_ = now;
  outcome.interrupted = odometry.interrupted;

  const Pose2 T_odom_body = planar(T_odom_bodyAt(outcome.scan));
  outcome.T_map_body = map_.T_map_odom() * T_odom_body;
  const Eigen::Matrix3d step_covariance =
      outcome.matched ? step_uncertainty_.add(odometry, T_odom_body, horizontalCovariance_m2()) : odometry.covariance;
  localize({standing, T_odom_body, step_covariance, withheld, odometry.interrupted}, now);

  measureHeight(outcome, T_odom_body, now);

  const MapStep map = map_.add({outcome.scan, T_odom_bodyAt(outcome.scan), step_covariance, outcome.matched}, now);
  if (outcome.matched) outcome.T_map_body = map.T_map_body;
  outcome.at_key = map.at_key;
  scanned_ = outcome.scan.stamp;
  if (map.at_key) odom_at_key_ = {map.at_key->key, map.at_key->T_key_body * T_odom_bodyAt(outcome.scan).inverse()};
  outcome.drift_m = drift_m_ = drift_.add(positionFix(odometry, outcome.matched, T_odom_body, map));
  people_.update(outcome.scan, outcome.T_map_body, map_.T_map_odom(), map_.grid(),
                 localizer_ ? localizer_->background(map_.T_map_odom()) : std::nullopt, below_map_m_);
  // Beams that pass below a beam do not show that it is gone.
  if (outcome.matched && below_map_m_ == 0.0) map_.updateVacatedPlaces(outcome.scan, outcome.T_map_body);
  reportHealth(now);
  return outcome;
}

void Estimator::measureHeight(ScanOutcome& outcome, const Pose2& T_odom_body, Time now) {
  if (odom_at_key_) altitude_.follow(*map_.keyPoses(), odom_at_key_->key);
  const AltitudeStep altitude =
      altitude_.add(outcome.scan, map_.T_map_odom(), T_odom_body, filter_.verticalAt(outcome.scan.stamp));
  fuse(altitude, outcome.scan.stamp);
  if (!altitude.below_m) return;
  outcome.raw_height = control::RawHeight{outcome.scan.stamp, *altitude.below_m};
  height_seen_ = now;
}

void Estimator::loadMap(const GivenMap& given) {
  if (localizer_)
    localizer_->load(given);
  else
    localizer_ = std::make_unique<FlightLocalizer>(given, localization_config_, jobs_);
}

bool Estimator::forgetPlace() {
  if (localizer_) localizer_->forget();
  return localizer_ != nullptr;
}

bool Estimator::addFrame(std::shared_ptr<const common::RgbdFrame> frame) {
  if (!rgbd_ || !rgbd_->add(frame)) return false;
  lookAtGround(*frame);
  if (targets_) targets_->add(std::move(frame));
  return true;
}

void Estimator::addSweep(std::shared_ptr<const common::VerticalScan> sweep) {
  if (vertical_laser_) vertical_laser_->add(std::move(sweep));
}

void Estimator::updateMap3d(Time now) {
  if (rgbd_) mapFrames(now);
  if (vertical_laser_) mapSweeps(now);
}

void Estimator::mapFrames(Time now) {
  rgbd_->watch(map_.keyPoses(), now);
  if (const auto step = rgbd_->takeStep()) fuse(*step, now);
  mapFrame(now);
  if (targets_) lookForTargets(now);
}

void Estimator::mapFrame(Time now) {
  const auto time = rgbd_->next();
  if (!time || !filter_.initialized() || filter_.newest() < *time) return;
  if (scanned_ < *time && now < rgbd_->waitUntil()) return;
  rgbd_->map(situationAt(*time, now), now);
}

void Estimator::mapSweeps(Time now) {
  while (const auto times = vertical_laser_->next()) {
    if (!filter_.initialized() || filter_.newest() < times->end) break;
    if (scanned_ < times->end && now < vertical_laser_->waitUntil()) break;
    vertical_laser_->place(situationAt(*times, now));
  }
  vertical_laser_->draw(map_.keyPoses(), now);
}

/// None where the place in the map is only predicted: nothing else places the sweep.
std::optional<SweepSituation> Estimator::situationAt(const VerticalLaserPipeline::Interval& times, Time now) {
  const perception::PoseHistory history = filter_.motion(times.begin, times.end);
  if (!odom_at_key_ || (now - map_seen_).seconds() >= kSupported_s) return std::nullopt;
  if (!history.covers(times.begin) || !history.covers(times.end)) return std::nullopt;
  const Pose3 newest = filter_.state().T_odom_body;
  return SweepSituation{odom_at_key_->key,
                        [T_key_odom = odom_at_key_->T_key_body, history, newest](Time time) {
                          return T_key_odom * history.at(time).value_or(newest);
                        },
                        people_.expectedAt(times.begin)};
}

void Estimator::lookForTargets(Time now) {
  const common::CameraEstimate camera = rgbd_->camera();
  const auto time = targets_->next(camera.clock_offset_s);
  if (!time || !filter_.initialized() || filter_.newest() < *time) return;
  if (scanned_ < *time && now < targets_->waitUntil()) return;
  targets_->look(situationAt(*time, now), camera, drift_m_, now);
}

FrameSituation Estimator::situationAt(Time time, Time now) {
  FrameSituation situation;
  situation.at_key = atKey(time);
  situation.body = bodyAt(time);
  situation.supported = (now - map_seen_).seconds() < kSupported_s;
  situation.keys = map_.keyPoses();
  situation.people = people_.expectedAt(time);
  return situation;
}

std::vector<common::Target> Estimator::targets() {
  return targets_ ? targets_->targets(*map_.keyPoses()) : std::vector<common::Target>();
}

std::shared_ptr<const common::Map3dLayer> Estimator::map3d() {
  if (vertical_laser_) return vertical_laser_->layer(map_.keyPoses());
  return rgbd_ ? rgbd_->layer(map_.keyPoses()) : nullptr;
}

common::VehicleState Estimator::state() const {
  common::VehicleState state = filter_.state();
  state.T_map_odom = map_.T_map_odom();
  state.height_above_ground_m = state.T_odom_body.position_m.z() - altitude_.surfaceHeight_m();
  state.horizontal_supported = position_seen_;
  state.vertical_supported = height_seen_;
  return state;
}

std::optional<common::Localization> Estimator::localization() const {
  return localizer_ ? std::optional(localizer_->localization()) : std::nullopt;
}

std::vector<common::Event> Estimator::takeEvents(const common::PlaceNames& names) {
  std::vector<common::Event> events = map_.takeEvents();
  for (common::Event& event : std::exchange(events_, {})) events.push_back(std::move(event));
  if (localizer_)
    for (common::Event& event : localizer_->takeEvents()) events.push_back(std::move(event));
  if (rgbd_)
    for (common::Event& event : rgbd_->takeEvents()) events.push_back(std::move(event));
  if (vertical_laser_)
    for (common::Event& event : vertical_laser_->takeEvents()) events.push_back(std::move(event));
  if (targets_)
    for (common::Event& event : targets_->takeEvents(names)) events.push_back(std::move(event));
  return events;
}

// ------------------------------------------------------------------------------------------------------ the steps

tl::expected<perception::Insertion, std::string> Estimator::tell(const perception::FilterInput& input) {
  if (listener_ != nullptr) listener_->heard(input);
  return perception::tell(filter_, input);
}

perception::ProjectedScan Estimator::project(const common::LaserScan& scan) const {
  const Time begin = scan.stamps.measured;
  const Time end = begin + scan.time_increment * static_cast<std::int64_t>(scan.ranges_m.size());
  const perception::PoseHistory history = filter_.motion(begin, end);
  const Pose3 newest = filter_.state().T_odom_body;
  return laser_.project(scan, [&](Time t) { return history.at(t).value_or(newest); });
}

/// Points on a moving person bias the match, so points where the tracker predicts people are removed. A position that
/// is known less well than the tolerance of that comparison tells nothing: what the map does not explain may be a wall.
perception::ProjectedScan Estimator::withoutPeople(const perception::ProjectedScan& scan, Time measured) const {
  if (drift_m_ > explained_within_m_) return scan;
  return perception::withoutPeople(people_.expectedAt(measured), map_.T_map_odom() * planar(scan.T_odom_body), scan);
}

/// Whether a scan is withheld from the odometry, so that it can weigh particles.
bool Estimator::isWithheld(const perception::ProjectedScan& scan) {
  return localizer_ && at_flight_height_ && localizer_->wantsScan(planar(scan.T_odom_body));
}

OdometryStep Estimator::match(const perception::ProjectedScan& scan) {
  FilterView view;
  view.has_clone = filter_.hasClone(laser_.clone());
  if (const auto last_match = laser_.lastMatch())
    if (const auto T_odom_last = filter_.poseAt(*last_match)) view.T_odom_last = planar(*T_odom_last);
  return laser_.match(scan, view);
}

/// True when the step matched and the filter accepts it.
bool Estimator::fuse(const OdometryStep& step) {
  if (step.clone_before) tell(perception::TapedClone{*step.clone_before});
  bool taken = step.matched;
  if (step.measurement) {
    taken = tell(*step.measurement) == perception::Insertion::kTaken;
    laser_.refused(filter_.refusesRelativePoses());
  }
  if (step.clone_after) tell(perception::TapedClone{*step.clone_after});
  return taken;
}

void Estimator::fuse(const CameraStep& step, Time now) {
  using perception::Insertion;
  // What was measured from before a correction of the height on would take it back.
  if (isCameraDoubted(now)) return rgbd_->forgetClone();
  if (step.measurement) {
    const auto taken = tell(*step.measurement);
    if (taken == Insertion::kTaken) {
      const CameraSupport support = supportOf(filter_.state());
      if (support.horizontal) position_seen_ = now;
      if (support.vertical) height_seen_ = now;
    }
    if (taken == Insertion::kUnknownReference) return rgbd_->forgetClone();
  }
  if (step.clone_after) tell(perception::TapedClone{*step.clone_after});
}

Eigen::Matrix2d Estimator::horizontalCovariance_m2() const {
  return filter_.state().position_covariance_m2.topLeftCorner<2, 2>();
}

/// What the scan told of the position, for the drift.
PositionFix Estimator::positionFix(const OdometryStep& step, bool matched, const Pose2& T_odom_body,
                                   const MapStep& map) const {
  PositionFix fix;
  fix.stamp = filter_.newest();
  fix.covariance_odom_m2 = horizontalCovariance_m2();
  // A restart of the odometry has nothing to tell of the motion before it.
  fix.matched = matched && !step.interrupted;
  fix.unobservable_direction_odom = unobservableDirection(step, T_odom_body);
  fix.new_reference = matched && !step.covariance.isZero();
  if (map.at_key) fix.newest_key = map.at_key->key;
  fix.known_key = map.known_key;
  return fix;
}

void Estimator::localize(const LocatedScan& located, Time now) {
  if (!localizer_) return;
  if (at_flight_height_)
    localizer_->add(located, now);
  else
    localizer_->passOver(located.step_covariance, located.interrupted);
}

/// The pose at a time, by the place of the last scan in the map and the filter's motion since then.
std::optional<common::KeyRelativePose> Estimator::atKey(Time time) const {
  const auto T_odom_body = filter_.poseAt(time);
  if (!odom_at_key_ || !T_odom_body) return std::nullopt;
  return common::KeyRelativePose{odom_at_key_->key, odom_at_key_->T_key_body * *T_odom_body};
}

/// The filter's attitude at a time, and how its pose changes around it.
std::optional<BodyAtFrame> Estimator::bodyAt(Time time) const {
  const common::Duration half = common::Duration::fromSeconds(kHalfDifference_s);
  const auto before = filter_.poseAt(time - half), at = filter_.poseAt(time), after = filter_.poseAt(time + half);
  if (!before || !at || !after) return std::nullopt;
  const Pose3 step = before->inverse() * *after;
  constexpr double kPer_s = 0.5 / kHalfDifference_s;
  return BodyAtFrame{at->rotation, {time, kPer_s * step.position_m, kPer_s * common::logSO3(step.rotation), 0.0}};
}

/// The filter's present estimate of the pose at the scan's stamp. If its history does not reach back that far, the pose
/// by which the scan was projected.
Pose3 Estimator::T_odom_bodyAt(const perception::ProjectedScan& scan) const {
  return filter_.poseAt(scan.stamp).value_or(scan.T_odom_body);
}

void Estimator::reportHealth(Time now) {
  if (filter_.status() == last_health_) return;
  const auto health = filter_.health();
  const Severity severity = health.status == perception::FusionStatus::kOk         ? Severity::kInfo
                            : health.status == perception::FusionStatus::kDiverged ? Severity::kError
                                                                                   : Severity::kWarning;
  say(now, severity, "fusion", fmt::format("estimate {}", perception::toString(health.status)), health.reason,
      common::Concern::kEstimate);
  last_health_ = health.status;
}

void Estimator::say(Time now, Severity severity, std::string source, std::string text, std::string reason,
                    common::Concern concern) {
  events_.push_back({now, severity, std::move(source), std::move(text), std::move(reason), {}, concern});
}

}  // namespace swiftlet::autonomy

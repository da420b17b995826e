#include "autonomy/estimator.hpp"

#include <cstdint>
#include <iterator>
#include <utility>

#include <Eigen/Geometry>

#include <fmt/format.h>

#include "autonomy/estimation/camera_support.hpp"
#include "common/config_fields.hpp"
#include "common/validation.hpp"

namespace swiftlet::autonomy {

using common::Pose2;
using common::Pose3;
using common::Severity;
using common::Time;

namespace {

/// Several frames of a slow camera.
constexpr double kCameraSaw_s = 0.3;

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
  fields.list("recognition", recognition,
              "What the camera recognizes: windows and doors in depths, and patterns in pictures; none by default.");
  fields("slam_latency_s", slam_latency_s, {0.01, 10},
         "Declared time of a SLAM job, of the method graph: loop search, optimization and redrawing the map.");
}

std::vector<common::Problem> EstimatorConfig::validate() const {
  common::Validation validation;
  for (std::size_t i = 0; i < recognition.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      validation.require(recognition[i].name != recognition[j].name, "recognition",
                         common::Message("config.name-twice", "two are called `{}`", recognition[i].name));
  return validation.problems();
}

Estimator::Estimator(const EstimatorConfig& config, const common::LaserConfig& laser,
                     const common::VehicleConfig& vehicle, const GivenMap* given, common::JobRunner& jobs,
                     common::EventLog& log, const common::RgbdCameraConfig* camera,
                     const common::LaserConfig* vertical_laser)
    : log_(log),
      filter_(config.fusion),
      start_(config.laser, laser, 0.5 * vehicle.hull_height_m, config.fusion.use_ahrs, log),
      people_({config.slam.grid.max_height_above_m, config.slam.grid.max_height_below_m}),
      laser_(config.laser, laser),
      altitude_(config.altitude, vehicle.hullRadius_m()),
      map_(config.slam, common::Duration::fromSeconds(config.slam_latency_s), jobs, log),
      localizer_(given, config.localization, jobs, log),
      space_({config.rgbd, config.vertical_laser, config.targets, config.recognition, laser}, camera, vertical_laser,
             jobs, log),
      poses_(*filter_),
      uncertainty_(*filter_) {}

// ----------------------------------------------------------------------------------------------------- what arrives

void Estimator::hear(const Feedback& feedback) {
  flown_ = feedback;
  const bool at_rest = !feedback.airborne;
  if (at_rest != filter_->atRest()) filter_.tell(perception::TapedRest{at_rest});
  if (feedback.flight_height_m) map_.setFlightHeight(*feedback.flight_height_m);
  for (const GivenMapOrder& order : feedback.given_map) {
    if (order.load != nullptr)
      localizer_.load(*order.load);
    else if (localizer_)
      localizer_->forget();
  }
}

void Estimator::addImu(const common::ImuSample& sample, bool predicted) {
  if (predicted != filter_->predicted()) filter_.tell(perception::TapedPredicted{predicted});
  filter_.tell(sample);
  start_.imuArrived(sample);
  if (filter_->initialized() && !predicted && sample.rotation_ahrs_body.coeffs().allFinite())
    horizon_.observe(sample.stamps.measured, sample.rotation_ahrs_body, filter_->state().T_odom_body.rotation);
}

bool Estimator::addFrame(std::shared_ptr<const common::RgbdFrame> frame) {
  if (!space_.add(frame)) return false;
  lookAtGround(*frame);
  return true;
}

void Estimator::updateMap3d(Time now, const common::PlaceNames& names) {
  if (const auto step = space_.takeStep(map_.keyPoses(), now)) fuse(*step, now);
  space_.map(
      {poses_, map_.keyPoses(), people_, uncertainty_.drift_m(), names, space_.recognizes() ? map_.grid() : nullptr},
      now);
}

/// While the vehicle stands still, its first scans start the filter.
void Estimator::begin(const common::LaserScan& scan) {
  if (const auto height_m = start_.start(scan, laser_, filter_)) altitude_.initialize(filter_->newest(), *height_m);
}

std::optional<ScanOutcome> Estimator::addScan(const common::LaserScan& scan, Time now) {
  if (!filter_->initialized()) {
    begin(scan);
    return std::nullopt;
  }
  if (!start_.isCovered(scan)) return std::nullopt;
  space_.add(scan);
  if (filter_->atRest()) start_.look(scan, filter_->state().T_odom_body.rotation);
  ScanOutcome outcome;
  perception::ProjectedScan measured = project(scan);
  altitude_.removeGround(measured);
  const perception::ProjectedScan unlevelled = withoutPeople(measured, scan.stamps.measured);
  outcome.scan = laser_.atBodyHeight(std::move(measured));
  const perception::ProjectedScan standing = laser_.atBodyHeight(unlevelled);
  perception::markPeople(people_.movingAt(scan.stamps.measured), map_.T_map_odom() * planar(outcome.scan.T_odom_body),
                         outcome.scan);
  if (!laser_.wants(outcome.scan.stamp)) {
    const Pose2 T_odom_body = planar(T_odom_bodyAt(outcome.scan));
    outcome.T_map_body = map_.T_map_odom() * T_odom_body;
    outcome.drift_m = uncertainty_.drift_m();
    measureHeight(outcome, T_odom_body, now);
    return outcome;
  }
  const bool withheld = isWithheld(outcome.scan);
  const OdometryStep odometry = withheld ? OdometryStep{} : match(unlevelled);
  outcome.matched = !withheld && fuse(odometry, now);
  if (outcome.matched) {
    seen_.position = now;
    poses_.matched(now);
  }
  // For some tenths of a second without a match inertia knows the pose as well.
  constexpr double kKnown_s = 0.4;
  if ((now - seen_.position).seconds() < kKnown_s) laser_.learnWalls(unlevelled, T_odom_bodyAt(unlevelled));
  outcome.interrupted = odometry.interrupted;

  const Pose2 T_odom_body = planar(T_odom_bodyAt(outcome.scan));
  outcome.T_map_body = map_.T_map_odom() * T_odom_body;
  // A scan that does not match is drawn where the stereo camera places it: where daylight blinds the laser, what beams
  // cross without return is all that is known to be free.
  const bool knows_motion = outcome.matched && !odometry.interrupted;
  const bool by_stereo = !knows_motion && space_.isPlacedByStereo(now);
  const Eigen::Matrix3d step_covariance =
      by_stereo ? uncertainty_.ofMotion(T_odom_body) : uncertainty_.ofStep(odometry, outcome.matched, T_odom_body);
  localize({standing, T_odom_body, step_covariance, withheld, odometry.interrupted}, now);

  measureHeight(outcome, T_odom_body, now);

  const bool placed = outcome.matched || by_stereo;
  const perception::ProjectedScan mapped =
      perception::withoutWalkers(people_.walkersAt(outcome.scan.stamp), outcome.T_map_body, outcome.scan);
  MapStep map = map_.add({mapped, T_odom_bodyAt(outcome.scan), step_covariance, placed}, now);
  if (placed) outcome.T_map_body = map.T_map_body;
  outcome.at_key = map.at_key;
  outcome.gone = std::move(map.gone);
  poses_.scanned(outcome.scan.stamp, map.at_key, T_odom_bodyAt(outcome.scan));
  outcome.drift_m = uncertainty_.add(odometry, outcome.matched, T_odom_body, map);
  people_.update(outcome.scan, outcome.T_map_body, map_.T_map_odom(), map_.grid(),
                 localizer_ ? localizer_->background(map_.T_map_odom()) : std::nullopt, flown_.below_map_m);
  filter_.reportHealth(now, log_);
  return outcome;
}

// ------------------------------------------------------------------------------------------------------ what is known

std::string Estimator::whyUnready(Time now) const {
  return start_.problem(now, space_.hasCamera() && (now - seen_.position).seconds() < kCameraSaw_s);
}

common::VehicleState Estimator::state() const {
  common::VehicleState state = filter_->state();
  state.T_map_odom = map_.T_map_odom();
  state.height_above_ground_m = state.T_odom_body.position_m.z() - altitude_.surfaceHeight_m();
  state.horizontal_supported = seen_.position;
  state.vertical_supported = seen_.height;
  return state;
}

BodyMotion Estimator::motion() const {
  return {filter_->initialized() ? std::optional<Eigen::Vector3d>(filter_->estimate().acceleration_odom_m_s2)
                                 : std::nullopt,
          horizon_.offset_rad()};
}

EstimatedMaps Estimator::maps() {
  EstimatedMaps maps;
  maps.grid = map_.grid();
  maps.key_poses = map_.keyPoses();
  maps.levels = altitude_.levels();
  maps.map3d = space_.layer(maps.key_poses);
  maps.targets = space_.targets(*maps.key_poses);
  maps.objects = space_.objects(*maps.key_poses);
  if (localizer_) maps.localization = localizer_->localization();
  return maps;
}

// ------------------------------------------------------------------------------------------------------ the steps

perception::ProjectedScan Estimator::project(const common::LaserScan& scan) const {
  const Time begin = scan.stamps.measured;
  const Time end = begin + scan.time_increment * static_cast<std::int64_t>(scan.ranges_m.size());
  const perception::PoseHistory history = filter_->motion(begin, end);
  const Pose3 newest = filter_->state().T_odom_body;
  return laser_.project(scan, [&](Time t) { return history.at(t).value_or(newest); });
}

/// Points on a moving person bias the match, so points where the tracker predicts people are removed. A position that
/// known less well than the tolerance of that comparison is no basis: what the map does not explain may be a wall.
perception::ProjectedScan Estimator::withoutPeople(const perception::ProjectedScan& scan, Time measured) const {
  if (uncertainty_.drift_m() > perception::DynamicObstacles::kExplainedWithin_m) return scan;
  return perception::withoutPeople(people_.expectedAt(measured), map_.T_map_odom() * planar(scan.T_odom_body), scan);
}

/// Whether a scan is withheld from the odometry, so that it can weigh particles.
bool Estimator::isWithheld(const perception::ProjectedScan& scan) {
  return localizer_ && flown_.at_flight_height && localizer_->wantsScan(planar(scan.T_odom_body));
}

OdometryStep Estimator::match(const perception::ProjectedScan& scan) {
  FilterView view;
  view.has_clone = filter_->hasClone(laser_.clone());
  if (const auto last_match = laser_.lastMatch())
    if (const auto T_odom_last = filter_->poseAt(*last_match)) view.T_odom_last = planar(*T_odom_last);
  return laser_.match(scan, view);
}

/// True when the step matched and the filter accepts it, or need not.
bool Estimator::fuse(const OdometryStep& step, Time now) {
  if (step.clone_before) filter_.tell(perception::poseClone(*step.clone_before));
  bool taken = step.matched;
  // The scan with which a reference begins measures no motion, and is none that measures nothing.
  const bool measures = step.measurement || !step.matched;
  if (measures && filter_.uses(perception::OdometrySource::kLaser, step.measurement, now, log_)) {
    taken = filter_.tell(*step.measurement) == perception::Insertion::kTaken;
    laser_.refused(filter_->refusesRelativePoses());
  }
  if (step.clone_after) filter_.tell(perception::poseClone(*step.clone_after));
  return taken;
}

void Estimator::localize(const LocatedScan& located, Time now) {
  if (!localizer_) return;
  if (flown_.at_flight_height)
    localizer_->add(located, now);
  else
    localizer_->passOver(located.step_covariance, located.interrupted);
}

/// The filter's present estimate of the pose at the scan's stamp. If its history does not reach back that far, the pose
/// by which the scan was projected.
Pose3 Estimator::T_odom_bodyAt(const perception::ProjectedScan& scan) const {
  return filter_->poseAt(scan.stamp).value_or(scan.T_odom_body);
}

// ------------------------------------------------------------------------------------------ the height and the camera

void Estimator::measureHeight(ScanOutcome& outcome, const Pose2& T_odom_body, Time now) {
  if (poses_.odomAtKey()) altitude_.follow(*map_.keyPoses(), poses_.odomAtKey()->key);
  const Time stamp = outcome.scan.stamp;
  const AltitudeStep altitude = altitude_.add(outcome.scan, map_.T_map_odom(), T_odom_body,
                                              filter_->verticalAt(stamp, altitude_.lastScan()), filter_->atRest());
  fuse(altitude, outcome.scan.stamp);
  if (!altitude.below_m) return;
  outcome.raw_height = control::RawHeight{outcome.scan.stamp, *altitude.below_m};
  space_.addBeams(stamp, *altitude.below_m, T_odom_bodyAt(outcome.scan).rotation);
  seen_.height = now;
}

void Estimator::fuse(const AltitudeStep& step, Time stamp) {
  if (step.vertical) filter_.tell(perception::knownVertical(stamp, *step.vertical));
  if (step.slope_ended_rise_m)
    log_.info(stamp, "altitude", "the ground sloped",
              fmt::format("the ground is {:+.2f} m where it is level again", *step.slope_ended_rise_m));
  if (step.floor_regained_m) {
    space_.doubtCamera(stamp);
    log_.warn(
        stamp, "altitude", "floor recognized again",
        fmt::format("a surface that was mapped as a level is the known floor: the height is corrected by {:+.2f} m",
                    *step.floor_regained_m));
  }
  if (step.levels_joined > 0) log_.info(stamp, "altitude", fmt::format("{} levels joined", step.levels_joined));
}

void Estimator::fuse(const CameraStep& step, Time now) {
  using perception::Insertion;
  // What was measured from before a correction of the height on would take it back.
  if (space_.isCameraDoubted(now)) return space_.forgetClone();
  if (filter_.uses(perception::OdometrySource::kVision, step.measurement, now, log_)) {
    const auto taken = filter_.tell(*step.measurement);
    if (taken == Insertion::kTaken) {
      const CameraSupport support = supportOf(filter_->state());
      if (support.horizontal) seen_.position = now;
      if (support.horizontal) space_.placedByStereo(now);
      if (support.vertical) seen_.height = now;
    }
    if (taken == Insertion::kUnknownReference) return space_.forgetClone();
  }
  if (step.clone_after) filter_.tell(perception::poseClone(*step.clone_after, perception::OdometrySource::kVision));
}

/// The poses at the time of the frame are known when it arrives.
void Estimator::lookAtGround(const common::RgbdFrame& frame) {
  const common::CameraEstimate camera = space_.camera();
  const Time time = frame.stamps.measured - common::Duration::fromSeconds(camera.clock_offset_s);
  if (!filter_->initialized() || !altitude_.wantsGround(time)) return;
  const std::optional<common::KeyRelativePose> at_key = poses_.atKey(time);
  if (!at_key || !poses_.isSupported(frame.stamps.arrived)) return;
  const auto keys = map_.keyPoses();
  altitude_.follow(*keys, at_key->key);
  altitude_.lookAtGround(time, frame.depth, frame.camera, keys->inMap(*at_key) * camera.T_body_camera);
}

}  // namespace swiftlet::autonomy

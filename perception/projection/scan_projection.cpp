#include "perception/projection/scan_projection.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "common/config_fields.hpp"

namespace swiftlet::perception {
namespace {

using common::kRadPerDeg;
using common::Pose3;

/// End points this near to floor or ceiling are left out.
constexpr double kSurfaceMargin_m = 0.05;
/// Error of roll and pitch, which widens kSurfaceMargin_m with the range (up to 1 deg: Grzonka 2009).
constexpr double kAttitudeError_deg = 1.0;
/// Fewer neighbouring beams without return are dropouts, not free space.
constexpr int kMinNoReturnRun = 3;

/// Number of intervals between the knots of a sweep.
constexpr int kIntervals = 8;

/// A beam that half meets an edge reports a range between its surface and the one behind (a mixed pixel; Tuley,
/// Vandapel, Hebert 2005). It differs from both by more than three times the noise of a small laser.
constexpr double kMixedJump_m = 0.10;
/// The spots of small lasers are as wide as their beams are apart, up to 0.36 deg. Where beams are farther apart, three
/// neighbours often meet three things, so a range between the others is no evidence of one.
constexpr double kMixedSpacing_rad = 0.4 * common::kRadPerDeg;
/// On a slanted wall neighbouring ranges differ as much, but evenly.
constexpr double kEvenShare = 0.25;

struct Affine {
  Eigen::Matrix3d rotation;
  Eigen::Vector3d translation;
};

Affine affine(const Pose3& pose) { return {pose.rotation.toRotationMatrix(), pose.position_m}; }

/// T_level_sensor for any beam: exact at a few knots of the sweep, linear between them. The body turns by milliradians
/// between two knots, so the interpolated matrix is a rotation to within 1e-5.
class SweptMount {
 public:
  SweptMount(const std::vector<Pose3>& T_level_body, const Pose3& T_body_sensor, int beams) : beams_(beams) {
    knots_.reserve(T_level_body.size());
    for (const Pose3& pose : T_level_body) knots_.push_back(affine(pose * T_body_sensor));
  }

  Affine at(int beam) const {
    if (knots_.size() == 1) return knots_.front();
    const double position = static_cast<double>(beam) * (static_cast<double>(knots_.size()) - 1.0) / (beams_ - 1);
    const auto k = std::min(static_cast<std::size_t>(position), knots_.size() - 2);
    const double share = position - static_cast<double>(k);
    return {(1.0 - share) * knots_[k].rotation + share * knots_[k + 1].rotation,
            (1.0 - share) * knots_[k].translation + share * knots_[k + 1].translation};
  }

 private:
  std::vector<Affine> knots_;
  int beams_;
};

/// Decides from its rise or fall whether a beam ended on the floor or the ceiling.
class Surfaces {
 public:
  Surfaces(double sensor_height_odom_m, const ScanProjectionConfig& config)
      : config_(config),
        above_floor_m_(std::max(sensor_height_odom_m - config.floor_height_odom_m, 0.05)),
        below_ceiling_m_(config.ceiling_height_odom_m > 0.0
                             ? std::max(config.ceiling_height_odom_m - sensor_height_odom_m, 0.05)
                             : config.max_rise_m),
        sin_attitude_error_(std::sin(kAttitudeError_deg * kRadPerDeg)) {}

  // The margin is at most half the height above the floor, so that a level beam near the floor never counts as a hit on
  // it.
  bool onFloor(double rise_m, double range_m) const {
    return -rise_m > above_floor_m_ - std::min(margin(range_m), 0.5 * above_floor_m_);
  }
  bool onCeiling(double rise_m, double range_m) const {
    return rise_m > below_ceiling_m_ - std::min(margin(range_m), 0.5 * below_ceiling_m_);
  }

  /// The range up to which a beam that hit no wall shows free space at the body's height.
  double freeRange(double slope, double range_m) const {
    const double band_m = std::min({config_.free_band_m, 0.5 * above_floor_m_, 0.5 * below_ceiling_m_});
    return std::abs(slope) * range_m > band_m ? band_m / std::abs(slope) : range_m;
  }

 private:
  double margin(double range_m) const { return kSurfaceMargin_m + sin_attitude_error_ * range_m; }

  const ScanProjectionConfig& config_;
  double above_floor_m_;
  double below_ceiling_m_;
  double sin_attitude_error_;
};

/// Places the beams of one sweep and sorts them by what they ended on.
class BeamSorter {
 public:
  BeamSorter(const common::LaserScan& scan, const common::LaserConfig& laser, const std::vector<Pose3>& T_level_body,
             const ScanProjectionConfig& config, ProjectedScan& result)
      : scan_(scan),
        laser_(laser),
        config_(config),
        result_(result),
        laser_mount_(T_level_body, laser.mount.pose(), beams()),
        mirror_mount_(T_level_body, laser.mirror_mount.pose(), beams()),
        surfaces_(result.T_odom_body.position_m.z() + laserHeight_m(), config) {}

  void addMirrorBeam(int beam) {
    endRun();
    const double range_m = rangeOf(beam);
    if (isTooShort(range_m) || range_m > scan_.range_max_m) {
      ++result_.counts.mirror_invalid;
      return;
    }
    const Affine mount = mirror_mount_.at(beam);
    const Eigen::Vector3d end = mount.rotation * (range_m * laser_.direction(beam)) + mount.translation;
    result_.mirror.push_back({static_cast<float>(end.x()), static_cast<float>(end.y()), static_cast<float>(end.z())});
    ++result_.counts.mirror;
  }

  /// `direction` is the beam's in the laser's frame.
  void addBeam(int beam, const Eigen::Vector3d& direction) {
    const double range_m = rangeOf(beam);
    if (isTooShort(range_m)) {
      endRun();
      ++result_.counts.invalid;
      return;
    }
    const Affine mount = laser_mount_.at(beam);
    const Eigen::Vector3d ray = mount.rotation * direction;
    const auto pointAt = [&](double along_m) -> Eigen::Vector3f {
      return (mount.translation + along_m * ray).cast<float>();
    };
    if (range_m > scan_.range_max_m) {
      run_.push_back(pointAt(surfaces_.freeRange(ray.z(), scan_.range_max_m)));
      ++result_.counts.no_returns;
      return;
    }
    endRun();
    const Eigen::Vector3d end = mount.translation + range_m * ray;
    if (end.head<2>().squaredNorm() < config_.body_radius_m * config_.body_radius_m) {
      ++result_.counts.invalid;
    } else if (isMixed(beam)) {
      // It has passed as far as the nearer surface.
      result_.misses_level_m.push_back(pointAt(std::min(rangeOf(beam - 1), rangeOf(beam + 1))));
      ++result_.counts.invalid;
    } else if (const double rise_m = range_m * ray.z(); surfaces_.onFloor(rise_m, range_m)) {
      result_.misses_level_m.push_back(pointAt(surfaces_.freeRange(ray.z(), range_m)));
      ++result_.counts.floor_hits;
    } else if (surfaces_.onCeiling(rise_m, range_m)) {
      result_.misses_level_m.push_back(pointAt(surfaces_.freeRange(ray.z(), range_m)));
      ++result_.counts.ceiling_hits;
    } else {
      result_.points_level_m.push_back(end.head<2>().cast<float>());
      result_.heights_level_m.push_back(static_cast<float>(end.z()));
      ++result_.counts.hits;
    }
  }

  double laserHeight_m() const { return laser_mount_.at(beams() / 2).translation.z(); }

  /// Ends a run of beams without return. A short run is dropouts and is left out.
  void endRun() {
    if (static_cast<int>(run_.size()) >= kMinNoReturnRun)
      result_.no_returns_level_m.insert(result_.no_returns_level_m.end(), run_.begin(), run_.end());
    run_.clear();
  }

 private:
  int beams() const { return static_cast<int>(scan_.ranges_m.size()); }
  double rangeOf(int beam) const { return scan_.ranges_m[static_cast<std::size_t>(beam)]; }
  /// True for NaN.
  bool isTooShort(double range_m) const { return !(range_m >= scan_.range_min_m) || range_m <= 0.0; }

  /// Whether the range lies between those of two surfaces that the neighbours see. A thin thing before a wall is nearer
  /// than both and counts.
  bool isMixed(int beam) const {
    if (scan_.angle_increment_rad > kMixedSpacing_rad || beam < 2 || beam + 2 >= beams()) return false;
    std::array<double, 4> steps_m{};
    for (int i = 0; i < 4; ++i) steps_m[static_cast<std::size_t>(i)] = rangeOf(beam + i - 1) - rangeOf(beam + i - 2);
    const double towards_m = steps_m[1], away_m = steps_m[2];
    const double along_m = std::max(std::abs(steps_m[0]), std::abs(steps_m[3]));
    if (towards_m * away_m <= 0.0 || std::min(std::abs(towards_m), std::abs(away_m)) < kMixedJump_m) return false;
    return along_m < kEvenShare * std::abs(towards_m + away_m) && rangeOf(beam + 2) <= scan_.range_max_m;
  }

  const common::LaserScan& scan_;
  const common::LaserConfig& laser_;
  const ScanProjectionConfig& config_;
  ProjectedScan& result_;
  SweptMount laser_mount_;
  SweptMount mirror_mount_;
  Surfaces surfaces_;
  std::vector<Eigen::Vector3f> run_;  ///< Ends of the view along the present run of beams without return.
};

std::vector<Pose3> bodyDuringSweep(const common::LaserScan& scan, const PoseAt& pose_at, const Pose3& T_level_odom,
                                   int beams) {
  const int knots = scan.time_increment.nanoseconds() == 0 || beams < 2 ? 1 : kIntervals + 1;
  std::vector<Pose3> poses;
  for (int k = 0; k < knots; ++k) {
    const auto offset =
        knots == 1 ? common::Duration() : scan.time_increment * (beams - 1) * k / static_cast<std::int64_t>(knots - 1);
    poses.push_back(T_level_odom * pose_at(scan.stamps.measured + offset));
  }
  return poses;
}

}  // namespace

void ScanProjectionConfig::describe(common::config::Fields& fields) {
  fields("ceiling_height_odom_m", ceiling_height_odom_m, {0, 100},
         "Height of the ceiling over the take-off floor; 0 when unknown.");
  fields("body_radius_m", body_radius_m, {0, 2},
         "Returns nearer than this to the body's axis are the vehicle itself and invalid.");
}

ProjectedScan project(const common::LaserScan& scan, const common::LaserConfig& laser, const PoseAt& pose_at,
                      const ScanProjectionConfig& config) {
  const int beams = static_cast<int>(scan.ranges_m.size());
  ProjectedScan result;
  result.stamp = scan.stamps.measured + scan.time_increment * std::max(beams - 1, 0) / 2;
  result.T_odom_body = pose_at(result.stamp);

  const Pose3 T_level_odom = Pose3{common::quaternionFrom({0.0, 0.0, common::yawOf(result.T_odom_body.rotation)}),
                                   result.T_odom_body.position_m}
                                 .inverse();
  const std::vector<Pose3> T_level_body = bodyDuringSweep(scan, pose_at, T_level_odom, beams);
  const bool known = isFinite(result.T_odom_body) && std::all_of(T_level_body.begin(), T_level_body.end(),
                                                                 [](const Pose3& pose) { return isFinite(pose); });
  if (beams < 2 || !known || !std::isfinite(scan.angle_min_rad) || !std::isfinite(scan.angle_increment_rad)) {
    result.counts.invalid = beams;
    return result;
  }
  result.points_level_m.reserve(static_cast<std::size_t>(beams));
  result.heights_level_m.reserve(static_cast<std::size_t>(beams));

  BeamSorter sorter(scan, laser, T_level_body, config, result);
  result.laser_height_level_m = static_cast<float>(sorter.laserHeight_m());
  const bool has_mirror = beams == laser.beams && laser.mirror_beams > 0;
  // The direction is rotated from beam to beam. This saves the sines and keeps 12 digits over thousands of beams.
  double cos_beam = std::cos(scan.angle_min_rad), sin_beam = std::sin(scan.angle_min_rad);
  const double cos_step = std::cos(scan.angle_increment_rad), sin_step = std::sin(scan.angle_increment_rad);
  for (int beam = 0; beam < beams; ++beam) {
    if (has_mirror && laser.isMirrorBeam(beam)) {
      sorter.addMirrorBeam(beam);
    } else {
      sorter.addBeam(beam, {cos_beam, sin_beam, 0.0});
    }
    const double next_cos = cos_beam * cos_step - sin_beam * sin_step;
    sin_beam = sin_beam * cos_step + cos_beam * sin_step;
    cos_beam = next_cos;
  }
  sorter.endRun();
  return result;
}

ProjectedScan projectLevel(const common::LaserScan& scan, const common::Pose2& T_robot_laser,
                           const common::Pose2& T_odom_robot) {
  // Any height above the floor serves, because no beam is tilted towards it.
  constexpr double kHeight_m = 1.0;
  common::LaserConfig laser;
  laser.mirror_beams = 0;
  laser.mount.x_m = T_robot_laser.x_m;
  laser.mount.y_m = T_robot_laser.y_m;
  laser.mount.yaw_deg = T_robot_laser.yaw_rad / common::kRadPerDeg;
  return project(scan, laser, [&](common::Time) { return common::lifted(T_odom_robot, kHeight_m); }, {});
}

}  // namespace swiftlet::perception

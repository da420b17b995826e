// Support for stories of the estimator: an artificial flight through a flat of upright walls, measured by an IMU and a
// swept laser with a mirror. `odom` starts at the truth's origin, so that errors are differences.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "autonomy/estimator.hpp"
#include "common/config.hpp"
#include "tests/fusion/synthetic_flight.hpp"
#include "tests/scan_matching/planar_world.hpp"

namespace swiftlet::autonomy {

/// A small room around a place, so close on all sides that none of its walls coincides with one of the flat.
inline test::PlanarWorld den(const Eigen::Vector2d& center_m, double radius_m) {
  std::vector<Eigen::Vector2d> corners;
  for (int i = 0; i < 9; ++i) {
    const double angle_rad = i * 2.0 * std::numbers::pi / 9.0, r_m = radius_m * (1.0 + 0.12 * std::sin(2.5 * i));
    corners.push_back(center_m + r_m * Eigen::Vector2d(std::cos(angle_rad), std::sin(angle_rad)));
  }
  test::PlanarWorld world;
  world.addPolyline(corners, true);
  return world;
}

/// Rests for two seconds, then moves around the origin with growing amplitude.
class EstimatorStory {
 public:
  explicit EstimatorStory(double seconds, const GivenMap* given = nullptr,
                          const EstimatorConfig& config = EstimatorStory::config(),
                          const common::RgbdCameraConfig* camera = nullptr)
      : flight_(1, seconds),
        imu_(flight_.imuSamples()),
        laser_(common::config::readFile<common::LaserConfig>(SWIFTLET_SOURCE_DIR "/config/sensors/utm_30lx.yaml")),
        jobs_(common::makeLockstepJobs(0)),
        estimator(config, laser_, common::VehicleConfig{}, given, *jobs_, log_, camera) {}

  /// The artificial flight tilts independently of its motion, so its accelerometer shows no drag.
  static EstimatorConfig config() {
    EstimatorConfig config;
    config.fusion.use_drag = false;
    return config;
  }

  /// Feeds the measurements until then; `each` is called after every scan.
  void run(double until_s, const std::function<void(const std::optional<ScanOutcome>&)>& each = {}) {
    for (; next_ < imu_.size() && imu_[next_].stamps.measured.seconds() <= until_s; ++next_) {
      const common::Time now = imu_[next_].stamps.measured;
      jobs_->deliverDue(now);
      feedback.airborne = now.seconds() >= flight_.rest_until_s - 0.05;
      estimator.hear(feedback);
      estimator.addImu(imu_[next_]);
      if (next_ % kImuPerScan != kImuPerScan - 1) continue;
      // The sweep that has just arrived began four samples ago.
      const auto outcome = estimator.addScan(scanFrom(imu_[next_ + 1 - kImuPerScan].stamps.measured, now), now);
      for (common::Event& event : log_.take()) events.push_back(std::move(event));
      if (each) each(outcome);
    }
  }
  /// Drops the measurements until then.
  void skipTo(double s) {
    while (next_ < imu_.size() && imu_[next_].stamps.measured.seconds() < s) ++next_;
  }

  common::Pose3 truthAt(common::Time time) const { return flight_.motion.pose(time.seconds()); }
  double positionError_m() const {
    const common::VehicleState state = estimator.state();
    return (state.T_map_body().position_m - truthAt(state.stamp).position_m).norm();
  }
  int eventsThatBegin(const std::string& text) const {
    return static_cast<int>(
        std::count_if(events.begin(), events.end(), [&](const auto& event) { return event.text.starts_with(text); }));
  }

  bool blind = false;  ///< No beam of the laser comes back.
  test::PlanarWorld world = test::flat();
  std::vector<common::Event> events;

 private:
  static constexpr std::size_t kImuPerScan = 5;  ///< 200 Hz and 40 Hz.

  common::LaserScan scanFrom(common::Time begin, common::Time arrived) {
    common::RandomStream random(3, "laser", ++frame_);
    common::LaserScan scan = test::sweep(
        world, laser_, [this](common::Time t) { return truthAt(t); }, begin, random);
    if (blind) scan.ranges_m.assign(scan.ranges_m.size(), std::numeric_limits<float>::infinity());
    scan.stamps.arrived = arrived;
    return scan;
  }

  common::EventLog log_;
  perception::SyntheticFlight flight_;
  std::vector<common::ImuSample> imu_;
  common::LaserConfig laser_;
  std::unique_ptr<common::JobRunner> jobs_;
  std::size_t next_ = 0;
  std::uint64_t frame_ = 0;

 public:
  Feedback feedback;  ///< Of every tick; `run` says whether the vehicle is airborne.
  Estimator estimator;
};

}  // namespace swiftlet::autonomy

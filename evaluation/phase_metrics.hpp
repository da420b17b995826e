// Figures over a part of a flight: between two times, in a phase of the mission, while a behaviour runs; with criteria
// on them by name.
#pragma once

#include <deque>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/config_fwd.hpp"
#include "common/error.hpp"
#include "common/geometry.hpp"
#include "common/level_map.hpp"
#include "common/time.hpp"
#include "common/vehicle_state.hpp"

namespace swiftlet::common {
struct World;
}

namespace swiftlet::evaluation {

/// The bounds of one figure of a phase.
struct PhaseBound {
  std::string figure = {};
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();

  void describe(common::config::Fields& fields);
  std::vector<common::Problem> validate() const;
};

/// Why the bound is missed, in words: a figure that there is not is a miss; empty if it holds.
std::string missed(const PhaseBound& bound, const std::optional<double>& value);

struct PhaseConfig {
  std::string name = {};
  double from_s = 0.0;
  double to_s = 1e6;
  std::string phase = {};
  double settle_s = 0.0;
  std::vector<double> place_map_m = {};
  double height_map_m = 0.0;
  std::vector<PhaseBound> criteria = {};

  void describe(common::config::Fields& fields);
  std::vector<common::Problem> validate() const;
};

/// Why such a phase has no figure of that name, with the most similar one; empty if it has one. It may have a height of
/// any number of levels.
std::optional<common::Problem> phaseFigureProblem(const PhaseConfig& config, const std::string& name);

/// By their names: position_mean_x_m, height_std_m ...
using PhaseFigures = std::vector<std::pair<std::string, double>>;

/// The figures of one phase of a flight. A phase without a tick has only its time.
struct PhaseScore {
  std::string name;
  PhaseFigures figures;
  std::vector<PhaseBound> criteria;

  std::optional<double> figure(const std::string& figure) const;
  /// The criteria that are missed, in words; a figure that the phase lacks is a miss.
  std::vector<std::string> missed() const;
};

/// The figures that such a phase has of a flight that came into it, without the heights of its levels.
std::vector<std::string> phaseFigureNames(const PhaseConfig& config);

/// What one control tick shows of the vehicle, in its frame `map`.
struct PhaseTick {
  common::Time now;
  common::Pose3 T_map_truth;
  Eigen::Vector3d velocity_map_m_s = Eigen::Vector3d::Zero();
  common::VehicleState estimate;
  std::optional<Eigen::Vector3d> reference_odom_m = std::nullopt;  ///< Of the controller; nullopt unless it flies.
};

/// One value a tick that counts.
struct PhaseSeries {
  std::vector<double> x_m, y_m, height_m, speed_m_s, yaw_rad, velocity_error_m_s;
  std::vector<double> speed_x_m_s, speed_y_m_s;  ///< Sizes of the velocity along the axes of `map`.
};

/// Collects the ticks of one phase, and computes its figures from the truth.
class PhaseRecorder {
 public:
  explicit PhaseRecorder(PhaseConfig config) : config_(std::move(config)) {}

  /// Call at every snapshot: what the vehicle does from now on.
  void world(const common::World& world);
  /// Call at every control tick in the air.
  void tick(const PhaseTick& tick);
  /// Call instead of tick() while the vehicle stands: the floor holds it, not its controller, so it is in no phase.
  void stand() { course_.since.reset(); }

  /// As tick(), at an instant that counts whatever the vehicle does.
  void tickInPhase(const PhaseTick& tick);

  PhaseScore finish() const;

 private:
  /// When the phase lasts, how far the vehicle is off the pose at which it began, and until when it was far off.
  struct Course {
    std::optional<common::Time> since, last;  ///< First tick of the phase, and the last one that counts.
    double time_s = 0.0;
    double yaw_begin_rad = 0.0;
    double yaw_off_max_rad = 0.0;               ///< From yaw_begin_rad, of the ticks that count.
    double place_last_off_s = 0.0;              ///< Time from `since` at which the place was last off by kReturned_m.
    double yaw_last_off_s = 0.0;                ///< The same for the yaw and kReturned_rad.
    std::optional<double> control_error_max_m;  ///< Reference less estimate, in space.

    /// The errors with which Grzonka 2012 holds place and yaw (V-D): nearer, the vehicle is back.
    static constexpr double kReturned_m = 0.2;
    static constexpr double kReturned_rad = 2.0 * common::kRadPerDeg;
  };

  std::optional<Eigen::Vector3d> trueVelocityAt(common::Time time) const;
  void follow(const PhaseTick& tick);
  void addPlaces(PhaseFigures& figures) const;
  void addBounds(PhaseFigures& figures) const;
  void addLevels(PhaseFigures& figures) const;

  PhaseConfig config_;
  bool in_phase_ = false;  ///< By the last snapshot.
  Course course_;
  std::deque<std::pair<common::Time, Eigen::Vector3d>> true_velocities_m_s_;  ///< Of the last ticks, in `map`.
  PhaseSeries series_;
  std::vector<double> level_heights_m_;  ///< Of the last map in the phase, ascending.
};

}  // namespace swiftlet::evaluation

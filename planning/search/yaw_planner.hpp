// The second step of planning (Grzonka 2012, section IV-E): the path in the plane is given a yaw along its whole length
// by trading the costs of turning for those of flying sideways or backwards. Short moves are flown without a turn, long
// ones with the nose ahead, and the nose is where a goal wants it when the vehicle arrives.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "common/facing.hpp"

namespace swiftlet::planning {

/// By what the vehicle sees where it flies. The fields are centred on the nose.
struct ViewAhead {
  double laser_half_field_rad = 2.356;
  std::optional<double> camera_half_field_rad;  ///< Horizontal; nullopt without a camera.
  double hull_radius_m = 0.275;
};

struct YawTask {
  double yaw_rad = 0.0;                ///< At the start.
  std::optional<double> goal_yaw_rad;  ///< At the end; nullopt: any.
  double start_speed_m_s = 0.0;
  double speed_m_s = 1.0;
  double acceleration_m_s2 = 1.0;
  double yaw_rate_rad_s = 1.0;
};

/// Immutable.
class YawPlanner {
 public:
  explicit YawPlanner(const ViewAhead& view);

  /// The cheapest yaws along the path, from the start to the end. Empty for a path that is shorter than kLeast_m in the
  /// plane, on which the vehicle only turns to its goal. The time it takes grows with the length of the path, up to
  /// kMostPlaces places.
  std::vector<common::Facing> plan(const std::vector<Eigen::Vector2d>& points_m, const YawTask& task) const;

  static constexpr double kLeast_m = 0.05;
  static constexpr int kMostPlaces = 300;

  // What plan() is made of.

  /// A place of the path and the stretch from it to the next one. All courses are in the frame of the path.
  struct Place {
    Eigen::Vector2d place_m;
    double length_m = 0.0;    ///< Of the stretch; zero at the end.
    double course_rad = 0.0;  ///< Of the stretch; at the end of the one before.
    double ahead_rad = 0.0;   ///< The course towards what comes next, rounded at corners.
    double speed_m_s = 0.0;   ///< At which the stretch is flown where the nose lets it.
  };
  static std::vector<Place> placesAlong(const std::vector<Eigen::Vector2d>& points_m, const YawTask& task);

  /// The yaws among which the plan chooses at a place: the course ahead, that of the goal, and all round in steps.
  static std::vector<double> choices(const Place& place, const YawTask& task);

  /// A stretch flown while the nose turns from one yaw to another.
  struct Step {
    double time_s = 0.0;
    double cost_s = 0.0;
  };
  Step step(const Place& from, double from_yaw_rad, double to_yaw_rad, const YawTask& task) const;

  /// What a metre costs, in seconds, with the nose so far off the course.
  double viewCost_s_m(double off_rad) const;
  /// The laser does not see all of the way that the hull takes.
  bool fliesBlind(double off_rad) const;

 private:
  struct View {
    double cost_s_m;
    bool blind;
  };
  View viewOf(double off_rad) const;
  static Step stepOf(const Place& from, double turn_rad, const View& begins, const View& ends, const YawTask& task);

  double seen_rad_;                        ///< Up to this far off the nose the laser sees the way of the hull.
  std::array<double, 182> view_cost_s_m_;  ///< By whole degrees off the course.
};

}  // namespace swiftlet::planning

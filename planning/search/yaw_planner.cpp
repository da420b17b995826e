#include "planning/search/yaw_planner.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "common/geometry.hpp"

namespace swiftlet::planning {
namespace {

using Point = Eigen::Vector2d;
using std::numbers::pi;

constexpr int kYawChoices = 36;  ///< All round, in steps of 10 deg.
constexpr double kYawChoice_rad = 2.0 * pi / kYawChoices;
/// The share of the yaw rate that is planned with: the rest makes up for the yaw's acceleration.
constexpr double kShareOfRate = 0.9;
/// Between places the nose turns by one direction at full speed.
constexpr double kLeastStretch_m = 0.05, kMostStretch_m = 0.3;
constexpr double kCourseAhead_m = 0.5;   ///< The course ahead is that to a point so far on: corners are turned in time.
constexpr double kLeastSpeed_m_s = 0.1;  ///< At the ends of a path, where the speed goes to zero.

/// A metre flown towards what the laser does not see is worth this many seconds; towards what a camera does not see, in
/// whose place the laser still brakes, this many.
constexpr double kUnseen_s_m = 2.0, kUnfilmed_s_m = 2.0;
/// The nose leads: a plan is often replaced while it is flown, and from a nose ahead the way of the next is in view.
constexpr double kOffCourse_s_m = 0.5;
/// A radian of turning costs a third of the time that it takes: pictures and scans of a turning vehicle are worse.
constexpr double kTurn_s_rad = 0.3;
/// As fast as the vehicle flies where its laser does not see the way: it stops within 0.02 m, a fifth of its clearance.
constexpr double kBlindSpeed_m_s = 0.15;
/// The way of the hull and its clearance must be seen from this distance on, in which the vehicle reacts and brakes.
constexpr double kSeenFrom_m = 0.65, kBeside_m = 0.10;

/// The share of all that may come towards the course that a field of view so far off it does not see. What comes from a
/// direction counts by how fast it closes: as the cosine of its angle to the course.
double unseenShare(double half_field_rad, double off_rad) {
  if (half_field_rad >= pi) return 0.0;
  double seen = 0.0;
  for (const double turn_rad : {-2.0 * pi, 0.0, 2.0 * pi}) {
    const double from_rad = std::max(off_rad - half_field_rad + turn_rad, -0.5 * pi);
    const double to_rad = std::min(off_rad + half_field_rad + turn_rad, 0.5 * pi);
    if (to_rad > from_rad) seen += std::sin(to_rad) - std::sin(from_rad);
  }
  return std::max(0.0, 1.0 - 0.5 * seen);
}

double courseOf(const Point& step) { return std::atan2(step.y(), step.x()); }

/// A polyline by the distance along it.
class PathLine {
 public:
  explicit PathLine(const std::vector<Point>& points_m) : points_m_(points_m) {
    for (std::size_t i = 1; i < points_m.size(); ++i)
      along_m_.push_back(along_m_.back() + (points_m[i] - points_m[i - 1]).norm());
  }
  double length_m() const { return along_m_.back(); }
  Point at(double distance_m) const {
    if (points_m_.size() < 2 || distance_m >= length_m()) return points_m_.back();
    const auto next = std::upper_bound(along_m_.begin(), along_m_.end(), std::max(0.0, distance_m)) - along_m_.begin();
    const auto i = static_cast<std::size_t>(next);
    const double share = (distance_m - along_m_[i - 1]) / (along_m_[i] - along_m_[i - 1]);
    return points_m_[i - 1] + share * (points_m_[i] - points_m_[i - 1]);
  }

 private:
  const std::vector<Point>& points_m_;
  std::vector<double> along_m_{0.0};
};

}  // namespace

YawPlanner::YawPlanner(const ViewAhead& view) {
  const double hull_rad = std::asin(std::min(1.0, (view.hull_radius_m + kBeside_m) / kSeenFrom_m));
  seen_rad_ = view.laser_half_field_rad >= pi ? pi : view.laser_half_field_rad - hull_rad;
  for (std::size_t degree = 0; degree < view_cost_s_m_.size(); ++degree) {
    const double off_rad = static_cast<double>(degree) * common::kRadPerDeg;
    double cost_s_m = kUnseen_s_m * unseenShare(view.laser_half_field_rad, off_rad);
    // Even ahead the camera leaves most unseen: what it sees less than there.
    if (const auto& half_rad = view.camera_half_field_rad)
      cost_s_m += kUnfilmed_s_m * (unseenShare(*half_rad, off_rad) - unseenShare(*half_rad, 0.0));
    view_cost_s_m_[degree] = cost_s_m + kOffCourse_s_m * (1.0 - std::cos(off_rad));
  }
}

double YawPlanner::viewCost_s_m(double off_rad) const {
  const double degrees = std::min(180.0, std::abs(common::wrapAngle(off_rad)) / common::kRadPerDeg);
  const auto whole = static_cast<std::size_t>(degrees);
  const double share = degrees - static_cast<double>(whole);
  return (1.0 - share) * view_cost_s_m_[whole] + share * view_cost_s_m_[whole + 1];
}

bool YawPlanner::fliesBlind(double off_rad) const { return std::abs(common::wrapAngle(off_rad)) > seen_rad_; }

std::vector<YawPlanner::Place> YawPlanner::placesAlong(const std::vector<Point>& points_m, const YawTask& task) {
  std::vector<Place> places;
  if (points_m.empty()) return places;
  const PathLine line(points_m);
  const double length_m = line.length_m();
  if (length_m < kLeast_m) return places;
  const double stretch_m = std::clamp(task.speed_m_s * kYawChoice_rad / (kShareOfRate * task.yaw_rate_rad_s),
                                      kLeastStretch_m, kMostStretch_m);
  const int stretches = std::clamp(static_cast<int>(length_m / stretch_m), 1, kMostPlaces - 1);
  const double each_m = length_m / stretches;
  // Towards a place nearer than this there is no direction.
  constexpr double kNear_m = 1e-3;
  for (int i = 0; i <= stretches; ++i) {
    const double along_m = i * each_m;
    Place place;
    place.place_m = line.at(along_m);
    const Point step = line.at(along_m + each_m) - place.place_m,
                ahead = line.at(along_m + kCourseAhead_m) - place.place_m;
    const double before_rad = places.empty() ? courseOf(points_m.back() - points_m.front()) : places.back().course_rad;
    place.course_rad = i < stretches && step.norm() > kNear_m ? courseOf(step) : before_rad;
    place.ahead_rad = i < stretches && ahead.norm() > kNear_m ? courseOf(ahead) : place.course_rad;
    place.length_m = i < stretches ? each_m : 0.0;
    const double middle_m = along_m + 0.5 * each_m, twice = 2.0 * task.acceleration_m_s2;
    const double gained = std::sqrt(task.start_speed_m_s * task.start_speed_m_s + twice * middle_m);
    const double left = std::sqrt(twice * std::max(0.0, length_m - middle_m));
    place.speed_m_s = std::max(std::min(kLeastSpeed_m_s, task.speed_m_s), std::min({task.speed_m_s, gained, left}));
    places.push_back(place);
  }
  return places;
}

std::vector<double> YawPlanner::choices(const Place& place, const YawTask& task) {
  std::vector<double> yaws_rad{place.ahead_rad, task.goal_yaw_rad.value_or(task.yaw_rad)};
  for (int i = 0; i < kYawChoices; ++i) yaws_rad.push_back(task.yaw_rad + i * kYawChoice_rad);
  return yaws_rad;
}

YawPlanner::View YawPlanner::viewOf(double off_rad) const { return {viewCost_s_m(off_rad), fliesBlind(off_rad)}; }

YawPlanner::Step YawPlanner::step(const Place& from, double from_yaw_rad, double to_yaw_rad,
                                  const YawTask& task) const {
  return stepOf(from, std::abs(common::wrapAngle(to_yaw_rad - from_yaw_rad)), viewOf(from_yaw_rad - from.course_rad),
                viewOf(to_yaw_rad - from.course_rad), task);
}

YawPlanner::Step YawPlanner::stepOf(const Place& from, double turn_rad, const View& begins, const View& ends,
                                    const YawTask& task) {
  const double speed_m_s = begins.blind || ends.blind ? std::min(kBlindSpeed_m_s, from.speed_m_s) : from.speed_m_s;
  Step step;
  step.time_s = std::max(from.length_m / speed_m_s, turn_rad / (kShareOfRate * task.yaw_rate_rad_s));
  step.cost_s = step.time_s + kTurn_s_rad * turn_rad + 0.5 * from.length_m * (begins.cost_s_m + ends.cost_s_m);
  return step;
}

std::vector<common::Facing> YawPlanner::plan(const std::vector<Point>& points_m, const YawTask& task) const {
  const std::vector<Place> places = placesAlong(points_m, task);
  if (places.empty()) return {};
  // Bellman: the least cost of each choice at a place follows from those at the place before.
  struct Reached {
    double yaw_rad = 0.0;
    double cost_s = std::numeric_limits<double>::infinity();
    std::size_t before = 0;
  };
  std::vector<std::vector<Reached>> reached{{{common::wrapAngle(task.yaw_rad), 0.0, 0}}};
  std::vector<View> ends;
  for (std::size_t i = 1; i < places.size(); ++i) {
    const Place& from = places[i - 1];
    const bool arrives = i + 1 == places.size() && task.goal_yaw_rad;
    std::vector<Reached> here;
    ends.clear();
    for (const double yaw_rad : arrives ? std::vector{*task.goal_yaw_rad} : choices(places[i], task)) {
      here.push_back({common::wrapAngle(yaw_rad)});
      ends.push_back(viewOf(yaw_rad - from.course_rad));
    }
    for (std::size_t before = 0; before < reached.back().size(); ++before) {
      const Reached& one = reached.back()[before];
      const View begins = viewOf(one.yaw_rad - from.course_rad);
      for (std::size_t k = 0; k < here.size(); ++k) {
        const double difference_rad = std::abs(here[k].yaw_rad - one.yaw_rad);
        const double turn_rad = std::min(difference_rad, 2.0 * pi - difference_rad);
        const double cost_s = one.cost_s + stepOf(from, turn_rad, begins, ends[k], task).cost_s;
        if (cost_s >= here[k].cost_s) continue;
        here[k].cost_s = cost_s;
        here[k].before = before;
      }
    }
    reached.push_back(std::move(here));
  }
  std::vector<common::Facing> facings(places.size());
  const auto& last = reached.back();
  auto at = static_cast<std::size_t>(
      std::min_element(last.begin(), last.end(), [](const auto& a, const auto& b) { return a.cost_s < b.cost_s; }) -
      last.begin());
  for (std::size_t i = places.size(); i-- > 0; at = reached[i][at].before) {
    facings[i].place_m = places[i].place_m;
    facings[i].yaw_rad = reached[i][at].yaw_rad;
    if (i + 1 == places.size()) continue;
    const double course_rad = places[i].course_rad;
    if (fliesBlind(facings[i].yaw_rad - course_rad) || fliesBlind(facings[i + 1].yaw_rad - course_rad))
      facings[i].speed_m_s = kBlindSpeed_m_s;
  }
  return facings;
}

}  // namespace swiftlet::planning

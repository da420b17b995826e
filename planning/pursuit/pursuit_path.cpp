#include "planning/pursuit/pursuit_path.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include "common/row_major.hpp"
#include "planning/search/planner.hpp"

namespace swiftlet::planning {
namespace {

using Point = Eigen::Vector2d;

/// Four seconds: at the 0.73 m/s of the default profile the vehicle flies 2.9 m, which is round the corner of a box or
/// a door frame from the distance that it keeps. Persons turn every few seconds, so that later steps would be guesses.
constexpr int kSteps = 8;
constexpr double kMove_s = 0.5;
/// Steps that are flown before there is another answer, with what it takes to stop: 2 s are the latency of planning,
/// 0.9 s to brake from 0.73 m/s at 0.8 m/s2, and some time between answers. It waits if it would wait for half of that.
constexpr std::size_t kFlown = 4, kWaits = 2;
/// Places in each direction: as many as the vehicle can reach, and here itself.
constexpr int kReach = kSteps, kSide = 2 * kReach + 1;
constexpr std::size_t kGridPlaces = static_cast<std::size_t>(kSide) * kSide;
/// Losses of a step in which the person is not seen, and of one at a wrong distance: both count alike.
constexpr double kUnseen = 1.0, kWrongDistance = 1.0;
/// Further loss of a wrong distance by the metre; twice as much where it is too small.
constexpr double kPerMetre = 1.0;
/// Loss of a right distance by its squared error.
constexpr double kPerSquareMetre = 0.3;
/// Loss of flying for one step, so that the vehicle waits where waiting is equally good.
constexpr double kPerMove = 0.03;
/// Loss by the cost of a step in the cost map above that of open space.
constexpr double kPerCost = 0.02;
/// Beyond twice the wanted distance a person is too far away; rays that long need not be followed.
constexpr double kBeyondUse = 2.0;
/// Steps of a walk between two looks at the map: two of its cells.
constexpr double kStride_m = 0.1;
constexpr double kNever = std::numeric_limits<double>::infinity();

/// Where the person may be at the end of each step.
using Walk = std::array<Point, kSteps + 1>;

class Pursuit {
 public:
  explicit Pursuit(const PursuitQuestion& question)
      : ask_(question),
        escape_map_m_(escapePoints_map_m(question.costs, question.here_map_m)),
        from_map_m_(escape_map_m_.back()),
        side_m_(std::max(0.1, question.speed_m_s * kMove_s / std::numbers::sqrt2)) {
    for (const common::PossibleWalk& walk : ask_.walks) {
      walks_.push_back(predicted(walk));
      whole_weight_ += walk.weight;
    }
  }

  PursuitPath best();

 private:
  struct Sight {
    double loss = 0.0;
    double in_sight = 0.0;
  };

  static std::size_t at(int x, int y) { return common::rowMajor(y + kReach, kSide, x + kReach); }
  Point placeOf(int x, int y) const { return from_map_m_ + side_m_ * Point(x, y); }
  /// By something else than the person.
  bool occupied(const Point& point_map_m) const {
    if (!common::occupancy::isOccupied(ask_.grid.at(ask_.grid.cellAt(point_map_m)))) return false;
    const auto& walked = ask_.walked_map_m;
    return std::none_of(walked.begin(), walked.end(),
                        [&](const Point& place) { return (place - point_map_m).norm() < common::kPersonInMap_m; });
  }
  Walk predicted(const common::PossibleWalk& walk) const;
  bool sees(const Point& from_map_m, const Point& to_map_m) const;
  Sight from(const Point& place_map_m, int step) const;
  double moving(int x, int y, int dx, int dy) const;
  void advance(int step);
  PursuitPath pathTo(int x, int y) const;

  const PursuitQuestion& ask_;
  std::vector<Point> escape_map_m_;  ///< From here to `from_map_m_`.
  Point from_map_m_;                 ///< Here, or the place at the end of the escape.
  double side_m_;
  std::vector<Walk> walks_;
  double whole_weight_ = 0.0;
  struct Step {
    std::array<double, kGridPlaces> loss;
    std::array<std::uint8_t, kGridPlaces> came_from;  ///< 3 (dy + 1) + dx + 1 of the move.
  };
  std::array<Step, kSteps + 1> steps_;
};

/// The person walks straight on and stops at what the map shows.
Walk Pursuit::predicted(const common::PossibleWalk& walk) const {
  Walk places;
  places.fill(walk.place_map_m);
  const double speed_m_s = walk.velocity_map_m_s.norm();
  if (speed_m_s < 1e-3) return places;
  const Point heading = walk.velocity_map_m_s / speed_m_s;
  double walked_m = 0.0;
  for (int step = 1; step <= kSteps; ++step) {
    const double until_m = speed_m_s * kMove_s * step;
    while (walked_m < until_m) {
      const double next_m = std::min(until_m, walked_m + kStride_m);
      if (occupied(walk.place_map_m + (next_m + common::kPersonHalfWidth_m) * heading)) break;
      walked_m = next_m;
    }
    places[static_cast<std::size_t>(step)] = walk.place_map_m + walked_m * heading;
  }
  return places;
}

bool Pursuit::sees(const Point& from_map_m, const Point& to_map_m) const {
  const Point ray_m = to_map_m - from_map_m;
  const double length_m = ray_m.norm(), step_m = ask_.grid.resolution_m();
  for (double along_m = step_m; along_m < length_m - common::kPersonInMap_m; along_m += step_m) {
    if (occupied(from_map_m + along_m / length_m * ray_m)) return false;
  }
  return true;
}

Pursuit::Sight Pursuit::from(const Point& place_map_m, int step) const {
  const double least_m = ask_.distance_m - kPursuitNearer_m, most_m = ask_.distance_m + kPursuitFarther_m;
  Sight sight;
  for (std::size_t i = 0; i < walks_.size(); ++i) {
    const double weight = ask_.walks[i].weight / whole_weight_;
    const Point& person = walks_[i][static_cast<std::size_t>(step)];
    const double distance_m = (person - place_map_m).norm();
    double loss = kPerSquareMetre * std::pow(distance_m - ask_.distance_m, 2);
    if (distance_m < least_m) loss = kWrongDistance + 2.0 * kPerMetre * (least_m - distance_m);
    if (distance_m > most_m) loss = kWrongDistance + kPerMetre * (distance_m - most_m);
    const bool seen = distance_m < kBeyondUse * most_m && sees(place_map_m, person);
    sight.loss += weight * (loss + (seen ? 0.0 : kUnseen));
    sight.in_sight += seen ? weight : 0.0;
  }
  return sight;
}

/// The loss of a move from (x, y) by (dx, dy); never if the hull may not fly there.
double Pursuit::moving(int x, int y, int dx, int dy) const {
  if (dx == 0 && dy == 0) return 0.0;
  const SegmentCost leg = segmentCost(ask_.costs, placeOf(x, y), placeOf(x + dx, y + dy));
  if (leg.lethal) return kNever;
  const double cells = std::hypot(dx, dy);
  return kPerMove * cells + kPerCost * (leg.cost_m / side_m_ - cells);
}

void Pursuit::advance(int step) {
  const Step& before = steps_[static_cast<std::size_t>(step - 1)];
  Step& now = steps_[static_cast<std::size_t>(step)];
  now.loss.fill(kNever);
  const int was = step - 1;
  for (int y = -was; y <= was; ++y)
    for (int x = -was; x <= was; ++x) {
      if (before.loss[at(x, y)] == kNever) continue;
      for (int move = 0; move < 9; ++move) {
        const int dx = move % 3 - 1, dy = move / 3 - 1;
        const double loss = before.loss[at(x, y)] + moving(x, y, dx, dy);
        if (loss >= now.loss[at(x + dx, y + dy)]) continue;
        now.loss[at(x + dx, y + dy)] = loss;
        now.came_from[at(x + dx, y + dy)] = static_cast<std::uint8_t>(move);
      }
    }
  for (int y = -step; y <= step; ++y)
    for (int x = -step; x <= step; ++x)
      if (double& loss = now.loss[at(x, y)]; loss < kNever) loss += from(placeOf(x, y), step).loss;
}

PursuitPath Pursuit::best() {
  steps_[0].loss.fill(kNever);
  steps_[0].loss[at(0, 0)] = 0.0;
  for (int step = 1; step <= kSteps; ++step) advance(step);
  const auto& last = steps_[kSteps].loss;
  const auto least = std::min_element(last.begin(), last.end()) - last.begin();
  return pathTo(static_cast<int>(least) % kSide - kReach, static_cast<int>(least) / kSide - kReach);
}

/// The places on the path that are flown before the next question comes, without those that a straight line leaves out.
PursuitPath Pursuit::pathTo(int x, int y) const {
  const double in_sight = from(placeOf(x, y), kSteps).in_sight;
  std::array<Point, kSteps + 1> by_step;
  for (int step = kSteps; step >= 0; --step) {
    by_step[static_cast<std::size_t>(step)] = placeOf(x, y);
    if (step == 0) break;
    const int move = steps_[static_cast<std::size_t>(step)].came_from[at(x, y)];
    x -= move % 3 - 1;
    y -= move / 3 - 1;
  }
  std::vector<Point> places{by_step[0]};
  if (by_step[kWaits] != by_step[0])
    for (std::size_t step = 1; step <= kFlown; ++step)
      if (by_step[step] != places.back()) places.push_back(by_step[step]);
  std::vector<Point> points_map_m = escape_map_m_;
  for (std::size_t i = 0; i + 1 < places.size();) {
    std::size_t next = i + 1;
    while (next + 1 < places.size() && !segmentCost(ask_.costs, places[i], places[next + 1]).lethal) ++next;
    points_map_m.push_back(places[next]);
    i = next;
  }
  return {pathThrough(ask_.costs, std::move(points_map_m), escape_map_m_.size() - 1), in_sight};
}

}  // namespace

PursuitPath pursuitPath(const PursuitQuestion& question) { return Pursuit(question).best(); }

}  // namespace swiftlet::planning

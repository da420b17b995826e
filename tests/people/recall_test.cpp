// How soon, and for how much of the time, the people in the laser's field are tracked: a hall with six people who walk,
// a laser with its noise on a vehicle that flies and tilts, a map drawn as in flight, and the truth of who is where.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "common/quantile.hpp"
#include "perception/people/people_tracker.hpp"
#include "perception/slam2d/sliced_map.hpp"
#include "simulation/sensors/laser_scanner.hpp"
#include "simulation/walkers.hpp"
#include "tests/simulation/fixtures.hpp"

namespace swiftlet::perception {
namespace {

using common::Pose2;
using common::Pose3;
using common::Time;
using Point = Eigen::Vector2d;

constexpr double kScan_s = 0.025;
/// As in perception/slam2d/slam2d.cpp: a scan is drawn after that distance, turn or time.
constexpr double kDrawDistance_m = 0.10, kDrawRotation_rad = 6.0 * common::kRadPerDeg, kDrawTime_s = 0.25;
/// A person farther away cannot reach the vehicle within two seconds, and has few beams.
constexpr double kNear_m = 4.0;
/// Beams on a person from which on the person is in view.
constexpr int kLeastBeams = 5;
/// A track this near to the middle of a person is the person's.
constexpr double kSame_m = 0.5;

simulation::WorldModel hall() {
  simulation::WorldModel world;
  world.file = "hall.sdf";
  const auto add = [&](const char* name, const Eigen::Vector3d& low, const Eigen::Vector3d& high) {
    world.shapes.push_back(simulation::boxShape(name, low, high));
  };
  add("floor", {-0.2, -0.2, -0.2}, {12.2, 10.2, 0.0});
  add("south", {-0.2, -0.2, 0.0}, {12.2, 0.0, 2.5});
  add("north", {-0.2, 10.0, 0.0}, {12.2, 10.2, 2.5});
  add("west", {-0.2, 0.0, 0.0}, {0.0, 10.0, 2.5});
  add("east", {12.0, 0.0, 0.0}, {12.2, 10.0, 2.5});
  add("block", {3.5, 6.5, 0.0}, {4.5, 7.5, 2.0});
  add("desk", {8.25, 2.7, 0.0}, {9.75, 3.3, 2.0});
  add("pillar", {5.75, 4.75, 0.0}, {6.25, 5.25, 2.5});
  return world;
}

std::vector<simulation::WalkerConfig> sixPeople() {
  const auto path = [](std::vector<double> path_world_m, double speed_m_s) {
    return simulation::WalkerConfig{simulation::WalkerMode::kPath, std::move(path_world_m),
                                    simulation::WalkerEnd::kLoop, speed_m_s};
  };
  return {path({1, 9, 11, 9, 11, 1, 1, 1}, 0.9),   path({11, 5, 1, 5}, 1.1),      path({6, 1, 6, 9}, 0.8),
          path({9.5, 9, 4, 9, 4, 1.2, 4, 9}, 1.2), path({9, 9, 9, 5, 2, 5}, 0.7), path({11, 8, 5, 2}, 1.0)};
}

/// Along a rectangle at 0.4 m/s, tilted now here, now there, as a vehicle that is steered.
Pose3 poseAt(double time_s, double tilt_rad) {
  const std::vector<Point> corners{{2.0, 2.0}, {10.0, 2.0}, {10.0, 7.0}, {2.0, 7.0}};
  double along_m = std::fmod(0.4 * time_s, 26.0), yaw_rad = 0.0;
  Point place = corners.front();
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Point leg = corners[(i + 1) % corners.size()] - corners[i];
    place = corners[i] + std::min(along_m, leg.norm()) * leg.normalized();
    yaw_rad = std::atan2(leg.y(), leg.x());
    if (along_m <= leg.norm()) break;
    along_m -= leg.norm();
  }
  Pose3 pose;
  pose.position_m = {place.x(), place.y(), 1.0};
  pose.rotation = Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ()) *
                  Eigen::AngleAxisd(tilt_rad * std::sin(2.1 * time_s), Eigen::Vector3d::UnitY()) *
                  Eigen::AngleAxisd(tilt_rad * std::sin(1.3 * time_s), Eigen::Vector3d::UnitX());
  return pose;
}

/// Who is in view, and since when and for how long untracked.
struct Watched {
  std::optional<Time> in_view, tracked;
  Time last_view;
};

struct Recall {
  int scans = 0, tracked = 0, right_course = 0;  ///< Of people in view for half a second.
  std::vector<double> until_tracked_s;           ///< Of each who came into view.
  int false_walkers = 0;                         ///< Tracks that move where nobody is, summed over the scans.
};

class Hall {
 public:
  explicit Hall(double tilt_rad) : tilt_rad_(tilt_rad), world_(hall()), rays_(world_), scanner_(laser_, 7) {
    const auto people = sixPeople();
    for (std::size_t i = 0; i < people.size(); ++i) walkers_.emplace_back(people[i], 7, i, 0.0, 0.275, rays_);
    watched_.resize(people.size());
  }

  Recall watch(double seconds) {
    for (std::uint64_t frame = 0; static_cast<double>(frame) * kScan_s < seconds; ++frame) step(frame);
    return recall_;
  }

 private:
  std::vector<simulation::Actor> people() const {
    std::vector<simulation::Actor> actors;
    for (const auto& walker : walkers_)
      if (walker.actor()) actors.push_back(*walker.actor());
    return actors;
  }

  void step(std::uint64_t frame) {
    const double time_s = static_cast<double>(frame) * kScan_s;
    const Time now = Time::fromSeconds(time_s);
    std::vector<Point> before;
    for (const auto& actor : people()) before.push_back(actor.position_world_m);
    for (auto& walker : walkers_) walker.step(now, {}, kScan_s);
    const auto actors = people();
    const std::vector<simulation::Moment> track{
        {now, poseAt(time_s, tilt_rad_), actors},
        {now + common::Duration::fromSeconds(kScan_s), poseAt(time_s + kScan_s, tilt_rad_), actors}};
    const ProjectedScan scan = project(
        scanner_.scan(frame, now, track, rays_), laser_, [&](Time t) { return poseAt(t.seconds(), tilt_rad_); },
        projection_);
    const Pose2 T_map_body = common::planar(poseAt(scan.stamp.seconds(), tilt_rad_));
    draw(scan, T_map_body);
    tracker_.update(scan, T_map_body, {}, grid_);
    for (std::size_t i = 0; i < actors.size(); ++i)
      judge(now, scan, T_map_body, actors[i],
            before.size() > i ? Point((actors[i].position_world_m - before[i]) / kScan_s) : Point(0, 0), watched_[i]);
    for (const auto& o : tracker_.obstacles())
      recall_.false_walkers +=
          o.moving && o.last_seen == scan.stamp && std::ranges::none_of(actors, [&](const auto& actor) {
            return (actor.position_world_m - o.center_map_m).norm() < 2.0 * kSame_m;
          });
  }

  void draw(const ProjectedScan& scan, const Pose2& T_map_body) {
    const Pose2 moved = drawn_pose_.inverse() * T_map_body;
    if (grid_ && moved.position_m().norm() < kDrawDistance_m && std::abs(moved.yaw_rad) < kDrawRotation_rad &&
        (scan.stamp - drawn_).seconds() < kDrawTime_s)
      return;
    ProjectedScan marked = scan;
    markPeople(tracker_.movingAt(scan.stamp), T_map_body, marked);
    map_.draw(thinForDrawing(withoutWalkers(tracker_.walkersAt(scan.stamp), T_map_body, marked), drawing_), T_map_body);
    grid_ = std::make_shared<common::OccupancyGrid>(map_.atFlightHeight());
    drawn_ = scan.stamp;
    drawn_pose_ = T_map_body;
  }

  void judge(Time now, const ProjectedScan& scan, const Pose2& T_map_body, const simulation::Actor& actor,
             const Point& velocity_m_s, Watched& watched) {
    constexpr double kGone_s = 0.5, kNoticed_s = 0.5;
    const Point place_level = T_map_body.inverse() * actor.position_world_m;
    const auto beams = std::ranges::count_if(scan.points_level_m, [&](const Eigen::Vector2f& p) {
      return (p.cast<double>() - place_level).norm() < actor.radius_m + 0.08;
    });
    const double distance_m = place_level.norm();
    if (beams < kLeastBeams || distance_m > kNear_m || distance_m < 0.6) {
      if (watched.in_view && (now - watched.last_view).seconds() > kGone_s) leave(watched);
      return;
    }
    if (!watched.in_view) watched.in_view = now;
    watched.last_view = now;
    const common::DynamicObstacle* found = nullptr;
    for (const auto& o : tracker_.obstacles())
      if (o.moving && (now - o.last_seen).seconds() < 0.1 && (o.center_map_m - actor.position_world_m).norm() < kSame_m)
        found = &o;
    if (found != nullptr && !watched.tracked) watched.tracked = now;
    if ((now - *watched.in_view).seconds() < kNoticed_s) return;
    ++recall_.scans;
    recall_.tracked += found != nullptr;
    recall_.right_course += found != nullptr && (found->velocity_map_m_s - velocity_m_s).norm() < 0.5;
  }

  void leave(Watched& watched) {
    const double seen_s = (watched.last_view - *watched.in_view).seconds();
    recall_.until_tracked_s.push_back(watched.tracked ? (*watched.tracked - *watched.in_view).seconds() : seen_s);
    watched = {};
  }

  double tilt_rad_;
  common::LaserConfig laser_;
  ScanProjectionConfig projection_;
  GridDrawingConfig drawing_;
  simulation::WorldModel world_;
  simulation::RayCaster rays_;
  simulation::LaserScanner scanner_;
  std::vector<simulation::Walker> walkers_;
  SlicedMap map_{drawing_};
  std::shared_ptr<const common::OccupancyGrid> grid_;
  Time drawn_;
  Pose2 drawn_pose_;
  PeopleTracker tracker_{HeightBand{}};
  std::vector<Watched> watched_;
  Recall recall_;
};

/// The people of the field case walk through the pillar, and come out of it: near it nobody can be told from it.
TEST(PeopleRecall, SixPeopleInAHallByTheTiltOfTheVehicle) {
  const std::vector<std::pair<double, double>> asked{{0.0, 0.88}, {1.0, 0.87}, {2.0, 0.82}};
  for (const auto& [tilt_deg, least_share] : asked) {
    const Recall recall = Hall(tilt_deg * common::kRadPerDeg).watch(90.0);
    const auto share = [&](int count) { return static_cast<double>(count) / recall.scans; };
    const auto until = [&](double q) { return common::quantile(recall.until_tracked_s, q); };
    std::printf(
        "%.0f deg: tracked %.3f, with its velocity %.3f of %d; until then %.2f s, p90 %.2f s, of %zu; false %d\n",
        tilt_deg, share(recall.tracked), share(recall.right_course), recall.scans, until(0.5), until(0.9),
        recall.until_tracked_s.size(), recall.false_walkers);
    EXPECT_GT(share(recall.tracked), least_share) << tilt_deg;
    EXPECT_LT(until(0.9), 1.0) << tilt_deg;
    EXPECT_EQ(recall.false_walkers, 0) << tilt_deg;
  }
}

}  // namespace
}  // namespace swiftlet::perception

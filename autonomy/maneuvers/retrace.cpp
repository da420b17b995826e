// Retrace: flies back along a path that was flown before. It needs no map and no plan, so it works where the map or the
// position is unreliable; the reactive layer brakes as everywhere. It fails before a keep-out zone that was made
// after the trail, and where an obstacle stays for long.
#include <algorithm>
#include <cmath>
#include <iterator>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <fmt/format.h>

#include "autonomy/maneuvers/maneuver.hpp"
#include "autonomy/maneuvers/path_flight.hpp"
#include "autonomy/maneuvers/patience.hpp"
#include "autonomy/maneuvers/table.hpp"
#include "common/segment.hpp"

namespace swiftlet::autonomy {
namespace {

constexpr common::FlightMode kMode = common::FlightMode::kCareful;

/// The same path with fewer corners; none of the points left out is further than kWithin_m from it. A trail has every
/// small motion of a hover; flown point by point the vehicle would turn with each of them instead of looking where it
/// came from.
std::vector<Eigen::Vector2d> straightened(const std::vector<Eigen::Vector2d>& path) {
  constexpr double kWithin_m = 0.06, kLongest_m = 1.0;  // A trail is passable only near itself.
  std::vector<Eigen::Vector2d> corners;
  for (std::size_t from = 0; from < path.size();) {
    corners.push_back(path[from]);
    std::size_t to = from + 1;
    const auto straightTo = [&](std::size_t end) {
      if ((path[end] - path[from]).norm() > kLongest_m) return false;
      return std::all_of(path.begin() + from + 1, path.begin() + end, [&](const Eigen::Vector2d& between) {
        return common::segmentDistance(between, path[from], path[end]) < kWithin_m;
      });
    };
    while (to + 1 < path.size() && straightTo(to + 1)) ++to;
    from = to;
  }
  return corners;
}

class Retrace final : public Maneuver {
 public:
  /// The intent's lost_on_the_way_to_map_m is remembered, so that exploring leaves it.
  Retrace(const common::RetraceIntent& intent, const ManeuverSetup& setup);
  Progress step(const ManeuverInput& input) override;
  Aim aim(const common::VehicleState& state) const override;

 private:
  std::span<const Eigen::Vector2d> remaining(const Eigen::Vector2d& from_map_m) const;
  void follow(const ManeuverInput& input);
  Eigen::Vector3d atItsHeight(const Eigen::Vector2d& point_map_m) const;
  bool isStuck(const ManeuverInput& input);
  void keepOut(const std::vector<common::Polygon>& zones);

  ManeuverSetup setup_;
  common::RetraceIntent intent_;
  bool following_ = false;
  bool cut_ = false;  ///< The path was cut before a keep-out zone.
  struct Moved {
    common::Time at;
    Eigen::Vector2d to_map_m;
  };
  std::optional<Moved> moved_;  ///< When it last got on.
};

Retrace::Retrace(const common::RetraceIntent& intent, const ManeuverSetup& setup) : setup_(setup), intent_(intent) {
  if (intent.lost_on_the_way_to_map_m) setup_.memory.lost_map_m.push_back(*intent.lost_on_the_way_to_map_m);
}

Progress Retrace::step(const ManeuverInput& input) {
  if (setup_.controller.state() != common::FlightState::kFlying) return cannot("fly back", setup_.controller);
  if (setup_.retreat.active()) return Progress::running();
  if (intent_.path_map_m.empty()) return Progress::done("it is there already");
  if (input.keep_out) keepOut(*input.keep_out);
  if (following_ && setup_.controller.follower().finished())
    return cut_ ? Progress::failed("stopped before a keep-out zone") : Progress::done("back where it came from");
  if (isStuck(input))
    return Progress::failed(fmt::format("something is in the way for {:.0f} s", (input.now - moved_->at).seconds()));
  if (!setup_.controller.follower().followsPath()) follow(input);
  return Progress::running("flying back along the trail");
}

/// Without a plan there is no detour: an obstacle on the trail, a closed door for example, stops the vehicle as long as
/// the charge allows. A vehicle that does not know its place does not wait: it drifts.
bool Retrace::isStuck(const ManeuverInput& input) {
  constexpr double kMoved_m = 0.3;  // More than a hover sways.
  if (!moved_ || (input.position_map_m() - moved_->to_map_m).norm() > kMoved_m)
    moved_ = Moved{input.now, input.position_map_m()};
  const bool waits = input.spare_s > 0.0 && input.state.horizontal_valid && input.drift_m <= ManeuverInput::kKnown_m;
  return !waits && (input.now - moved_->at).seconds() > Patience::kPasses_s;
}

/// A zone may be newer than the trail that leads through it. Of a zone that the vehicle is in, the path leads out.
void Retrace::keepOut(const std::vector<common::Polygon>& zones) {
  auto& path = intent_.path_map_m;
  const double radius_m = setup_.desk.hullRadius_m();
  const auto isIn = [&](const common::Polygon& zone, const Eigen::Vector2d& point) {
    return zone.signedDistance_m(point) < radius_m;
  };
  for (const common::Polygon& zone : zones) {
    const auto out = std::find_if_not(path.begin(), path.end(), [&](const auto& point) { return isIn(zone, point); });
    const auto in = std::find_if(out, path.end(), [&](const auto& point) { return isIn(zone, point); });
    if (in == path.end()) continue;
    path.erase(in, path.end());
    cut_ = true;
    following_ = false;
    setup_.controller.hold();
  }
}

/// A retreat or a lost estimate ends the path; the rest is flown from its nearest place on.
void Retrace::follow(const ManeuverInput& input) {
  auto& path = intent_.path_map_m;
  path.erase(path.begin(), path.end() - std::ssize(remaining(input.position_map_m())));
  control::FlightPath flown;
  flown.mode = kMode;
  for (const Eigen::Vector2d& point : straightened(path)) flown.points_map_m.push_back(atItsHeight(point));
  face(flown, planning::YawPlanner(viewOf(setup_)), setup_.controller, input.state);
  following_ = setup_.controller.follow(flown).has_value();
}

/// Where it flew at another height, below something or through a window, the vehicle is at that height again, from the
/// place on where it had changed it.
Eigen::Vector3d Retrace::atItsHeight(const Eigen::Vector2d& point_map_m) const {
  // As far as the corners of a straightened path are apart.
  constexpr double kNear_m = 1.0;
  const double cruise_m = setup_.memory.cruise_height_m;
  double height_m = cruise_m;
  for (const Eigen::Vector3d& other : setup_.memory.other_heights_map_m)
    if ((other.head<2>() - point_map_m).norm() < kNear_m &&
        std::abs(other.z() - cruise_m) > std::abs(height_m - cruise_m))
      height_m = other.z();
  return {point_map_m.x(), point_map_m.y(), height_m};
}

/// The path from its point nearest to a place on.
std::span<const Eigen::Vector2d> Retrace::remaining(const Eigen::Vector2d& from_map_m) const {
  const auto& path = intent_.path_map_m;
  return {std::min_element(path.begin(), path.end(),
                           [&](const auto& a, const auto& b) {
                             return (a - from_map_m).squaredNorm() < (b - from_map_m).squaredNorm();
                           }),
          path.end()};
}

Aim Retrace::aim(const common::VehicleState& state) const {
  Aim aim;
  if (!intent_.path_map_m.empty()) aim.goal_map_m = intent_.path_map_m.back();
  if (following_ && setup_.controller.follower().followsPath())
    aim.velocity_map_m_s =
        velocityAlong(remaining(state.T_map_body_planar().position_m()), setup_.controller.follower().speed_m_s(kMode));
  return aim;
}

}  // namespace

std::unique_ptr<Maneuver> maneuverFor(const common::RetraceIntent& intent, const ManeuverSetup& setup) {
  return std::make_unique<Retrace>(intent, setup);
}

}  // namespace swiftlet::autonomy

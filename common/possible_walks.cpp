#include "common/possible_walks.hpp"

#include <array>
#include <numbers>

#include <Eigen/Geometry>

#include "common/geometry.hpp"

namespace swiftlet::common {
namespace {

/// Probability that a person goes on as before in the next seconds: straight on, or standing.
constexpr double kGoesOnShare = 0.5;
/// Turns of a person who does not go on straight, and their shares: a bend, and a corner or a turn around.
struct Turn {
  double angle_deg;
  double share;
};
constexpr std::array kTurns{Turn{50.0, 0.3}, Turn{-50.0, 0.3}, Turn{100.0, 0.2}, Turn{-100.0, 0.2}};
/// Directions in which a standing person may set off; others differ from the nearest one by less than half a metre in a
/// second at the speeds of people indoors.
constexpr int kDirectionsFromRest = 6;
/// Speed at which a person who stands is expected to set off.
constexpr double kSetsOff_m_s = 0.5;

}  // namespace

std::vector<PossibleWalk> possibleWalks(const Eigen::Vector2d& place_map_m, const Eigen::Vector2d& velocity_map_m_s) {
  std::vector<PossibleWalk> walks;
  if (velocity_map_m_s.norm() < kStands_m_s) {
    walks.push_back({place_map_m, {0.0, 0.0}, kGoesOnShare});
    for (int i = 0; i < kDirectionsFromRest; ++i) {
      const Eigen::Rotation2Dd turn(2.0 * std::numbers::pi / kDirectionsFromRest * i);
      walks.push_back(
          {place_map_m, turn * Eigen::Vector2d(kSetsOff_m_s, 0.0), (1.0 - kGoesOnShare) / kDirectionsFromRest});
    }
    return walks;
  }
  walks.push_back({place_map_m, velocity_map_m_s, kGoesOnShare});
  for (const Turn& turn : kTurns)
    walks.push_back({place_map_m, Eigen::Rotation2Dd(turn.angle_deg * kRadPerDeg) * velocity_map_m_s,
                     turn.share * (1.0 - kGoesOnShare)});
  return walks;
}

}  // namespace swiftlet::common

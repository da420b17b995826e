// Tour: flies through a series of stations in their order, for maneuvers whose stations are given by a pattern.
// Stations in reach along straight lines are flown in one go; to others the planner finds a path. What cannot be
// reached is left out. A tour that was interrupted, by avoiding an obstacle for example, goes on with the stations that
// it has not passed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "autonomy/maneuvers/path_maneuver.hpp"

namespace swiftlet::autonomy {

/// What a tour has done. It outlives the maneuver, which an interruption ends.
struct TourState {
  enum class StationState { kOpen, kPassed, kLeft };
  struct Station {
    Eigen::Vector2d wanted_map_m, place_map_m;
    StationState state = StationState::kOpen;
    int tries = 0;
  };

  std::uint64_t intent_id = 0;  ///< The newest intent of this tour.
  std::vector<Station> stations;
  bool second_look = false;
};

/// One thread.
///
///   lay the stations --> straight run through the next ones --> at its end: the next run, or a planned path
///        ^                                                          |  no station is open
///        +--- once more, for stations that the map has opened ------+--> done, or failed where none was passed
class Tour : public PathManeuver {
 public:
  Progress answered(const PlanningAnswer& answer, common::Time now, const common::VehicleState& state) override;
  Aim aim(const common::VehicleState& state) const override;

 protected:
  /// A station is passed when nearer than `corner_m`.
  Tour(const ManeuverSetup& setup, std::string purpose, common::FlightMode mode, double corner_m);

  /// The places to fly to, in order; a place that is not free is left out. Called when there is a map, and for those
  /// that were left out a second time.
  virtual std::vector<Eigen::Vector2d> lay(const planning::CostMap& map, const ManeuverInput& input) = 0;
  /// Where the vehicle flies for a place; nullopt: the place is left out. Here: the place itself, if it is free.
  virtual std::optional<Eigen::Vector2d> standFor(const planning::CostMap& map,
                                                  const Eigen::Vector2d& place_map_m) const;
  /// Whether it may fly on from where it is.
  virtual bool ready(const ManeuverInput&) { return true; }
  /// Whether it looks at what it was sent to look at.
  virtual bool inspecting(const ManeuverInput&) const { return false; }
  /// "surveying", for people.
  virtual std::string doing(const ManeuverInput& input) const = 0;

  std::size_t passed() const;

 private:
  using State = TourState::StationState;
  using Station = TourState::Station;

  Progress fly(const ManeuverInput& input) final;
  void open(const planning::CostMap& map);
  void pass(const Eigen::Vector2d& here_map_m);
  void leaveBlocked(const planning::CostMap& map);
  std::optional<std::size_t> next() const;
  void flyOn(const planning::CostMap& map, const ManeuverInput& input, std::size_t station);
  planning::Path straightRun(const planning::CostMap& map, const Eigen::Vector2d& from_map_m, std::size_t first) const;
  Progress ended();

  double corner_m_;
  std::shared_ptr<TourState> state_;
  std::vector<Station>& stations_;    ///< Of `state_`.
  std::optional<std::size_t> asked_;  ///< The station of the requested path.
  std::string no_path_;               ///< Why the last station that was missed was not reached.
};

}  // namespace swiftlet::autonomy

#include "simulated_flight/placed_map.hpp"

#include <system_error>
#include <vector>

#include "common/error.hpp"
#include "evaluation/trajectory_metrics.hpp"
#include "flight/system.hpp"
#include "interfaces/files/required.hpp"
#include "perception/slam2d/laser_slam.hpp"
#include "simulation/ray_caster.hpp"

namespace swiftlet::simulated_flight {
namespace {

/// T_world_given: the rigid fit of the SLAM poses to the driven ones. nullopt if they do not determine a direction.
std::optional<common::Pose2> fitted(const perception::LaserSlam& slam,
                                    const std::vector<perception::TrackedScan>& tracked,
                                    const std::vector<common::Pose2>& driven) {
  const std::vector<common::Pose2> keys = slam.keyPoses();
  std::vector<evaluation::PosePair> pairs;
  for (std::size_t i = 0; i < tracked.size(); ++i) {
    const common::Pose2 estimate = tracked[i].T_map_robot(keys);
    pairs.push_back({{}, common::lifted(estimate, 0.0), common::lifted(driven[i], 0.0)});
  }
  const auto T_world_given = evaluation::align(pairs, evaluation::Alignment::kPlanar);
  if (!T_world_given) return std::nullopt;
  return common::planar(*T_world_given);
}

}  // namespace

PlacedMap surveyedMap(const simulation::SurveyConfig& survey, const simulation::WorldModel& world,
                      const std::filesystem::path& folder) {
  const simulation::RayCaster rays(world);
  simulation::SurveyDrive drive(survey, flight::loadLaser(survey.laser), rays);
  perception::LaserSlam slam{laserSlamOf(flight::loadSystem("laser_log"))};
  std::vector<perception::TrackedScan> tracked;
  std::vector<common::Pose2> driven;
  while (const auto taken = drive.next()) {
    const auto scan = slam.add({taken->scan, {}, std::nullopt});
    if (!scan) continue;
    tracked.push_back(*scan);
    driven.push_back(taken->T_world_body);
  }
  slam.finish();

  std::error_code failure;
  std::filesystem::create_directories(folder, failure);
  required(interfaces::writeMap(folder, "map", slam.map()));
  // The map is read back from its file, so that a flight with --map gets the same map.
  PlacedMap placed{std::make_shared<const flight::FlightMap>(flight::readFlightMap(folder / "map.yaml")),
                   fitted(slam, tracked, driven)};
  if (!placed.T_world_given)
    throw common::InputError(
        {}, "map.path_world_m",
        common::Message("survey.one-spot", "makes a map of one spot: it cannot be laid into the world"),
        "give it places that are some metres apart");
  return placed;
}

}  // namespace swiftlet::simulated_flight

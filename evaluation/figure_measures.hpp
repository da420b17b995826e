// The figures of a flight that take a measurement of their own; scoreOf() has the others.
#pragma once

#include <optional>
#include <vector>

#include "evaluation/flight_recorder.hpp"
#include "evaluation/flight_score.hpp"
#include "evaluation/true_world.hpp"

namespace swiftlet::evaluation {

/// The 3D map at the end of the flight against the true world. Without a map, or in a map without a point, nothing is
/// measured; without a camera, the map's coverage is not.
void measureMap3d(const FlightRecord& record, const TrueWorld& world, FlightScore& score);

/// What behaviours promise, by the truth.
void measureBehaviors(const FlightRecord& record, const TrueWorld& world, FlightScore& score);

/// By the targets that are found, not by candidates. The nearest pairs of reported and true ones belong together.
/// Nothing is measured without a true target, and no error without a found one.
void measureTargets(const std::vector<common::Target>& reported, const std::vector<TrueTarget>& truth,
                    const common::Pose3& T_world_map, FlightScore& score);

/// The absolute trajectory error after the best rigid motion of the whole trajectory, horizontal and vertical, if
/// enough was tracked to align it; and the share of the frames that were lost. `truth` as EstimateRecord::truth_map.
/// Nothing is measured without a frame.
void measureVisualOdometry(const VisualOdometryRecord& record, const common::Trajectory& truth, FlightScore& score);

/// The share of the floor of the area that the camera saw from one of the views, unhidden and within its range.
/// `T_world_body_views` are the true poses from which the camera saw.
std::optional<double> surveyCoverage(const common::Polygon& area, const TrueWorld& world,
                                     const common::Pose3& T_world_map,
                                     const std::vector<common::Pose3>& T_world_body_views);

}  // namespace swiftlet::evaluation

// How well a cloud of points agrees with the true surfaces.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "common/geometry.hpp"
#include "common/rgbd_camera_config.hpp"
#include "simulation/ray_caster.hpp"

namespace swiftlet::evaluation {

using Cloud = std::vector<Eigen::Vector3d>;

/// Distances of a cloud to the nearest true surface: of each cube of kSpacing_m with points their mean, so that a
/// surface counts by its area and not by the number of its points. A point farther than kLimit_m has no surface to be
/// compared with and counts as that far.
struct CloudError {
  double median_m = 0.0;
  double p95_m = 0.0;
  static constexpr double kLimit_m = 1.0;
};

/// Of at most kMostCubes, evenly spread over the cloud, which must not be empty, and kMostPoints in each.
CloudError cloudError(const Cloud& cloud_world_m, const simulation::RayCaster& rays);
inline constexpr std::size_t kMostCubes = 10'000, kMostPoints = 5;

/// The small rigid motion of the cloud, in the world's frame, that brings it nearest to the surfaces: iterated closest
/// points, each pulled along the normal of its surface [Chen and Medioni 1992]. Points much farther than most do not
/// count. The identity where the surfaces do not hold all six directions.
common::Pose3 alignment(const Cloud& cloud_world_m, const simulation::RayCaster& rays);

/// Places on the true surfaces, about kSpacing_m from each other, that a camera saw from at least two of its poses:
/// within its range and at no glancing angle, from which no camera of this kind measures.
Cloud surfacesInView(const common::RgbdCameraConfig& camera, const std::vector<common::Pose3>& T_world_camera,
                     const simulation::RayCaster& rays);
inline constexpr double kSpacing_m = 0.10;
inline constexpr double kGlancing_deg = 70.0;

/// The share of the places that have a point of the cloud within kSpacing_m; 1 if there is no place.
double shareCovered(const Cloud& places_m, const Cloud& cloud_m);

}  // namespace swiftlet::evaluation

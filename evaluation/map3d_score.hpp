// The 3D map at the end of a flight against the true world.
#pragma once

#include <cstddef>
#include <optional>

#include "evaluation/true_world.hpp"

namespace swiftlet::evaluation {

struct FlightRecord;

struct Map3dScore {
  std::size_t points = 0;
  /// Distance of the cloud to the nearest surface (CloudError), the map where the vehicle can know it to be.
  double error_median_m = 0.0;
  double error_p95_m = 0.0;
  /// Distance of the cloud to the nearest surface after one rigid motion of the whole cloud.
  double aligned_median_m = 0.0;
  double aligned_p95_m = 0.0;
  /// Share of the surfaces in view of the camera that are in the aligned cloud.
  std::optional<double> coverage;
  /// What the flight knew at its end of the camera's mount and clock. The body has the axes of the mounted laser here,
  /// as in knowableFrame().
  struct CameraErrors {
    double mount_rad = 0.0;  ///< Angle between the attitude of the mount as estimated and as it is.
    double sheet_rad = 0.0;  ///< Angle between the attitude of the mount on the data sheet and as it is.
    double clock_s = 0.0;    ///< Of the clock as estimated, without its sign.
  };
  std::optional<CameraErrors> camera = {};
};

/// nullopt if the flight has no 3D map, or a map without a point.
std::optional<Map3dScore> scoreMap3d(const FlightRecord& record, const TrueWorld& world);

}  // namespace swiftlet::evaluation

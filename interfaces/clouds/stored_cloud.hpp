// A cloud as a file holds it.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/submap3d.hpp"
#include "interfaces/files/header_unit.hpp"

namespace swiftlet::interfaces {

/// Where a point of a file lies in the map: scale * (its place in the file - origin).
struct CloudPlacement {
  Eigen::Vector3d origin_file = Eigen::Vector3d::Zero();  ///< In the unit of the file.
  double scale = 1.0;                                     ///< Metres in one unit of the file.
};

struct StoredCloud {
  std::vector<common::SurfacePoint> points;
  /// Points that were left out because their position is not finite. PCL writes such where nothing was measured.
  std::size_t not_finite = 0;
  double rounding_m = 0.0;  ///< By how much a coordinate differs at most from that of the file, which may be a double.
  std::optional<HeaderUnit> unit;  ///< That a comment of the header names; the placement alone scales.
  int unit_line = 0;               ///< Of that comment, from 1.
  /// What was left out, and what the file does not say and was taken from its numbers; for people.
  std::vector<std::string> notes;
};

}  // namespace swiftlet::interfaces

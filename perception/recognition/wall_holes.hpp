// Holes in a wall, as a depth image shows them: connected pixels that are farther than the plane of the wall, with the
// wall beside them.
//
//   pixel against plane --> on it | behind | in front | unknown --> connected pixels behind --> four sides: where the
//   wall ends beside them, or what is there instead --> how much of the rectangle is a hole, how deep it is
//
// The camera sees the hole's edge where the wall ends, not where the depth behind begins: beside an edge the farther
// surface is in the shadow of the projector.
#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

#include "perception/recognition/wall_planes.hpp"

namespace swiftlet::perception {

/// What ends a hole on one side.
enum class HoleEnd {
  kWall,     ///< The wall goes on.
  kFloor,    ///< Of the lower side: the floor leads through.
  kPicture,  ///< The picture ends first.
  kHidden,   ///< Something stands in front, or nothing is known.
};

struct HoleSide {
  HoleEnd end = HoleEnd::kHidden;
  /// Along the wall to the right, or above the camera; of a side that is not seen, as far as the hole was seen.
  double place_m = 0.0;
  double sigma_m = 0.0;  ///< Infinite if the side is not seen.

  bool isSeen() const { return end == HoleEnd::kWall || end == HoleEnd::kFloor; }
};

struct WallHole {
  enum Side : std::size_t { kLeft, kRight, kTop, kBottom };
  WallPlane wall;
  std::array<HoleSide, 4> sides;
  double framed = 0.0;           ///< Share of the samples of left, right and the better of top and bottom on the wall.
  double filled = 0.0;           ///< Share of the rectangle between the sides that is not wall.
  double deep = 0.0;             ///< Share of its pixels behind the wall that have room behind.
  double measured = 0.0;         ///< Share of them that are not too far for the camera.
  double recess_m = 0.0;         ///< Median distance behind the wall of these.
  std::vector<int> pixels = {};  ///< Row by row from the top left.

  double width_m() const { return sides[kRight].place_m - sides[kLeft].place_m; }
  double height_m() const { return sides[kTop].place_m - sides[kBottom].place_m; }
  Eigen::Vector3d centre() const;
};

/// Deeper than a reveal or a shelf: there is room behind.
inline constexpr double kRoomBehind_m = 0.35;

/// All that are large enough and have the wall at their left and right, whatever else they are.
std::vector<WallHole> findHoles(const DepthView& view, const WallPlane& wall);

}  // namespace swiftlet::perception

// Lines in space over a 3D picture. Pieces of them that a surface hides are drawn faintly.
#pragma once

#include <optional>
#include <span>

#include <Eigen/Geometry>

#include "rendering/canvas.hpp"
#include "rendering/depth_buffer.hpp"
#include "rendering/picture3d.hpp"
#include "rendering/theme.hpp"
#include "rendering/viewpoint3d.hpp"

namespace swiftlet::rendering {

/// Refers to its arguments, which must outlive it.
class Overlay3d {
 public:
  Overlay3d(Canvas& canvas, const DepthBuffer& buffer, const Eye& eye, Scheme scheme);

  /// Lines on whole metres at height 0 around `extent`; only where no surface hides them. Nothing for an empty box.
  void drawFloor(const Eigen::AlignedBox3d& extent, const common::Pose2& T_map_shown);
  void drawLine(const Line3d& line);
  /// The vehicle's hull, its heading, and a line down to the take-off floor.
  void drawVehicle(const PlacedVehicle& vehicle);
  /// An arrow that points down at it, as Saeedi et al. mark what was found.
  void drawTarget(const Eigen::Vector3d& target_map_m);
  /// The camera's field of view as a pyramid.
  void drawCamera(const PlacedCamera& camera);

 private:
  struct Pen {
    Color color;
    double width_px;
    Color hidden;  ///< Invisible where alpha is 0.
    bool dashed = false;
  };
  struct Piece {
    Eigen::Vector3d from_eye_m, to_eye_m;
  };

  void stroke(std::span<const Eigen::Vector3d> points_map_m, const Pen& pen);
  /// What of the segment is in the picture.
  std::optional<Piece> clipped(const Piece& piece) const;
  /// The segment in short steps, with the visible and the hidden runs of steps drawn each at once.
  void strokePiece(const Piece& piece, const Pen& pen);
  bool isHidden(const Eigen::Vector3d& point_eye_m) const;
  Pen pen(Color color, double width) const;
  Eigen::Vector3d inEye(const Eigen::Vector3d& point_map_m) const { return T_eye_map_ * point_map_m; }

  Canvas& canvas_;
  const DepthBuffer& buffer_;
  const Eye& eye_;
  const Theme& theme_;
  common::Pose3 T_eye_map_;
  double scale_;
};

}  // namespace swiftlet::rendering

// The shape of a known house: a box with a gable roof and a chimney (Tomic 2012, section "Recognition": "the shape of a
// model of the house"). Its axes: the origin in the middle of its floor, x along the ridge, to the chimney's half, z
// up.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include <tl/expected.hpp>

#include "common/config_fwd.hpp"
#include "common/error.hpp"

namespace swiftlet::perception {

/// Whether the `picture` of a known object is the model of a house: a file of YAML.
inline bool namesHouseModel(const std::string& picture) { return picture.ends_with(".yaml"); }

/// Outer sizes. A convex body, beside the chimney.
struct HouseModel {
  double length_m = 0.0;  ///< Along the ridge.
  double width_m = 0.0;
  double eaves_m = 0.0, ridge_m = 0.0;               ///< Above the floor. A flat roof has both alike.
  double chimney_x_m = 0.0, chimney_y_m = 0.0;       ///< Of its middle.
  double chimney_side_m = 0.0, chimney_top_m = 0.0;  ///< A square; above the floor.

  void describe(common::config::Fields& fields);
  std::vector<common::Problem> validate() const;
  /// From the text of a file (YAML). `name` is the file's, for the problem.
  static tl::expected<HouseModel, common::Message> read(const std::string& text, const std::string& name);

  /// The height of the roof over a place of the floor; beyond the eaves it goes on.
  double roofAt_m(double y_m) const;
};

enum HouseFace : int { kGableAhead, kGableBehind, kWallLeft, kWallRight, kRoofLeft, kRoofRight, kHouseFaces };
inline bool isRoof(int face) { return face >= kRoofLeft; }

/// The body as half-spaces: a point is inside where normal . point <= distance_m for all faces.
class HouseBody {
 public:
  explicit HouseBody(const HouseModel& model);

  struct Face {
    Eigen::Vector3d normal;
    double distance_m;
  };
  const std::array<Face, kHouseFaces>& faces() const { return faces_; }
  /// The face whose plane is the farthest inwards of a point outside, and the nearest one of a point inside: that on
  /// which a point near the surface lies.
  int faceOf(const Eigen::Vector3d& point_m) const;
  /// Signed distance from the plane of that face, outside positive.
  double off_m(const Eigen::Vector3d& point_m, int face) const {
    const Face& plane = faces_[static_cast<std::size_t>(face)];
    return plane.normal.dot(point_m) - plane.distance_m;
  }
  /// Where a ray from outside enters: `ray` times `depth_m` from `from_m`; nullopt where it passes by.
  struct Entry {
    double depth_m;
    int face;
  };
  std::optional<Entry> enteredBy(const Eigen::Vector3d& from_m, const Eigen::Vector3d& ray) const;

 private:
  std::array<Face, kHouseFaces> faces_;
};

}  // namespace swiftlet::perception

// Whether a fitted shape explains a depth image: a house of another size leaves points beside the shape, or is seen
// through where the shape has a roof.
#pragma once

#include <array>

#include "perception/recognition/house_fit.hpp"
#include "perception/recognition/house_model.hpp"
#include "perception/recognition/wall_planes.hpp"

namespace swiftlet::perception {

/// One of the four ends of the roof: pixels of its last 0.3 m, and of the 0.3 m beyond.
struct HouseEnd {
  int on = 0, through = 0, beyond = 0;
  int unmeasured = 0;  ///< Of the end: a roof at a glancing angle returns nothing.
  int free = 0;        ///< Beyond it the camera sees what is farther.

  /// It is seen, and the roof ends there.
  bool isSeen() const;
  /// The roof goes on, or ends before.
  bool isElsewhere() const;
};

/// Counts of pixels, every second of every second row.
struct HouseEvidence {
  int on = 0;                    ///< Measured on the shape, or at its chimney.
  int before = 0;                ///< Something else hides the shape.
  int roof_through = 0;          ///< Measured behind a roof.
  int wall_through = 0;          ///< Measured behind a wall: by a door or a window, or there is none.
  int beside = 0;                ///< Of something that stands right beside the shape.
  std::array<HouseEnd, 4> ends;  ///< Of both gables, then of both eaves.
  double in_view = 0.0;          ///< Share of the faces towards the camera that is in the picture and in range.
  double face_off_m = 0.0;       ///< Greatest median distance of the points of one face from it.
  double slope_off_m = 0.0;      ///< Greatest difference of that between the upper and the lower third of a roof.
  double ground_off_m = 0.0;     ///< Of the floor of the shape above the ground.

  /// Share of what the picture shows of the shape that speaks for it.
  double share() const;
};

HouseEvidence evidenceFor(const HousePose& pose, const HouseModel& model, const DepthView& view, double ground_m);
/// Whether it is that house and no other.
bool isThatHouse(const HouseEvidence& evidence);

}  // namespace swiftlet::perception

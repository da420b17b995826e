// Rooms of random houses, as a depth camera and a laser see them: a wall with windows and doors, open and closed, with
// mirrors, pictures of windows, shelves, and furniture before it. Two generators: one to write a recognizer with, and
// one of other proportions, materials, mirrors and furniture to judge it by.
//
// House coordinates: the inner face of the wall is x = 0, the room is at x < 0, z = 0 is the floor.
#pragma once

#include <cstdint>
#include <vector>

#include "common/geometry.hpp"
#include "common/rgbd_frame.hpp"
#include "common/sensor_event.hpp"
#include "simulation/ray_caster.hpp"
#include "simulation/world_model.hpp"

namespace swiftlet::perception {

enum class HouseItem { kOpenWindow, kOpenDoor, kClosedWindow, kClosedDoor, kMirror, kPicture, kShelf };
enum class Houses { kWritten, kHeldBack };

/// Something in the wall.
struct PlacedItem {
  HouseItem kind = HouseItem::kOpenWindow;
  double right_m = 0.0, left_m = 0.0;  ///< y of its sides, the right one is the smaller.
  double bottom_m = 0.0, top_m = 0.0;
  double recess_m = 0.0;  ///< Of pane, leaf or back behind the inner face.

  bool isOpen() const { return kind == HouseItem::kOpenWindow || kind == HouseItem::kOpenDoor; }
  Eigen::Vector3d centre_m() const { return {0.0, 0.5 * (left_m + right_m), 0.5 * (bottom_m + top_m)}; }
};

struct HouseScene {
  simulation::WorldModel world;
  std::vector<PlacedItem> items;
  std::size_t looked_at = 0;                     ///< The camera was turned to this item, more or less.
  double distance_m = 0.0, incidence_rad = 0.0;  ///< To its middle, from the normal of the wall.
  bool blind_mirror = false;                     ///< Mirrors return no depth; else that of what they reflect.
  common::Pose3 T_house_body;
  Eigen::Quaterniond R_level_camera;  ///< With the error of an attitude of half a degree.
  std::uint64_t seed = 0, index = 0;

  common::Pose3 T_house_camera() const;
  common::Pose3 T_camera_laser() const;
};

HouseScene drawHouse(Houses houses, std::uint64_t seed, std::uint64_t index);
/// The same room from up to seven free places aside of that of `scene`, 0.3 m apart, turned to the same item.
std::vector<HouseScene> looksAround(const HouseScene& scene, const simulation::RayCaster& rays);

struct HouseView {
  common::RgbdFrame frame;                ///< Depths alone, of an Xtion as it flies.
  common::LaserScan scan;                 ///< Of a UTM-30LX.
  std::vector<Eigen::Vector3d> behind_m;  ///< In the camera: what the laser saw when the vehicle was turned round.
};
HouseView look(const HouseScene& scene, const simulation::RayCaster& rays);

/// How much of an item the camera sees.
struct ItemInView {
  bool whole = false;    ///< It and the wall around it, and nothing stands before it.
  bool partly = false;   ///< A tenth of it.
  double size_px = 0.0;  ///< Square root of the area that it covers.
};
ItemInView inView(const HouseScene& scene, const PlacedItem& item, const simulation::RayCaster& rays);

}  // namespace swiftlet::perception

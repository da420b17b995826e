// The house of the trial dlr_leave_by_window, seen from where FindWindow looks: the window is told from the mirror on
// the same wall, and from a window whose shutter is closed.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "common/random.hpp"
#include "perception/recognition/object_tracker.hpp"
#include "perception/recognition/opening_recognizer.hpp"
#include "simulation/ray_caster.hpp"
#include "simulation/world_model.hpp"
#include "tests/recognition/house_scene.hpp"

namespace swiftlet::perception {
namespace {

using common::kRadPerDeg;
using common::Passage;

const std::string kHouse = std::string(SWIFTLET_SOURCE_DIR) + "/trials/worlds/dlr_leave_by_window.sdf";

/// A box of the size of the trial's shutter, in the reveal of the window.
simulation::Shape shutter() {
  simulation::Shape shape;
  shape.model = "shutter";
  for (int i = 0; i < 8; ++i)
    shape.vertices_world_m.emplace_back((i & 1) != 0 ? 2.10 : 2.06, (i & 2) != 0 ? 0.5 : -0.5,
                                        (i & 4) != 0 ? 1.75 : 0.0);
  constexpr std::array<std::array<std::uint32_t, 4>, 6> kSides = {
      {{0, 1, 3, 2}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 3, 7, 5}}};
  for (const auto& side : kSides) {
    shape.triangles.push_back({side[0], side[1], side[2]});
    shape.triangles.push_back({side[0], side[2], side[3]});
  }
  return shape;
}

const Eigen::Vector2d kWindowPlace(2.0, 0.0), kMirrorPlace(2.0, 1.5);

/// What is tracked after the eight views of FindWindow from that place, towards the window, and then towards the
/// mirror.
std::vector<common::RecognizedObject> seenFrom(const simulation::WorldModel& world, const Eigen::Vector2d& place,
                                               std::uint64_t seed) {
  const simulation::RayCaster rays(world);
  const common::KeyPoses keys{1, {{}}};
  common::RandomStream random(seed, "attitude");
  OpeningRecognizer recognizer({.inverse_depth_sigma_1_m = 0.00165});
  ObjectTracker tracker;
  HouseScene scene;
  scene.world = world;
  scene.seed = seed;
  constexpr std::array<std::array<double, 3>, 8> kViews = {
      {{0, 0, 0}, {0, 0, 29}, {0, 0, -29}, {0, 0.35, 0}, {0, -0.35, 0}, {-0.35, 0, 0}, {0, 0.7, 0}, {0, -0.7, 0}}};
  for (const Eigen::Vector2d& target : {kWindowPlace, kMirrorPlace})
    for (const auto& [ahead_m, left_m, turn_deg] : kViews) {
      const Eigen::Vector2d at = place + Eigen::Vector2d(ahead_m, left_m);
      const double yaw_rad = std::atan2((target - at).y(), (target - at).x()) + turn_deg * kRadPerDeg;
      scene.T_house_body = {
          common::quaternionFrom({random.gaussian(1.0) * kRadPerDeg, random.gaussian(1.0) * kRadPerDeg, yaw_rad}),
          {at.x(), at.y(), 1.1}};
      scene.R_level_camera = scene.T_house_camera().rotation;
      ++scene.index;
      const HouseView view = look(scene, rays);
      Observation observation;
      observation.frame = &view.frame;
      observation.scan = &view.scan;
      observation.R_level_camera = scene.R_level_camera;
      observation.T_camera_laser = scene.T_camera_laser();
      observation.seen_before_m = &view.behind_m;
      tracker.add(recognizer.recognize(observation), {0, scene.T_house_camera(), 0.02, 0.0, common::Time(), keys});
    }
  return tracker.objects(keys);
}

/// Confirmed ones of that name within 0.3 m.
int countAt(const std::vector<common::RecognizedObject>& objects, const std::string& what, Passage passage,
            const Eigen::Vector2d& place) {
  int count = 0;
  for (const common::RecognizedObject& one : objects)
    if (one.confirmed && one.what == what && one.passage == passage &&
        (one.T_map_object.position_m.head<2>() - place).norm() < 0.3)
      ++count;
  return count;
}

TEST(HouseToLeave, ItsWindowIsOpenOrClosedAndItsMirrorIsNone) {
  const simulation::WorldModel open = simulation::loadWorld(kHouse);
  simulation::WorldModel closed = open;
  closed.shapes.push_back(shutter());
  const std::vector<Eigen::Vector2d> places = {{0.1, 0.0}, {0.3, -0.2}};
  int found_closed = 0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const auto objects = seenFrom(open, places[i], i + 1);
    EXPECT_EQ(countAt(objects, "window", Passage::kOpen, kWindowPlace), 1) << i;
    EXPECT_EQ(countAt(objects, "window", Passage::kOpen, kMirrorPlace), 0) << i;
    EXPECT_EQ(countAt(objects, "mirror", Passage::kNone, kMirrorPlace), 1) << i;
    const auto behind_shutter = seenFrom(closed, places[i], i + 1);
    EXPECT_EQ(countAt(behind_shutter, "window", Passage::kOpen, kWindowPlace), 0) << i;
    found_closed += countAt(behind_shutter, "window", Passage::kClosed, kWindowPlace);
  }
  EXPECT_GE(found_closed, 1) << "the others are not detected, and looked for from elsewhere";
}

}  // namespace
}  // namespace swiftlet::perception

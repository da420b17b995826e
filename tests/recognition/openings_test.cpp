#include "perception/recognition/opening_recognizer.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include "perception/recognition/mirror_check.hpp"
#include "tests/recognition/house_scene.hpp"

namespace swiftlet::perception {
namespace {

using testing::IsEmpty;

Observation seenIn(const HouseScene& scene, const HouseView& view) {
  return {nullptr, &view.scan, &view.frame, scene.R_level_camera, scene.T_camera_laser(), &view.behind_m};
}

/// What is recognized as open, in rooms of the generator that the recognizer was not written with.
struct FoundInRooms {
  int due = 0, found = 0;
  std::map<HouseItem, int> open_at;
  std::vector<double> error_m;
};

void lookAt(const HouseScene& scene, const simulation::RayCaster& rays, FoundInRooms& result) {
  OpeningRecognizer recognizer({});
  const HouseView view = look(scene, rays);
  const std::vector<Recognized> recognized = recognizer.recognize(seenIn(scene, view));
  for (const PlacedItem& item : scene.items) {
    const double distance_m = (item.centre_m() - scene.T_house_body.position_m).head<2>().norm();
    const ItemInView seen = inView(scene, item, rays);
    const bool due = item.isOpen() && seen.whole && seen.size_px >= 40.0 && distance_m < 4.0;
    if (due) ++result.due;
    for (const Recognized& one : recognized) {
      const Eigen::Vector3d off = scene.T_house_camera() * one.T_sensor_object.position_m - item.centre_m();
      if (one.passage != Passage::kOpen || off.norm() > 0.25) continue;
      ++result.open_at[item.kind];
      if (!due) continue;
      ++result.found;
      result.error_m.push_back(off.norm());
    }
  }
}

/// Rooms in which the camera sees an item whole; rendering the others would take time and show little.
FoundInRooms foundInRooms(std::uint64_t rooms) {
  FoundInRooms result;
  for (std::uint64_t i = 0; i < rooms; ++i) {
    const HouseScene scene = drawHouse(Houses::kHeldBack, 77, i);
    const simulation::RayCaster rays(scene.world);
    if (inView(scene, scene.items[scene.looked_at], rays).whole) lookAt(scene, rays, result);
  }
  return result;
}

TEST(Openings, AreFoundInRoomsOfAnotherGeneratorAndNothingClosedIsOpen) {
  FoundInRooms found = foundInRooms(220);
  ASSERT_GE(found.due, 8);
  EXPECT_GE(found.found, 0.8 * found.due) << found.due;
  for (const double error_m : found.error_m) EXPECT_LT(error_m, 0.10);
  for (const HouseItem kind :
       {HouseItem::kClosedWindow, HouseItem::kClosedDoor, HouseItem::kPicture, HouseItem::kShelf})
    EXPECT_EQ(found.open_at[kind], 0) << static_cast<int>(kind);
}

TEST(Openings, NeedDepthsOfTheSizeOfTheirCamera) {
  OpeningRecognizer recognizer({});
  EXPECT_THAT(recognizer.recognize({}), IsEmpty());
  common::RgbdFrame frame;
  frame.camera = {320, 240, 288.0, 288.0, 159.5, 119.5};
  frame.depth = {320, 200, std::vector<float>(320 * 200, 2.0F)};
  EXPECT_THAT(recognizer.recognize({nullptr, nullptr, &frame}), IsEmpty());
  frame.depth = {320, 240, std::vector<float>(320 * 240, std::numeric_limits<float>::quiet_NaN())};
  EXPECT_THAT(recognizer.recognize({nullptr, nullptr, &frame}), IsEmpty());
}

/// The sides of a room of 4 m by 4 m around the laser, as it sees all of them.
common::LaserScan squareRoom(double half_m) {
  common::LaserScan scan;
  scan.angle_min_rad = -std::numbers::pi;
  scan.angle_increment_rad = std::numbers::pi / 360.0;
  scan.range_min_m = 0.1;
  scan.range_max_m = 30.0;
  for (int i = 0; i < 720; ++i) {
    const double angle = scan.angle_min_rad + i * scan.angle_increment_rad;
    scan.ranges_m.push_back(
        static_cast<float>(half_m / std::max(std::abs(std::cos(angle)), std::abs(std::sin(angle)))));
  }
  return scan;
}

TEST(MirrorCheck, TellsAReflectionFromARoomBehind) {
  const LevelScan scan(squareRoom(2.0), {});
  WallPlane wall;
  wall.inverse_1_m = {0.5, 0.0, 0.0};  // x = 2 m.
  std::vector<Eigen::Vector3d> reflected, room, above;
  for (double y = -1.0; y <= 1.0; y += 0.1) {
    reflected.emplace_back(6.0, y, 0.0);  // The wall at x = -2 m.
    room.emplace_back(3.1, y, 0.0);       // Would be 1.1 m before the mirror, where the laser sees through.
    above.emplace_back(6.0, y, 1.0);
  }
  EXPECT_EQ(reflectionOf(reflected, wall, scan), Reflection::kYes);
  EXPECT_EQ(reflectionOf(room, wall, scan), Reflection::kNo);
  EXPECT_EQ(reflectionOf(above, wall, scan), Reflection::kMaybe) << "the laser sees nothing at that height";
}

TEST(ScanOpenings, AreGapsInOneWallThroughWhichTheLaserSees) {
  common::LaserScan scan = squareRoom(2.0);
  const auto setGap = [&](float range_m) {
    for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
      const double angle = scan.angle_min_rad + static_cast<double>(i) * scan.angle_increment_rad;
      const double y = 2.0 * std::tan(angle);
      if (std::cos(angle) > 0.0 && y > -0.3 && y < 0.7) scan.ranges_m[i] = range_m;
    }
  };
  ScanOpeningRecognizer recognizer({});
  EXPECT_THAT(recognizer.recognize({nullptr, &scan}), IsEmpty()) << "a wall without a gap";
  setGap(3.1F);
  const auto open = recognizer.recognize({nullptr, &scan});
  ASSERT_EQ(open.size(), 1U);
  EXPECT_NEAR(open[0].T_sensor_object.position_m.x(), 2.0, 0.02);
  EXPECT_NEAR(open[0].T_sensor_object.position_m.y(), 0.2, 0.05);
  EXPECT_NEAR(open[0].size_m.x(), 1.0, 0.1);
  setGap(2.25F);
  EXPECT_THAT(recognizer.recognize({nullptr, &scan}), IsEmpty()) << "a niche";
}

}  // namespace
}  // namespace swiftlet::perception

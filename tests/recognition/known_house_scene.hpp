// A house with a gable roof and a chimney in a yard, as a depth camera 4 m above sees it: one of a known shape, or one
// of another size in its place. Two generators: one to write a recognizer with, and one of other proportions, coverings
// and surroundings to judge it by.
#pragma once

#include <cstdint>

#include "common/geometry.hpp"
#include "common/rgbd_camera_config.hpp"
#include "common/rgbd_frame.hpp"
#include "perception/recognition/house_recognizer.hpp"
#include "simulation/world_model.hpp"
#include "vision/gray_image.hpp"

namespace swiftlet::perception {

enum class KnownHouses { kWritten, kHeldBack };
enum class HouseLook {
  kAhead,  ///< A camera that looks ahead and down, 4 m above the ground and 3.5 to 5.5 m from the middle of the house.
  kDown,   ///< One that looks down, 4 m above the ridge.
};

struct KnownHouseScene {
  simulation::WorldModel world;
  HouseModel model;  ///< That is looked for.
  HouseModel built;  ///< That stands there: the same, or one of another size.
  common::Pose3 T_world_house, T_world_camera;
  Eigen::Quaterniond R_level_camera;  ///< With the error of an attitude of half a degree.
  std::uint64_t seed = 0, index = 0;

  common::Pose3 T_camera_house() const { return T_world_camera.inverse() * T_world_house; }
};

KnownHouseScene drawKnownHouse(KnownHouses houses, HouseLook look, bool other, std::uint64_t seed, std::uint64_t index);

/// config/sensors/realsense_d455.yaml without its mount.
common::RgbdCameraConfig houseCamera();
/// One frame with the errors of config/nature/real.yaml; of a stereo camera after matching, empty if that fails.
common::RgbdFrame frameOf(const KnownHouseScene& scene, const common::RgbdCameraConfig& camera);
/// What is recognized in it.
std::vector<Recognized> housesIn(const KnownHouseScene& scene, const common::RgbdCameraConfig& camera);

/// How far a recognized house is from the true one.
struct HouseError {
  double position_m = 0.0, heading_rad = 0.0;
  double squared = 0.0;  ///< Of the position, over its covariance, a third of it.
};
HouseError errorOf(const Recognized& house, const KnownHouseScene& scene);

}  // namespace swiftlet::perception

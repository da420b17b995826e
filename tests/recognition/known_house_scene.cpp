#include "tests/recognition/known_house_scene.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include <Eigen/LU>

#include "common/random.hpp"
#include "simulation/appearance/patterns.hpp"
#include "simulation/ray_caster.hpp"
#include "simulation/sensors/rgbd_camera.hpp"
#include "simulation/triangulate.hpp"
#include "vision/stereo_matcher.hpp"

namespace swiftlet::perception {
namespace {

using common::kRadPerDeg;
using common::Pose3;
using common::RandomStream;
using simulation::Pattern;

constexpr double kWallThick_m = 0.2, kSlab_m = 0.06;

Eigen::Quaterniond inAngles(double roll_rad, double pitch_rad, double yaw_rad) {
  return common::quaternionFrom({roll_rad, pitch_rad, yaw_rad});
}

/// Sizes and surroundings of one generator.
struct KnownStyle {
  double length_m[2], width_m[2], eaves_m[2], rise_m[2], chimney_side_m[2], chimney_over_m[2];
  std::array<Pattern, 3> roofs;
  double roof_light[2], chimney_light[2];  ///< Brightness; they differ by a fifth of the scale at least.
  int things;                              ///< In the yard.
};

const KnownStyle& styleOfKnown(KnownHouses houses) {
  static const KnownStyle kWritten{{3.8, 5.0},
                                   {3.2, 4.0},
                                   {2.0, 2.4},
                                   {0.6, 1.0},
                                   {0.4, 0.6},
                                   {0.3, 0.5},
                                   {Pattern::kBlank, Pattern::kPlaster, Pattern::kWood},
                                   {0.3, 0.5},
                                   {0.5, 0.9},
                                   3};
  static const KnownStyle kHeldBack{{3.4, 5.6},
                                    {2.8, 4.6},
                                    {1.8, 2.7},
                                    {0.4, 1.4},
                                    {0.35, 0.8},
                                    {0.2, 0.7},
                                    {Pattern::kPlaster, Pattern::kTiles, Pattern::kBrick},
                                    {0.2, 0.6},
                                    {0.1, 0.9},
                                    6};
  return houses == KnownHouses::kWritten ? kWritten : kHeldBack;
}

/// Builds one scene; shapes are given in the axes of the house.
class KnownHouseBuilder {
 public:
  KnownHouseBuilder(KnownHouses houses, std::uint64_t seed, std::uint64_t index)
      : style_(styleOfKnown(houses)),
        random_(seed, houses == KnownHouses::kWritten ? "known house" : "other known house", index) {
    scene_.seed = seed;
    scene_.index = index;
  }

  KnownHouseScene build(HouseLook look, bool other) {
    scene_.model = drawModel();
    scene_.T_world_house = {inAngles(0.0, 0.0, random_.uniform(-std::numbers::pi, std::numbers::pi)),
                            {random_.uniform(-1.0, 1.0), random_.uniform(-1.0, 1.0), 0.0}};
    const HouseModel built = scene_.built = other ? drawOther() : scene_.model;
    const double bearing_rad = random_.uniform(-std::numbers::pi, std::numbers::pi);
    layYard(built, bearing_rad);
    layWalls(built);
    layRoof(built);
    placeCamera(look, bearing_rad);
    return std::move(scene_);
  }

 private:
  double draw(const double (&range)[2]) { return random_.uniform(range[0], range[1]); }

  HouseModel drawModel() {
    HouseModel model;
    model.width_m = draw(style_.width_m);
    model.length_m = std::max(draw(style_.length_m), model.width_m + 0.3);
    model.eaves_m = draw(style_.eaves_m);
    model.ridge_m = model.eaves_m + draw(style_.rise_m);
    model.chimney_side_m = draw(style_.chimney_side_m);
    model.chimney_x_m = random_.uniform(0.6, 0.5 * model.length_m - model.chimney_side_m);
    model.chimney_y_m = random_.uniform(-0.25, 0.25) * model.width_m;
    model.chimney_top_m = model.ridge_m + draw(style_.chimney_over_m);
    return model;
  }

  /// One size differs by half a metre to a metre and a half, or the height by 0.4 to 0.9 m.
  HouseModel drawOther() {
    HouseModel other = scene_.model;
    const double sign = random_.chance(0.5) ? 1.0 : -1.0;
    const double by_m = sign * random_.uniform(0.5, 1.5);
    const double which = random_.uniform();
    if (which < 0.4) other.length_m = std::max(2.5, other.length_m + by_m);
    if (which >= 0.4 && which < 0.7) other.width_m = std::max(2.2, other.width_m + by_m);
    if (which >= 0.7) {
      const double higher_m = sign * random_.uniform(0.4, 0.9);
      other.eaves_m += higher_m;
      other.ridge_m += higher_m;
      other.chimney_top_m += higher_m;
    }
    const double half_m = 0.5 * (other.width_m - other.chimney_side_m);
    other.chimney_y_m = std::clamp(other.chimney_y_m, -half_m, half_m);
    other.chimney_x_m = std::min(other.chimney_x_m, 0.5 * (other.length_m - other.chimney_side_m));
    return other;
  }

  void add(const Eigen::Vector3d& middle_m, const Eigen::Vector3d& size_m, double light, Pattern pattern,
           const Eigen::Quaterniond& turned = Eigen::Quaterniond::Identity()) {
    simulation::Shape shape;
    shape.model = "part" + std::to_string(scene_.world.shapes.size());
    const simulation::Triangles triangles = simulation::boxTriangles(size_m);
    for (const Eigen::Vector3f& vertex : triangles.vertices_m)
      shape.vertices_world_m.push_back(
          (scene_.T_world_house * Eigen::Vector3d(middle_m + turned * vertex.cast<double>())).cast<float>());
    shape.triangles = triangles.indices;
    shape.color = simulation::Color::Constant(static_cast<float>(light));
    shape.pattern = pattern;
    shape.T_world_shape = scene_.T_world_house * Pose3{turned, middle_m};
    scene_.world.shapes.push_back(std::move(shape));
  }

  /// A wall along x or y between two ends, with a hole if `hole_m` is above 0.
  void wall(bool along_x, double at_m, double half_m, double top_m, double hole_m, double sill_m, double lintel_m) {
    const double light = random_.uniform(0.5, 0.85);
    const auto piece = [&](double from_m, double to_m, double low_m, double high_m) {
      if (to_m - from_m < 0.01 || high_m - low_m < 0.01) return;
      const double middle = 0.5 * (from_m + to_m), z = 0.5 * (low_m + high_m);
      add(along_x ? Eigen::Vector3d(middle, at_m, z) : Eigen::Vector3d(at_m, middle, z),
          along_x ? Eigen::Vector3d(to_m - from_m, kWallThick_m, high_m - low_m)
                  : Eigen::Vector3d(kWallThick_m, to_m - from_m, high_m - low_m),
          light, Pattern::kBrick);
    };
    const double hole_at_m = random_.uniform(-0.3, 0.3) * half_m, h = 0.5 * hole_m;
    piece(-half_m, hole_at_m - h, 0.0, top_m);
    piece(hole_at_m + h, half_m, 0.0, top_m);
    piece(hole_at_m - h, hole_at_m + h, 0.0, sill_m);
    piece(hole_at_m - h, hole_at_m + h, std::min(top_m, lintel_m), top_m);
  }

  void layWalls(const HouseModel& m) {
    const double x = 0.5 * m.length_m, y = 0.5 * m.width_m, in = 0.5 * kWallThick_m;
    wall(true, y - in, x, m.eaves_m, 1.0, 0.55, 1.75);
    wall(true, -y + in, x, m.eaves_m, 0.0, 0.0, 0.0);
    wall(false, x - in, y - kWallThick_m, m.eaves_m, 1.0, 0.0, 1.75);
    wall(false, -x + in, y - kWallThick_m, m.eaves_m, 0.0, 0.0, 0.0);
    // Gables of layers that end under the roof.
    constexpr double kLayer_m = 0.05;
    for (double z = m.eaves_m; z + kLayer_m < m.ridge_m; z += kLayer_m) {
      const double half_m = y * (m.ridge_m - z - kLayer_m) / std::max(1e-6, m.ridge_m - m.eaves_m);
      for (const double end : {-x + in, x - in})
        add({end, 0.0, z + 0.5 * kLayer_m}, {kWallThick_m, 2.0 * half_m, kLayer_m}, 0.7, Pattern::kBlank);
    }
  }

  void layRoof(const HouseModel& m) {
    const double half_m = 0.5 * m.width_m, rise_m = m.ridge_m - m.eaves_m;
    const double slope_rad = std::atan2(rise_m, half_m), along_m = std::hypot(rise_m, half_m);
    const double roof_light = draw(style_.roof_light);
    double chimney_light = draw(style_.chimney_light);
    while (std::abs(chimney_light - roof_light) < 0.2) chimney_light = draw(style_.chimney_light);
    const Pattern covering = style_.roofs[static_cast<std::size_t>(random_.uniform() * 2.999)];
    for (const double side : {1.0, -1.0}) {
      const Eigen::Quaterniond turned = inAngles(-side * slope_rad, 0.0, 0.0);
      const Eigen::Vector3d surface(0.0, side * 0.5 * half_m, m.eaves_m + 0.5 * rise_m);
      add(surface - turned * Eigen::Vector3d(0.0, 0.0, 0.5 * kSlab_m), {m.length_m, along_m, kSlab_m}, roof_light,
          covering, turned);
    }
    const double bottom_m = m.roofAt_m(m.chimney_y_m) - 0.4;
    add({m.chimney_x_m, m.chimney_y_m, 0.5 * (m.chimney_top_m + bottom_m)},
        {m.chimney_side_m, m.chimney_side_m, m.chimney_top_m - bottom_m}, chimney_light, Pattern::kBlank);
  }

  /// `bearing_rad`: of the view, in the world.
  void layYard(const HouseModel& m, double bearing_rad) {
    add({0.0, 0.0, -0.05}, {40.0, 40.0, 0.1}, 0.45, Pattern::kLawn);
    const double away_m = 0.5 * std::hypot(m.length_m, m.width_m) + 1.0;
    // Behind it a wall that is higher than the house, as of a hall.
    if (random_.chance(0.5)) {
      const double behind_rad = bearing_rad - common::yawOf(scene_.T_world_house.rotation) + random_.uniform(-0.8, 0.8);
      const Eigen::Quaterniond turned = inAngles(0.0, 0.0, behind_rad);
      add(turned * Eigen::Vector3d(away_m + 0.8, 0.0, 2.5), {0.2, 12.0, 5.0}, 0.6, Pattern::kBrick, turned);
    }
    for (int i = 0; i < style_.things; ++i) {
      const double at_rad = random_.uniform(-std::numbers::pi, std::numbers::pi);
      const double far_m = away_m + random_.uniform(0.3, 2.5), height_m = random_.uniform(0.4, 1.8);
      add({far_m * std::cos(at_rad), far_m * std::sin(at_rad), 0.5 * height_m},
          {random_.uniform(0.2, 1.2), random_.uniform(0.2, 1.2), height_m}, random_.uniform(0.2, 0.9), Pattern::kWood,
          inAngles(0.0, 0.0, random_.uniform(0.0, 1.5)));
    }
  }

  void placeCamera(HouseLook look, double bearing_rad) {
    const Eigen::Vector2d towards(std::cos(bearing_rad), std::sin(bearing_rad));
    Eigen::Vector3d at_m;
    Eigen::Quaterniond R;
    if (look == HouseLook::kAhead) {
      const double away_m = random_.uniform(3.5, 5.5);
      at_m << scene_.T_world_house.position_m.head<2>() - away_m * towards, 4.0 + random_.uniform(-0.2, 0.2);
      R = inAngles(random_.gaussian(0.02), (25.0 * kRadPerDeg) + random_.gaussian(0.02),
                   bearing_rad + random_.uniform(-0.12, 0.12));
    } else {
      at_m << scene_.T_world_house.position_m.head<2>() - random_.uniform(0.2, 1.0) * towards,
          scene_.model.ridge_m + 4.0 + random_.uniform(-0.2, 0.2);
      R = inAngles(random_.gaussian(0.02), (80.0 * kRadPerDeg) + random_.gaussian(0.02), bearing_rad);
    }
    scene_.T_world_camera = {R, at_m};
    const double sigma_rad = 0.5 * kRadPerDeg;
    scene_.R_level_camera = common::expSO3({random_.gaussian(sigma_rad), random_.gaussian(sigma_rad), 0.0}) * R;
  }

  const KnownStyle& style_;
  RandomStream random_;
  KnownHouseScene scene_;
};

/// Drawn within config/nature/real.yaml, but for the mount, whose error is that of the attitude here.
simulation::RgbdErrorsConfig drawErrors(const KnownHouseScene& scene) {
  RandomStream random(scene.seed, "camera errors", scene.index);
  simulation::RgbdErrorsConfig errors;
  errors.focal_share = random.uniform(0.996, 1.004);
  errors.inverse_depth_bias_1_m = random.uniform(-0.001, 0.001);
  errors.dark_range_m = random.uniform(2.0, 4.0);
  errors.glancing_deg = random.uniform(75.0, 85.0);
  errors.edge_hole_rate = random.uniform(0.1, 0.5);
  return errors;
}

}  // namespace

KnownHouseScene drawKnownHouse(KnownHouses houses, HouseLook look, bool other, std::uint64_t seed,
                               std::uint64_t index) {
  return KnownHouseBuilder(houses, seed, index).build(look, other);
}

common::RgbdCameraConfig houseCamera() {
  common::RgbdCameraConfig camera;
  camera.width_px = 424;
  camera.height_px = 240;
  camera.field_of_view_deg = 87.0;
  camera.range_min_m = 0.6;
  camera.range_max_m = 8.0;
  camera.baseline_m = 0.095;
  camera.inverse_depth_noise_1_m = 0.0019;
  camera.inverse_depth_step_1_m = 0.0007;
  return camera;
}

common::RgbdFrame frameOf(const KnownHouseScene& scene, const common::RgbdCameraConfig& camera) {
  common::RgbdCameraConfig at_body = camera;
  at_body.mount = {};
  simulation::RgbdCamera sensor(at_body, drawErrors(scene), scene.world, scene.seed + scene.index);
  const simulation::RayCaster rays(scene.world);
  std::vector<simulation::Moment> track;
  for (const double time_s : {0.5, 1.0, 1.5})
    track.push_back({common::Time::fromSeconds(time_s), scene.T_world_camera, {}});
  common::RgbdFrame frame = sensor.frame(0, common::Time::fromSeconds(1.0), track, rays);
  if (!camera.isStereo()) return frame;
  auto matched = vision::StereoMatcher(at_body).match(frame);
  return matched ? *std::move(matched) : common::RgbdFrame{};
}

std::vector<Recognized> housesIn(const KnownHouseScene& scene, const common::RgbdCameraConfig& camera) {
  const common::RgbdFrame frame = frameOf(scene, camera);
  if (frame.camera.width_px == 0) return {};
  const CameraPicture picture{frame.camera, vision::grayOf(frame.color)};
  HouseConfig config{"house", scene.model};
  config.inverse_depth_sigma_1_m =
      camera.isStereo() ? vision::StereoMatcher(camera).noise().sigma_per_m2
                        : std::hypot(camera.inverse_depth_noise_1_m, camera.inverse_depth_step_1_m / std::sqrt(12.0));
  config.range_max_m = camera.range_max_m;
  return HouseRecognizer(config).recognize({&picture, nullptr, &frame, scene.R_level_camera});
}

HouseError errorOf(const Recognized& house, const KnownHouseScene& scene) {
  const Pose3 truth = scene.T_camera_house();
  const Eigen::Vector3d off_m = house.T_sensor_object.position_m - truth.position_m;
  HouseError error;
  error.position_m = off_m.norm();
  const Eigen::Quaterniond R_world_house = scene.T_world_camera.rotation * house.T_sensor_object.rotation;
  error.heading_rad =
      std::abs(common::wrapAngle(common::yawOf(R_world_house) - common::yawOf(scene.T_world_house.rotation)));
  const Eigen::Matrix3d covariance = house.covariance.bottomRightCorner<3, 3>();
  error.squared = off_m.dot(covariance.inverse() * off_m) / 3.0;
  return error;
}

}  // namespace swiftlet::perception

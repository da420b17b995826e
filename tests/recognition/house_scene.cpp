#include "tests/recognition/house_scene.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "common/random.hpp"
#include "common/rgbd_camera_config.hpp"
#include "simulation/sensors/depth_sensor.hpp"
#include "simulation/triangulate.hpp"

namespace swiftlet::perception {
namespace {

using common::kRadPerDeg;
using common::Pose3;
using common::RandomStream;

struct Range {
  double low, high;
  double of(RandomStream& random) const { return random.uniform(low, high); }
};

/// Proportions of the houses of one generator.
struct HouseStyle {
  Range wall_m, ceiling_m, room_m, door_width_m, door_height_m, window_width_m, window_height_m, sill_m;
  Range frame_width_m, frame_relief_m;     ///< Around windows and doors.
  Range pane_recess_m, shelf_m, mirror_m;  ///< Depth of panes, of shelves; width of mirrors.
  Range room_behind_m;
  int furniture;
  std::array<double, 7> kinds;  ///< Weight of each HouseItem.
};

const HouseStyle& styleOf(Houses houses) {
  static const HouseStyle kWritten{
      {0.12, 0.25}, {2.4, 2.8}, {5.5, 7.0},   {0.8, 1.0},   {2.0, 2.1}, {0.8, 1.3}, {0.8, 1.3}, {0.5, 0.9},
      {0.0, 0.0},   {0.0, 0.0}, {0.04, 0.12}, {0.25, 0.32}, {0.5, 0.9}, {2.0, 6.0}, 3,          {3, 2, 1, 1, 1, 1, 1}};
  static const HouseStyle kHeldBack{{0.08, 0.32},         {2.2, 3.4},   {5.5, 9.0},  {0.65, 1.4},  {1.9, 2.4},
                                    {0.6, 1.9},           {0.55, 1.6},  {0.25, 1.2}, {0.03, 0.10}, {0.0, 0.04},
                                    {0.03, 0.14},         {0.18, 0.33}, {0.4, 1.3},  {1.2, 9.0},   6,
                                    {3, 2, 1, 1, 2, 2, 2}};
  return houses == Houses::kWritten ? kWritten : kHeldBack;
}

constexpr double kPitchDown_deg = 10.0;  ///< Of the camera's mount, as config/sensors/xtion.yaml.
const Pose3 kT_body_laser{Eigen::Quaterniond::Identity(), {0.0, 0.0, 0.08}};

Eigen::Quaterniond turned(double roll_rad, double pitch_rad, double yaw_rad) {
  return Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ()) * Eigen::AngleAxisd(pitch_rad, Eigen::Vector3d::UnitY()) *
         Eigen::AngleAxisd(roll_rad, Eigen::Vector3d::UnitX());
}

Pose3 T_body_camera() { return {turned(0.0, kPitchDown_deg * kRadPerDeg, 0.0), {0.12, 0.0, 0.03}}; }

simulation::Shape box(const std::string& model, const Eigen::Vector3d& low, const Eigen::Vector3d& high,
                      double yaw_rad = 0.0) {
  simulation::Shape shape;
  shape.model = model;
  const simulation::Triangles triangles = simulation::boxTriangles(high - low);
  const Eigen::Vector3d middle = 0.5 * (low + high);
  const Eigen::Quaterniond R = turned(0.0, 0.0, yaw_rad);
  for (const Eigen::Vector3f& vertex : triangles.vertices_m)
    shape.vertices_world_m.push_back((middle + R * vertex.cast<double>()).cast<float>());
  shape.triangles = triangles.indices;
  return shape;
}

/// Builds one house.
class Builder {
 public:
  Builder(Houses houses, std::uint64_t seed, std::uint64_t index)
      : style_(styleOf(houses)), random_(seed, houses == Houses::kWritten ? "house" : "other house", index) {
    scene_.seed = seed;
    scene_.index = index;
  }

  HouseScene build() {
    wall_m_ = style_.wall_m.of(random_);
    ceiling_m_ = style_.ceiling_m.of(random_);
    half_m_ = 0.5 * style_.room_m.of(random_);
    depth_m_ = style_.room_m.of(random_);
    scene_.blind_mirror = random_.chance(0.3);
    layWall();
    layRooms();
    chooseView();
    layFurniture();
    return std::move(scene_);
  }

 private:
  void add(const std::string& model, const Eigen::Vector3d& low, const Eigen::Vector3d& high, double yaw_rad = 0.0) {
    if ((high - low).minCoeff() < 1e-3) return;
    scene_.world.shapes.push_back(box(model, low, high, yaw_rad));
    scene_.world.shapes.back().color = simulation::Color::Constant(static_cast<float>(random_.uniform(0.15, 0.9)));
  }

  HouseItem drawKind() {
    double weights = 0.0;
    for (const double weight : style_.kinds) weights += weight;
    double left = random_.uniform() * weights;
    std::size_t kind = 0;
    while (kind + 1 < style_.kinds.size() && left >= style_.kinds[kind]) left -= style_.kinds[kind++];
    return static_cast<HouseItem>(kind);
  }

  PlacedItem drawItem() {
    PlacedItem item;
    item.kind = drawKind();
    const bool door = item.kind == HouseItem::kOpenDoor || item.kind == HouseItem::kClosedDoor;
    const double width_m = item.kind == HouseItem::kMirror
                               ? style_.mirror_m.of(random_)
                               : (door ? style_.door_width_m : style_.window_width_m).of(random_);
    item.left_m = width_m;
    item.bottom_m = door ? 0.0 : style_.sill_m.of(random_);
    item.top_m = door ? style_.door_height_m.of(random_) : item.bottom_m + style_.window_height_m.of(random_);
    item.top_m = std::min(item.top_m, ceiling_m_ - 0.15);
    item.recess_m = item.kind == HouseItem::kShelf ? style_.shelf_m.of(random_) : style_.pane_recess_m.of(random_);
    if (item.kind == HouseItem::kMirror) item.recess_m = 0.01;
    return item;
  }

  void layWall() {
    double at_m = -half_m_ + random_.uniform(0.3, 0.9);
    double done_m = -half_m_;
    for (;;) {
      PlacedItem item = drawItem();
      item.right_m = at_m;
      item.left_m += at_m;
      if (item.left_m > half_m_ - 0.3) break;
      add("wall", {0.0, done_m, 0.0}, {wall_m_, item.right_m, ceiling_m_});
      layItem(item);
      scene_.items.push_back(item);
      done_m = item.left_m;
      at_m = done_m + random_.uniform(0.35, 1.2);
    }
    add("wall", {0.0, done_m, 0.0}, {wall_m_, half_m_, ceiling_m_});
  }

  void layItem(const PlacedItem& item) {
    const double right = item.right_m, left = item.left_m;
    if (item.kind == HouseItem::kPicture) {
      add("wall", {0.0, right, 0.0}, {wall_m_, left, ceiling_m_});
      add("picture", {-random_.uniform(0.01, 0.04), right, item.bottom_m}, {0.0, left, item.top_m});
      return;
    }
    add("wall", {0.0, right, 0.0}, {wall_m_, left, item.bottom_m});
    add("wall", {0.0, right, item.top_m}, {wall_m_, left, ceiling_m_});
    if (!item.isOpen()) {
      const char* what = item.kind == HouseItem::kMirror ? "mirror" : "pane";
      add(what, {item.recess_m, right, item.bottom_m}, {item.recess_m + 0.03, left, item.top_m});
    }
    if (item.kind == HouseItem::kShelf) {
      for (const double y : {right, left})
        add("shelf", {0.0, y - 0.02, item.bottom_m}, {item.recess_m, y + 0.02, item.top_m});
      for (const double z : {item.bottom_m, 0.5 * (item.bottom_m + item.top_m), item.top_m})
        add("shelf", {0.0, right, z - 0.02}, {item.recess_m, left, z + 0.02});
    } else {
      layFrame(item);
    }
  }

  void layFrame(const PlacedItem& item) {
    const double width = style_.frame_width_m.of(random_), relief = style_.frame_relief_m.of(random_);
    const double right = item.right_m, left = item.left_m, top = item.top_m, bottom = item.bottom_m;
    add("frame", {-relief, right - width, bottom}, {0.0, right, top + width});
    add("frame", {-relief, left, bottom}, {0.0, left + width, top + width});
    add("frame", {-relief, right, top}, {0.0, left, top + width});
    if (bottom > 0.0) add("frame", {-relief, right - width, bottom - width}, {0.0, left + width, bottom});
  }

  void layRooms() {
    add("floor", {-depth_m_ - 1.0, -20.0, -0.1}, {20.0, 20.0, 0.0});
    add("ceiling", {-depth_m_, -half_m_, ceiling_m_}, {wall_m_, half_m_, ceiling_m_ + 0.1});
    add("side", {-depth_m_, half_m_, 0.0}, {wall_m_, half_m_ + 0.1, ceiling_m_});
    add("side", {-depth_m_, -half_m_ - 0.1, 0.0}, {wall_m_, -half_m_, ceiling_m_});
    add("back", {-depth_m_ - 0.1, -half_m_, 0.0}, {-depth_m_, half_m_, ceiling_m_});
    const bool outdoors = random_.chance(0.5);
    const double behind_m = wall_m_ + style_.room_behind_m.of(random_);
    if (!outdoors) {
      add("far", {behind_m, -half_m_ - 2.0, 0.0}, {behind_m + 0.1, half_m_ + 2.0, ceiling_m_});
      add("ceiling", {wall_m_, -half_m_ - 2.0, ceiling_m_}, {behind_m, half_m_ + 2.0, ceiling_m_ + 0.1});
    }
    for (int i = 0; i < style_.furniture; ++i) {
      const double x = random_.uniform(wall_m_ + 1.6, wall_m_ + 8.0), y = random_.uniform(-half_m_, half_m_);
      const Eigen::Vector3d half(random_.uniform(0.1, 0.6), random_.uniform(0.1, 0.6), 0.0);
      if (outdoors || x + 1.0 < behind_m)
        add("thing", Eigen::Vector3d(x, y, 0.0) - half, Eigen::Vector3d(x, y, random_.uniform(0.4, 2.0)) + half,
            random_.uniform(0.0, 3.0));
    }
  }

  /// Looks at an item from 1 to 5 m, up to 60 degrees from the normal, from within the room.
  void chooseView() {
    if (scene_.items.empty()) scene_.items.push_back({HouseItem::kPicture, -0.5, 0.5, 0.8, 1.6, 0.0});
    scene_.looked_at = static_cast<std::size_t>(random_.uniform() * static_cast<double>(scene_.items.size()));
    const Eigen::Vector3d centre = scene_.items[scene_.looked_at].centre_m();
    Eigen::Vector3d at = Eigen::Vector3d(-2.0, centre.y(), 1.1);
    for (int tries = 0; tries < 100; ++tries) {
      const double distance_m = random_.uniform(1.0, 5.0), angle = random_.uniform(-60.0, 60.0) * kRadPerDeg;
      const Eigen::Vector3d from(-distance_m * std::cos(angle), centre.y() + distance_m * std::sin(angle),
                                 random_.uniform(0.7, 1.6));
      if (from.x() < -depth_m_ + 0.4 || std::abs(from.y()) > half_m_ - 0.4) continue;
      at = from;
      break;
    }
    const Eigen::Vector2d look = (centre - at).head<2>();
    scene_.distance_m = look.norm();
    scene_.incidence_rad = std::abs(std::atan2(look.y(), look.x()));
    const double yaw = std::atan2(look.y(), look.x()) + random_.gaussian(5.0) * kRadPerDeg;
    scene_.T_house_body = {turned(random_.gaussian(1.5) * kRadPerDeg, random_.gaussian(1.5) * kRadPerDeg, yaw), at};
    const Eigen::Quaterniond R_house_camera = scene_.T_house_camera().rotation;
    const Eigen::Quaterniond R_level = turned(0.0, 0.0, -common::yawOf(R_house_camera)) * R_house_camera;
    scene_.R_level_camera =
        turned(random_.gaussian(0.5) * kRadPerDeg, random_.gaussian(0.5) * kRadPerDeg, 0.0) * R_level;
  }

  /// Not where the vehicle is.
  void layFurniture() {
    for (int i = 0; i < style_.furniture; ++i) {
      const double x = random_.uniform(-depth_m_ + 0.5, -0.3), y = random_.uniform(-half_m_ + 0.3, half_m_ - 0.3);
      const Eigen::Vector3d half(random_.uniform(0.15, 0.5), random_.uniform(0.15, 0.5), 0.0);
      const Eigen::Vector2d off = Eigen::Vector2d(x, y) - scene_.T_house_body.position_m.head<2>();
      const double height_m = random_.uniform(0.3, 1.9), yaw = random_.chance(0.5) ? 0.0 : random_.uniform(0.0, 3.0);
      if (off.norm() > 1.2)
        add("furniture", Eigen::Vector3d(x, y, 0.0) - half, Eigen::Vector3d(x, y, height_m) + half, yaw);
    }
  }

  const HouseStyle& style_;
  RandomStream random_;
  HouseScene scene_;
  double wall_m_ = 0.0, ceiling_m_ = 0.0, half_m_ = 0.0, depth_m_ = 0.0;
};

simulation::RgbdErrorsConfig cameraErrors() {
  simulation::RgbdErrorsConfig errors;
  errors.dark_range_m = 3.0;  // The middle of config/nature/real.yaml, as the next two.
  errors.glancing_deg = 80.0;
  errors.edge_hole_rate = 0.3;
  return errors;
}

common::RgbdCameraConfig flyingXtion() {
  common::RgbdCameraConfig camera;  // As config/sensors/xtion.yaml.
  camera.inverse_depth_noise_1_m = 0.001425;
  camera.inverse_depth_step_1_m = 0.00285;
  return camera;
}

constexpr double kFarthest_m = 60.0;

/// The length of a ray up to what it shows: reflected by mirrors. Below 0 where a mirror returns nothing.
double length_m(const HouseScene& scene, const simulation::RayCaster& rays, simulation::Ray ray, simulation::Hit hit) {
  double length_m = hit.distance_m;
  for (int i = 0; i < 4 && hit; ++i) {
    if (scene.world.shapes[static_cast<std::size_t>(hit.shape)].model != "mirror") return length_m;
    if (scene.blind_mirror) return -1.0;
    const Eigen::Vector3f at = ray.origin_world_m + static_cast<float>(hit.distance_m) * ray.direction_world;
    ray.direction_world -= 2.0F * ray.direction_world.dot(hit.normal_world) * hit.normal_world;
    ray.origin_world_m = at + 1e-3F * hit.normal_world;
    hit = rays.cast(ray.origin_world_m.cast<double>(), ray.direction_world.cast<double>(), kFarthest_m, {});
    length_m += hit.distance_m;
  }
  return length_m;
}

/// From the body's pose, turned by an angle.
common::LaserScan scanOf(const HouseScene& scene, const simulation::RayCaster& rays, double turned_rad) {
  RandomStream random(scene.seed, turned_rad > 0.0 ? "house scan behind" : "house scan", scene.index);
  common::LaserScan scan;
  scan.angle_min_rad = -135.0 * kRadPerDeg;
  scan.angle_increment_rad = 0.25 * kRadPerDeg;
  scan.range_min_m = 0.1;
  scan.range_max_m = 30.0;
  const Pose3 T_house_laser = scene.T_house_body * kT_body_laser;
  for (int beam = 0; beam < 1081; ++beam) {
    const double angle = turned_rad + scan.angle_min_rad + beam * scan.angle_increment_rad;
    const Eigen::Vector3d direction = T_house_laser.rotation * Eigen::Vector3d(std::cos(angle), std::sin(angle), 0.0);
    const simulation::Ray ray{T_house_laser.position_m.cast<float>(), direction.cast<float>()};
    const simulation::Hit hit = rays.cast(T_house_laser.position_m, direction, kFarthest_m, {});
    const double range_m = length_m(scene, rays, ray, hit) + random.gaussian(0.01);
    scan.ranges_m.push_back(range_m < 0.1    ? 0.0F
                            : range_m > 30.0 ? std::numeric_limits<float>::infinity()
                                             : static_cast<float>(range_m));
  }
  return scan;
}

}  // namespace

Pose3 HouseScene::T_house_camera() const { return T_house_body * T_body_camera(); }
Pose3 HouseScene::T_camera_laser() const { return T_body_camera().inverse() * kT_body_laser; }

HouseScene drawHouse(Houses houses, std::uint64_t seed, std::uint64_t index) {
  return Builder(houses, seed, index).build();
}

std::vector<HouseScene> looksAround(const HouseScene& scene, const simulation::RayCaster& rays) {
  constexpr double kStep_m = 0.3, kFree_m = 0.4;
  const Eigen::Vector3d centre = scene.items[scene.looked_at].centre_m();
  std::vector<HouseScene> looks;
  for (int i = -3; i <= 3; ++i) {
    RandomStream random(scene.seed, "look", scene.index * 16 + static_cast<std::uint64_t>(i + 3));
    HouseScene one = scene;
    Eigen::Vector3d& at = one.T_house_body.position_m;
    at.y() += kStep_m * i;
    const Eigen::Vector3d towards = at - scene.T_house_body.position_m;
    const bool blocked = i != 0 && rays.cast(scene.T_house_body.position_m, towards.normalized(), 5.0, {}).distance_m <
                                       towards.norm() + kFree_m;
    if (blocked || rays.nearest(at, kFree_m).distance_m < kFree_m) continue;
    const double yaw = std::atan2(centre.y() - at.y(), centre.x() - at.x()) + random.gaussian(3.0) * kRadPerDeg;
    one.T_house_body.rotation = turned(random.gaussian(1.5) * kRadPerDeg, random.gaussian(1.5) * kRadPerDeg, yaw);
    const Eigen::Quaterniond R_house_camera = one.T_house_camera().rotation;
    one.R_level_camera = turned(random.gaussian(0.5) * kRadPerDeg, random.gaussian(0.5) * kRadPerDeg, 0.0) *
                         turned(0.0, 0.0, -common::yawOf(R_house_camera)) * R_house_camera;
    one.index = scene.index * 16 + static_cast<std::uint64_t>(i + 3);
    looks.push_back(std::move(one));
  }
  return looks;
}

HouseView look(const HouseScene& scene, const simulation::RayCaster& rays) {
  const common::RgbdCameraConfig config = flyingXtion();
  const simulation::DepthSensor sensor(config, cameraErrors(), scene.seed);
  const common::PinholeCamera camera = config.camera();
  const Pose3 T_house_camera = scene.T_house_camera();
  simulation::SeenImage seen{camera.width_px, camera.height_px, {}, {}, {}, {}};
  std::vector<simulation::Ray> row(static_cast<std::size_t>(camera.width_px));
  std::vector<simulation::Hit> hits(row.size());
  for (int v = 0; v < camera.height_px; ++v) {
    for (int u = 0; u < camera.width_px; ++u)
      row[static_cast<std::size_t>(u)] = {
          T_house_camera.position_m.cast<float>(),
          (T_house_camera.rotation * camera.point_camera_m(u, v, 1.0)).normalized().cast<float>()};
    rays.castAll(row, kFarthest_m, {}, std::span(hits));
    for (int u = 0; u < camera.width_px; ++u) {
      const auto pixel = static_cast<std::size_t>(u);
      const double range_m = length_m(scene, rays, row[pixel], hits[pixel]);
      const simulation::Hit& hit = hits[pixel];
      simulation::SeenSurface surface;
      if (hit) {
        surface.reflectance = scene.world.shapes[static_cast<std::size_t>(hit.shape)].color.mean();
        surface.cos_incidence = std::abs(row[pixel].direction_world.dot(hit.normal_world));
      }
      seen.depth_m.push_back(static_cast<float>(range_m / camera.point_camera_m(u, v, 1.0).norm()));
      seen.is_weak.push_back(range_m < 0.0 || (hit && sensor.isWeak(static_cast<float>(range_m), surface)) ? 1 : 0);
    }
  }
  // Beyond every surface the camera reports what is too far, as of a surface there.
  for (float& depth_m : seen.depth_m)
    if (!std::isfinite(depth_m)) depth_m = static_cast<float>(kFarthest_m);
  HouseView view;
  view.frame.camera = camera;
  view.frame.depth = sensor.measure(scene.index, seen);
  view.scan = scanOf(scene, rays, 0.0);
  const common::LaserScan before = scanOf(scene, rays, std::numbers::pi);
  for (std::size_t i = 0; i < before.ranges_m.size(); ++i) {
    const auto range_m = static_cast<double>(before.ranges_m[i]);
    const double angle = std::numbers::pi + before.angle_min_rad + static_cast<double>(i) * before.angle_increment_rad;
    if (range_m > 0.0 && std::isfinite(range_m))
      view.behind_m.push_back(scene.T_camera_laser() *
                              Eigen::Vector3d(range_m * std::cos(angle), range_m * std::sin(angle), 0.0));
  }
  return view;
}

ItemInView inView(const HouseScene& scene, const PlacedItem& item, const simulation::RayCaster& rays) {
  const common::PinholeCamera camera = flyingXtion().camera();
  const Pose3 T_house_camera = scene.T_house_camera(), T_camera_house = T_house_camera.inverse();
  const auto isSeen = [&](const Eigen::Vector3d& point) {
    const Eigen::Vector3d in_camera = T_camera_house * point;
    if (in_camera.x() < 0.1) return false;
    const Eigen::Vector2d pixel = camera.pixel(in_camera);
    if (pixel.minCoeff() < 0.0 || pixel.x() > camera.width_px - 1 || pixel.y() > camera.height_px - 1) return false;
    const Eigen::Vector3d towards = point - T_house_camera.position_m;
    return rays.cast(T_house_camera.position_m, towards.normalized(), kFarthest_m, {}).distance_m >
           towards.norm() - 0.15;
  };
  constexpr int kSteps = 8;
  // The wall beside it belongs to it: without that it is no opening.
  constexpr double kAround_m = 0.08;
  int inside = 0, around = 0;
  for (int i = 0; i <= kSteps; ++i)
    for (int j = 0; j <= kSteps; ++j) {
      const bool rim = i == 0 || j == 0 || i == kSteps || j == kSteps;
      const auto between = [&](double low, double high, int step) {
        const double grow = rim ? kAround_m : 0.0;
        return low - grow + (high - low + 2.0 * grow) * step / kSteps;
      };
      const double z = std::max(0.02, between(item.bottom_m, item.top_m, j));
      if (!isSeen({-0.01, between(item.right_m, item.left_m, i), z})) continue;
      ++(rim ? around : inside);
    }
  const int rim_all = 4 * kSteps, inside_all = (kSteps - 1) * (kSteps - 1);
  ItemInView seen;
  seen.whole = around >= 0.9 * rim_all && inside >= 0.95 * inside_all;
  seen.partly = inside >= 0.1 * inside_all;
  std::array<Eigen::Vector2d, 4> corners;
  const std::array<Eigen::Vector3d, 4> places = {{{0.0, item.right_m, item.bottom_m},
                                                  {0.0, item.left_m, item.bottom_m},
                                                  {0.0, item.left_m, item.top_m},
                                                  {0.0, item.right_m, item.top_m}}};
  for (std::size_t i = 0; i < 4; ++i) {
    const Eigen::Vector3d in_camera = T_camera_house * places[i];
    if (in_camera.x() < 0.1) return seen;
    corners[i] = camera.pixel(in_camera);
  }
  double twice = 0.0;
  for (std::size_t i = 0; i < 4; ++i) {
    const Eigen::Vector2d &a = corners[i], &b = corners[(i + 1) % 4];
    twice += a.x() * b.y() - a.y() * b.x();
  }
  seen.size_px = std::sqrt(0.5 * std::abs(twice));
  return seen;
}

}  // namespace swiftlet::perception

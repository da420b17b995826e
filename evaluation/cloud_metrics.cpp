#include "evaluation/cloud_metrics.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <utility>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include "common/quantile.hpp"
#include "common/rgbd_frame.hpp"

namespace swiftlet::evaluation {
namespace {

using common::Pose3;

/// Every n-th of a list, so that at most `most` remain.
template <typename Value>
std::vector<Value> thinned(const std::vector<Value>& all, std::size_t most) {
  const std::size_t step = (all.size() + most - 1) / most;
  std::vector<Value> some;
  for (std::size_t i = 0; i < all.size(); i += std::max<std::size_t>(1, step)) some.push_back(all[i]);
  return some;
}

/// Points by the cube of kSpacing_m that they are in.
class Cubes {
 public:
  using Key = std::array<std::int32_t, 3>;
  static Key of(const Eigen::Vector3d& point_m) {
    const Eigen::Vector3d cube = (point_m / kSpacing_m).array().floor();
    return {static_cast<std::int32_t>(cube.x()), static_cast<std::int32_t>(cube.y()),
            static_cast<std::int32_t>(cube.z())};
  }
  struct Hash {
    std::size_t operator()(const Key& key) const {
      std::uint64_t hash = 0;
      for (const std::int32_t part : key) hash = (hash ^ static_cast<std::uint32_t>(part)) * 0x9e3779b97f4a7c15U;
      return static_cast<std::size_t>(hash ^ (hash >> 29U));
    }
  };
  template <typename Value>
  using Map = std::unordered_map<Key, Value, Hash>;
};
/// Of points of a cloud: a large one twice would take as much memory as the map that is judged.
using Indices = std::vector<std::uint32_t>;

/// The normal equations of one pull towards the surfaces, about the middle of the cloud.
struct Pull {
  Eigen::Matrix<double, 6, 6> information = Eigen::Matrix<double, 6, 6>::Zero();
  Eigen::Matrix<double, 6, 1> gradient = Eigen::Matrix<double, 6, 1>::Zero();

  void add(const Eigen::Vector3d& arm_m, const Eigen::Vector3d& normal, double residual_m) {
    Eigen::Matrix<double, 6, 1> jacobian;
    jacobian << arm_m.cross(normal), normal;
    information += jacobian * jacobian.transpose();
    gradient += jacobian * residual_m;
  }
  /// Whether the surfaces hold the cloud in all directions.
  bool isHeld() const {
    constexpr double kLeastShare = 1e-4;  // Of the best held direction; below, only noise holds it.
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 6, 6>> solver(information, Eigen::EigenvaluesOnly);
    return solver.eigenvalues()[0] > kLeastShare * solver.eigenvalues()[5];
  }
};

}  // namespace

CloudError cloudError(const Cloud& cloud_world_m, const simulation::RayCaster& rays) {
  Cubes::Map<std::size_t> index;
  std::vector<Indices> cubes;  // The map's own order differs between libraries.
  for (std::size_t i = 0; i < cloud_world_m.size(); ++i) {
    const auto [cube, is_new] = index.try_emplace(Cubes::of(cloud_world_m[i]), cubes.size());
    if (is_new) cubes.emplace_back();
    cubes[cube->second].push_back(static_cast<std::uint32_t>(i));
  }
  std::vector<double> distances_m;
  for (const Indices& cube : thinned(cubes, kMostCubes)) {
    const Indices points = thinned(cube, kMostPoints);
    double sum_m = 0.0;
    for (const std::uint32_t i : points) sum_m += rays.nearest(cloud_world_m[i], CloudError::kLimit_m).distance_m;
    distances_m.push_back(sum_m / static_cast<double>(points.size()));
  }
  return {common::quantile(distances_m, 0.5), common::quantile(distances_m, 0.95)};
}

Pose3 alignment(const Cloud& cloud_world_m, const simulation::RayCaster& rays) {
  constexpr int kIterations = 20;
  constexpr std::size_t kPoints = 5000;
  // Pairs farther than kOutlier medians do not count, after the adaptive threshold of Zhang 1994 (IJCV 13:2).
  constexpr double kReach_m = 0.5, kOutlier = 3.0, kLeastReach_m = 0.03;
  const Cloud cloud = thinned(cloud_world_m, kPoints);
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& point : cloud) middle += point / static_cast<double>(cloud.size());
  Pose3 T;
  double reach_m = kReach_m;
  for (int i = 0; i < kIterations; ++i) {
    Pull pull;
    std::vector<double> distances_m;
    const Eigen::Vector3d moved_middle = T * middle;
    for (const Eigen::Vector3d& point : cloud) {
      const Eigen::Vector3d moved = T * point;
      const simulation::NearestSurface surface = rays.nearest(moved, reach_m);
      if (surface.shape == simulation::Hit::kNothing) continue;
      distances_m.push_back(surface.distance_m);
      pull.add(moved - moved_middle, surface.normal_world, surface.normal_world.dot(moved - surface.point_world_m));
    }
    if (distances_m.size() < cloud.size() / 2 || !pull.isHeld()) return Pose3{};
    const Eigen::Matrix<double, 6, 1> step = -pull.information.ldlt().solve(pull.gradient);
    const Eigen::Quaterniond turn = common::expSO3(step.head<3>());
    T = Pose3{turn, moved_middle + step.tail<3>() - turn * moved_middle} * T;
    reach_m = std::clamp(kOutlier * common::quantile(distances_m, 0.5), kLeastReach_m, kReach_m);
    if (step.norm() < 1e-6) break;
  }
  return T;
}

Cloud surfacesInView(const common::RgbdCameraConfig& camera, const std::vector<Pose3>& T_world_camera,
                     const simulation::RayCaster& rays) {
  constexpr int kColumns = 40, kRows = 30;  // A ray each 1.5 deg: 13 cm apart at 5 m.
  const common::PinholeCamera pinhole = camera.camera();
  const double least_cos = std::cos(kGlancing_deg * common::kRadPerDeg);
  struct Seen {
    Eigen::Vector3d point;
    std::size_t last_pose = 0;
    int poses = 0;
  };
  Cubes::Map<Seen> seen;
  std::vector<Cubes::Key> order;  // The map's own order differs between libraries.
  for (std::size_t pose = 0; pose < T_world_camera.size(); ++pose)
    for (int ray = 0; ray < kColumns * kRows; ++ray) {
      const int column = ray % kColumns, row = ray / kColumns;
      const double u_px = (column + 0.5) / kColumns * pinhole.width_px - 0.5;
      const double v_px = (row + 0.5) / kRows * pinhole.height_px - 0.5;
      const Eigen::Vector3d along = pinhole.point_camera_m(u_px, v_px, 1.0);
      const Eigen::Vector3d direction = T_world_camera[pose].rotation * along.normalized();
      const simulation::Hit hit =
          rays.cast(T_world_camera[pose].position_m, direction, camera.range_max_m * along.norm());
      if (!hit || hit.distance_m < camera.range_min_m * along.norm()) continue;
      if (-hit.normal_world.cast<double>().dot(direction) < least_cos) continue;
      const Eigen::Vector3d point = T_world_camera[pose].position_m + hit.distance_m * direction;
      const auto [entry, is_new] = seen.try_emplace(Cubes::of(point), Seen{point, pose, 1});
      if (is_new) order.push_back(entry->first);
      if (std::exchange(entry->second.last_pose, pose) != pose) ++entry->second.poses;
    }
  Cloud places;
  for (const Cubes::Key& key : order)
    if (const Seen& one = seen.at(key); one.poses >= 2) places.push_back(one.point);
  return places;
}

double shareCovered(const Cloud& places_m, const Cloud& cloud_m) {
  if (places_m.empty()) return 1.0;
  Cubes::Map<Indices> cubes;
  for (std::size_t i = 0; i < cloud_m.size(); ++i)
    cubes[Cubes::of(cloud_m[i])].push_back(static_cast<std::uint32_t>(i));
  const auto isCovered = [&](const Eigen::Vector3d& place) {
    const Cubes::Key at = Cubes::of(place);
    for (int i = 0; i < 27; ++i) {
      const auto cube = cubes.find({at[0] + i % 3 - 1, at[1] + i / 3 % 3 - 1, at[2] + i / 9 - 1});
      if (cube == cubes.end()) continue;
      for (const std::uint32_t point : cube->second)
        if ((cloud_m[point] - place).squaredNorm() <= kSpacing_m * kSpacing_m) return true;
    }
    return false;
  };
  const auto covered = std::count_if(places_m.begin(), places_m.end(), isCovered);
  return static_cast<double>(covered) / static_cast<double>(places_m.size());
}

}  // namespace swiftlet::evaluation

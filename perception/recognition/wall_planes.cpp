#include "perception/recognition/wall_planes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include <Eigen/LU>

namespace swiftlet::perception {
namespace {

/// Every so many pixels one is looked at: 4,800 of an image of 320x240 fix a plane to a fraction of a pixel's noise.
constexpr int kEvery_px = 4;
/// The neighbours above and below are this far away (angle): at 5 m they are 0.14 m away and the camera's noise 0.04 m.
constexpr double kNeighbour_rad = 0.028;
/// Greatest tangent of the slope between the neighbours: three sigmas of that noise at 5 m.
constexpr double kSlope = 0.5;
/// Steps of the transform: half of what the fit catches at 5 m.
constexpr int kHeadings = 180;
constexpr double kDistanceStep_m = 0.08;
/// Beyond this incidence a wall of a house shows no opening.
constexpr double kIncidence_rad = 80.0 * std::numbers::pi / 180.0;
/// Within this distance, beside three sigmas, a pixel may belong to the plane of a maximum, and to the fitted one.
constexpr double kCatch_m = 0.10, kFit_m = 0.03;
constexpr int kFits = 4;
/// Less than this is no wall: 0.5 m by 0.5 m.
constexpr double kArea_m2 = 0.25;
constexpr int kWalls = 6;
/// Sine of the tilt that attitude and fit leave of an upright wall: 6 degrees.
constexpr double kTilt = 0.105;

struct UprightPoint {
  Eigen::Vector3d ray;
  double depth_m;
  double area_m2;  ///< Of the pixels that it stands for, across the view.

  Eigen::Vector3d point() const { return depth_m * ray; }
};

std::vector<UprightPoint> uprightPoints(const DepthView& view) {
  const int reach_px = std::max(2, static_cast<int>(std::lround(kNeighbour_rad * view.camera.fy_px)));
  const double pixel_area = kEvery_px * kEvery_px / (view.camera.fx_px * view.camera.fy_px);
  std::vector<UprightPoint> points;
  for (int v = reach_px; v < view.camera.height_px - reach_px; v += kEvery_px)
    for (int u = 0; u < view.camera.width_px; u += kEvery_px) {
      const float above_m = view.depth.at(u, v - reach_px), below_m = view.depth.at(u, v + reach_px);
      const float depth_m = view.depth.at(u, v);
      if (!common::isMeasured(above_m) || !common::isMeasured(below_m) || !common::isMeasured(depth_m)) continue;
      const Eigen::Vector3d between = static_cast<double>(above_m) * view.ray(u, v - reach_px) -
                                      static_cast<double>(below_m) * view.ray(u, v + reach_px);
      if (between.head<2>().norm() > kSlope * between.z()) continue;
      const auto z = static_cast<double>(depth_m);
      points.push_back({view.ray(u, v), z, pixel_area * z * z});
    }
  return points;
}

/// Votes by heading of the normal and distance; a point votes with its depth, between its area, which grows with the
/// square of it, and the certainty of its place, which falls with it.
class Votes {
 public:
  explicit Votes(double range_m)
      : distances_(static_cast<int>(range_m / kDistanceStep_m) + 2),
        votes_(static_cast<std::size_t>(kHeadings * distances_), 0.0) {
    for (int i = 0; i < kHeadings; ++i) {
      const double heading_rad = 2.0 * std::numbers::pi * i / kHeadings;
      normals_[static_cast<std::size_t>(i)] = {std::cos(heading_rad), std::sin(heading_rad)};
    }
  }

  void add(const UprightPoint& at) {
    const Eigen::Vector2d place = at.point().head<2>();
    const double least_m = std::cos(kIncidence_rad) * place.norm();
    const int facing =
        static_cast<int>(std::lround(std::atan2(place.y(), place.x()) * kHeadings / (2.0 * std::numbers::pi)));
    for (int i = facing - kHeadings / 4; i <= facing + kHeadings / 4; ++i) {
      const int heading = (i + kHeadings) % kHeadings;
      const double distance_m = normals_[static_cast<std::size_t>(heading)].dot(place);
      if (distance_m < least_m) continue;
      const int step = static_cast<int>(distance_m / kDistanceStep_m);
      if (step < distances_) votes_[index(heading, step)] += at.depth_m;
    }
  }

  /// Normal times distance of the maximum, each cell taken with its neighbours; nullopt without a vote.
  std::optional<Eigen::Vector2d> maximum() const {
    double most = 0.0;
    std::optional<Eigen::Vector2d> best;
    for (int heading = 0; heading < kHeadings; ++heading)
      for (int step = 1; step + 1 < distances_; ++step) {
        double sum = 0.0;
        for (const int beside : {kHeadings - 1, 0, 1})
          for (const int nearby : {-1, 0, 1}) sum += votes_[index((heading + beside) % kHeadings, step + nearby)];
        if (!(sum > most)) continue;
        most = sum;
        best = (step + 0.5) * kDistanceStep_m * normals_[static_cast<std::size_t>(heading)];
      }
    return best;
  }

 private:
  std::size_t index(int heading, int step) const { return static_cast<std::size_t>(heading * distances_ + step); }

  int distances_;
  std::vector<double> votes_;
  std::array<Eigen::Vector2d, kHeadings> normals_;
};

double offPlane_1_m(const WallPlane& plane, const UprightPoint& at) {
  return plane.inverse_1_m.dot(at.ray) - 1.0 / at.depth_m;
}

bool isNear(const WallPlane& plane, const UprightPoint& at, double within_m, double sigma_1_m) {
  const double within_1_m = std::max(3.0 * sigma_1_m, within_m / (at.depth_m * at.depth_m));
  return std::abs(offPlane_1_m(plane, at)) < within_1_m;
}

/// Least squares over the inverse depths near the plane; the area of these points across the view in `area_m2`.
WallPlane fitted(const std::vector<UprightPoint>& points, const WallPlane& start, double within_m, double sigma_1_m,
                 double& area_m2) {
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  area_m2 = 0.0;
  for (const UprightPoint& at : points) {
    if (!isNear(start, at, within_m, sigma_1_m)) continue;
    squares += at.ray * at.ray.transpose();
    sum += at.ray / at.depth_m;
    area_m2 += at.area_m2;
  }
  // Points of one row or column fix no slope across it: the start stays there.
  constexpr double kHeldBy = 1e-3;
  squares.diagonal().array() += kHeldBy;
  const Eigen::Matrix3d inverse = squares.inverse();
  return {inverse * (sum + kHeldBy * start.inverse_1_m), sigma_1_m * sigma_1_m * inverse};
}

}  // namespace

std::vector<WallPlane> findWalls(const DepthView& view) {
  std::vector<UprightPoint> points = uprightPoints(view);
  std::vector<WallPlane> walls;
  for (int i = 0; i < kWalls; ++i) {
    Votes votes(view.range_max_m);
    for (const UprightPoint& at : points) votes.add(at);
    const auto at = votes.maximum();
    if (!at) break;
    WallPlane wall;
    wall.inverse_1_m.head<2>() = *at / at->squaredNorm();
    double area_m2 = 0.0;
    for (int fit = 0; fit < kFits; ++fit)
      wall = fitted(points, wall, fit == 0 ? kCatch_m : kFit_m, view.inverse_depth_sigma_1_m, area_m2);
    const double sigma_1_m = view.inverse_depth_sigma_1_m;
    const auto removed =
        std::erase_if(points, [&](const UprightPoint& one) { return isNear(wall, one, kCatch_m, sigma_1_m); });
    if (removed == 0) break;
    if (area_m2 >= kArea_m2 && std::abs(wall.normal().z()) < kTilt) walls.push_back(wall);
  }
  return walls;
}

}  // namespace swiftlet::perception

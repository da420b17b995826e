// The truncated signed distance and its mesh, against rooms and balls whose surfaces are known exactly, and against a
// volume that is drawn voxel by voxel in the obvious way.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "mapping3d/surface/surface_net.hpp"
#include "mapping3d/surface/tsdf_volume.hpp"
#include "tests/mapping3d/rooms.hpp"

namespace swiftlet::mapping3d {
namespace {

using common::Pose3;
using common::RgbdFrame;
using common::SurfaceMesh;
using Eigen::Vector3d;

constexpr std::array<std::uint8_t, 3> kRed{200, 40, 10};

RgbdFrame frameOf(common::DepthImage depth, const common::PinholeCamera& camera) {
  RgbdFrame frame;
  frame.camera = camera;
  frame.color = {camera.width_px, camera.height_px, {}};
  for (int i = 0; i < camera.pixels(); ++i) frame.color.rgb.insert(frame.color.rgb.end(), kRed.begin(), kRed.end());
  frame.depth = std::move(depth);
  return frame;
}

/// Of a ball at the origin; what is beside it is too far.
RgbdFrame ballFrame(const Pose3& T_map_camera, double radius_m) {
  const common::PinholeCamera camera = xtion();
  common::DepthImage depth{camera.width_px, camera.height_px, {}};
  for (int v = 0; v < camera.height_px; ++v)
    for (int u = 0; u < camera.width_px; ++u) {
      const Vector3d ray = T_map_camera.rotation * camera.point_camera_m(u, v, 1.0), &from = T_map_camera.position_m;
      const double a = ray.squaredNorm(), b = ray.dot(from), c = from.squaredNorm() - radius_m * radius_m;
      const double root = b * b - a * c;
      depth.depth_m.push_back(root < 0.0 ? common::DepthImage::kTooFar
                                         : static_cast<float>((-b - std::sqrt(root)) / a));
    }
  return frameOf(std::move(depth), camera);
}

/// Looking at the origin from this place.
Pose3 lookingAtOrigin(const Vector3d& from_m) {
  return {Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitX(), -from_m), from_m};
}

TsdfVolume ballVolume(double radius_m, double resolution_m) {
  TsdfVolume volume({resolution_m});
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-1.0, 1.0})
      volume.integrate(ballFrame(lookingAtOrigin(side * 1.6 * Vector3d::Unit(axis)), radius_m),
                       lookingAtOrigin(side * 1.6 * Vector3d::Unit(axis)));
  return volume;
}

/// Enclosed by triangles that are counter-clockwise from outside (divergence theorem).
double volume_m3(const SurfaceMesh& mesh) {
  double sum = 0.0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const auto at = [&](std::uint32_t i) -> Vector3d { return mesh.vertices[i].position_m.cast<double>(); };
    sum += at(a).dot(at(b).cross(at(c)));
  }
  return sum / 6.0;
}

/// How many triangles have each edge, by direction.
std::map<std::pair<std::uint32_t, std::uint32_t>, int> edgesOf(const SurfaceMesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (const auto& [a, b, c] : mesh.triangles)
    for (const auto& edge : {std::pair(a, b), std::pair(b, c), std::pair(c, a)}) ++edges[edge];
  return edges;
}

TEST(SurfaceNet, ABallSeenFromSixSidesIsClosedAndRightToAFractionOfAVoxel) {
  constexpr double kRadius_m = 0.5, kResolution_m = 0.02;
  const SurfaceMesh mesh = surfaceNet(ballVolume(kRadius_m, kResolution_m));
  ASSERT_GT(mesh.triangles.size(), 10'000u);
  double greatest_m = 0.0;
  for (const SurfaceMesh::Vertex& vertex : mesh.vertices) {
    greatest_m = std::max(greatest_m, std::abs(static_cast<double>(vertex.position_m.norm()) - kRadius_m));
    EXPECT_EQ(vertex.rgb, kRed);
  }
  EXPECT_LT(greatest_m, 0.5 * kResolution_m);
  const double ball_m3 = 4.0 / 3.0 * std::numbers::pi * std::pow(kRadius_m, 3);
  EXPECT_NEAR(volume_m3(mesh), ball_m3, 0.02 * ball_m3);
  const auto edges = edgesOf(mesh);
  std::size_t open = 0;
  for (const auto& [edge, count] : edges) {
    const auto other = edges.find(std::pair(edge.second, edge.first));
    open += other == edges.end() || other->second != count ? 1 : 0;
  }
  RecordProperty("open_edges", std::to_string(open));
  EXPECT_LE(open, edges.size() / 1000) << "each side of a triangle has another on it";
}

/// From the nearest wall or box.
double distance_m(const Room& room, const Vector3d& point_m) {
  double least_m = (point_m - room.walls.min()).cwiseMin(room.walls.max() - point_m).cwiseAbs().minCoeff();
  for (const Eigen::AlignedBox3d& box : room.boxes) {
    const double inside_m = (point_m - box.min()).cwiseMin(box.max() - point_m).minCoeff();
    least_m = std::min(least_m, inside_m > 0.0 ? inside_m : box.exteriorDistance(point_m));
  }
  return least_m;
}

struct Deviation {
  double share_beyond_half = 0.0;  ///< Of the vertices, farther than half a voxel.
  double greatest_m = 0.0;
};
Deviation deviationOf(const SurfaceMesh& mesh, const Room& room, double resolution_m) {
  Deviation deviation;
  for (const SurfaceMesh::Vertex& vertex : mesh.vertices) {
    const double off_m = distance_m(room, T_map_room.inverse() * vertex.position_m.cast<double>());
    deviation.greatest_m = std::max(deviation.greatest_m, off_m);
    deviation.share_beyond_half += off_m > 0.5 * resolution_m ? 1.0 : 0.0;
  }
  deviation.share_beyond_half /= static_cast<double>(mesh.vertices.size());
  return deviation;
}

TEST(SurfaceNet, RoomsAreRightToHalfAVoxelButForEdgesSeenFromBehind) {
  for (unsigned seed = 1; seed <= 3; ++seed) {
    std::mt19937 random(seed);
    const Room room = randomRoom(random);
    TsdfVolume volume({0.04});
    for (int i = 0; i < 12; ++i) {
      const Pose3 T_room_camera = randomView(room, random);
      volume.integrate(frameOf(depthImage(room, xtion(), T_room_camera, random), xtion()), T_map_room * T_room_camera);
    }
    const SurfaceMesh mesh = surfaceNet(volume);
    ASSERT_GT(mesh.vertices.size(), 3'000u);
    const Deviation deviation = deviationOf(mesh, room, 0.04);
    RecordProperty("beyond_half_a_voxel_" + std::to_string(seed), std::to_string(deviation.share_beyond_half));
    EXPECT_LT(deviation.share_beyond_half, 0.01) << seed;
    EXPECT_LT(deviation.greatest_m, 4.0 * 0.04) << seed << ": the truncation";
  }
}

/// What a shelf at 0.4 m shows with voxels of 5 mm and codes of a millimetre.
TEST(SurfaceNet, AShelfAtFortyCentimetresIsWithinFiveMillimetresOfItsDepths) {
  Room room;
  for (int i = 0; i < 4; ++i)
    room.boxes.emplace_back(Vector3d(0.4, -0.25 + 0.13 * i, 0.9), Vector3d(0.6, -0.2 + 0.13 * i, 1.3));
  room.boxes.emplace_back(Vector3d(0.7, -1.0, 0.5), Vector3d(0.8, 1.0, 1.6));
  const common::PinholeCamera camera{320, 240, 262.5, 262.5, 159.5, 119.5};
  std::mt19937 random(1);
  TsdfVolume volume({0.005});
  common::DepthImage seen;
  for (const double aside_m : {-0.02, -0.01, 0.0, 0.01, 0.02}) {
    const Pose3 T_room_camera{Eigen::Quaterniond::Identity(), {0.0, aside_m, 1.1}};
    seen = depthImage(room, camera, T_room_camera, random);
    for (float& depth_m : seen.depth_m) depth_m = std::round(1000.0F * depth_m) / 1000.0F;
    volume.integrate(frameOf(seen, camera), T_map_room * T_room_camera);
  }
  const SurfaceMesh mesh = surfaceNet(volume);
  EXPECT_GT(mesh.vertices.size(), 5'000u);
  double beyond = 0.0;
  for (const SurfaceMesh::Vertex& vertex : mesh.vertices)
    beyond += distance_m(room, T_map_room.inverse() * vertex.position_m.cast<double>()) > 0.005 ? 1.0 : 0.0;
  EXPECT_LT(beyond / static_cast<double>(mesh.vertices.size()), 0.005);
}

/// What stood there and has gone is erased by views through it (Curless and Levoy, section 4).
TEST(TsdfVolume, WhatIsSeenThroughIsErased) {
  std::mt19937 random(1);
  const Room empty;
  Room with_box = empty;
  with_box.boxes.emplace_back(Vector3d(1.5, -0.4, 0.6), Vector3d(1.9, 0.4, 1.6));
  const Pose3 T_room_camera{Eigen::Quaterniond::Identity(), {0.0, 0.0, 1.1}};
  TsdfVolume volume({0.04});
  const auto see = [&](const Room& room) {
    volume.integrate(frameOf(depthImage(room, xtion(), T_room_camera, random), xtion()), T_map_room * T_room_camera);
  };
  const auto onBox = [&] {
    std::size_t count = 0;
    for (const SurfaceMesh::Vertex& vertex : surfaceNet(volume).vertices)
      count += with_box.boxes[0].exteriorDistance(T_map_room.inverse() * vertex.position_m.cast<double>()) < 0.05;
    return count;
  };
  see(with_box);
  ASSERT_GT(onBox(), 300u);
  for (int i = 0; i < 12; ++i) see(empty);
  EXPECT_EQ(onBox(), 0u);
}

/// The truncated distances of all frames, for one voxel at a time and without leaving anything out.
struct SlowVoxel {
  double sum = 0.0, weight = 0.0;
};
SlowVoxel slowVoxel(const std::vector<std::pair<RgbdFrame, Pose3>>& frames, const Vector3d& center_m,
                    const TsdfConfig& config) {
  SlowVoxel voxel;
  for (const auto& [frame, T_map_camera] : frames) {
    const Vector3d point = T_map_camera.inverse() * center_m;
    if (point.x() <= 0.0) continue;
    const Eigen::Vector2d pixel = frame.camera.pixel(point);
    const int u = static_cast<int>(std::floor(pixel.x())), v = static_cast<int>(std::floor(pixel.y()));
    if (u < 0 || v < 0 || u + 1 >= frame.camera.width_px || v + 1 >= frame.camera.height_px) continue;
    const double across = pixel.x() - u, down = pixel.y() - v;
    const double depth_m = (1 - down) * ((1 - across) * frame.depth.at(u, v) + across * frame.depth.at(u + 1, v)) +
                           down * ((1 - across) * frame.depth.at(u, v + 1) + across * frame.depth.at(u + 1, v + 1));
    const double sigma_m = config.noise.sigma_m(depth_m), r = config.resolution_m;
    const double truncation_m = std::max(4.0 * r, 3.0 * sigma_m);
    const double distance_m = (depth_m - point.x()) * point.norm() / point.x();
    if (distance_m < -truncation_m) continue;
    const double behind = distance_m < -r ? (truncation_m + distance_m) / (truncation_m - r) : 1.0;
    const double weight = behind / (sigma_m * sigma_m + r * r / 12.0);
    voxel.sum += weight * std::min(distance_m, truncation_m);
    voxel.weight += weight;
  }
  return voxel;
}

/// In a room without boxes all pixels show one surface or a corner of two.
TEST(TsdfVolume, AgreesWithTheObviousMeanInEveryVoxel) {
  std::mt19937 random(7);
  const Room room;
  const TsdfConfig config{0.05};
  TsdfVolume volume(config);
  std::vector<std::pair<RgbdFrame, Pose3>> frames;
  for (int i = 0; i < 4; ++i) {
    const Pose3 T_room_camera = randomView(room, random);
    frames.emplace_back(frameOf(depthImage(room, smallCamera(), T_room_camera, random), smallCamera()),
                        T_map_room * T_room_camera);
    // Nothing beyond the range, which the obvious mean does not know.
    for (float& depth_m : frames.back().first.depth.depth_m) depth_m = std::min(depth_m, 4.9F);
    volume.integrate(frames.back().first, frames.back().second);
  }
  std::size_t compared = 0, differ = 0;
  for (const common::VoxelIndex& block : volume.blocks())
    for (int offset = 0; offset < common::VoxelBlock::kVoxels; ++offset) {
      const common::VoxelIndex at = common::VoxelMap::voxelOf(block, offset);
      const TsdfVoxel& voxel = volume.block(block)->voxels[static_cast<std::size_t>(offset)];
      const SlowVoxel slow = slowVoxel(frames, Vector3d(at.x + 0.5, at.y + 0.5, at.z + 0.5) * 0.05, config);
      ++compared;
      // Blocks are made by later frames, too: then the earlier ones are not in the mean.
      const bool same_weight = std::abs(static_cast<double>(voxel.weight_1_m2) - slow.weight) <= 1e-3 * slow.weight;
      const bool same =
          same_weight &&
          (slow.weight == 0.0 || std::abs(static_cast<double>(voxel.distance_m) - slow.sum / slow.weight) < 1e-4);
      differ += same ? 0 : 1;
    }
  EXPECT_GT(compared, 100'000u);
  EXPECT_LT(static_cast<double>(differ), 0.05 * static_cast<double>(compared));
}

TEST(TsdfVolume, IsBoundedAndSaysSo) {
  TsdfConfig config{0.02};
  config.blocks_max = 50;
  TsdfVolume volume(config);
  const Pose3 T_map_camera = lookingAtOrigin({1.6, 0.0, 0.0});
  volume.integrate(ballFrame(T_map_camera, 0.5), T_map_camera);
  EXPECT_EQ(volume.blocks().size(), 50u);
  EXPECT_TRUE(volume.isFull());
  EXPECT_FALSE(ballVolume(0.5, 0.02).isFull());
  EXPECT_TRUE(surfaceNet(TsdfVolume({0.02})).triangles.empty());
}

TEST(TsdfVolume, ReachesAsFarAsItsVoxelsResolveTheNoise) {
  EXPECT_DOUBLE_EQ(TsdfVolume({0.05}).range_m(), 5.0);
  const double range_m = TsdfVolume({0.005}).range_m();
  EXPECT_NEAR(vision::DepthNoiseConfig().sigma_m(range_m), 0.01, 1e-9) << "two voxels";
}

}  // namespace
}  // namespace swiftlet::mapping3d

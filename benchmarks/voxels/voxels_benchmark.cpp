// Depth frames of 320 x 240 pixels into voxels of 5 cm up to 5 m, on one thread: ours beside OctoMap's insertPointCloud
// with its defaults, which discretizes nothing before. Both have the same rays. OctoMap is given the points in the
// frame of the map, so that only our time includes their computation from the depths.
#include <octomap/octomap.h>

#include <memory>
#include <random>
#include <vector>

#include <benchmark/benchmark.h>

#include "mapping3d/voxels/voxel_mapper.hpp"
#include "tests/mapping3d/rooms.hpp"

namespace swiftlet::mapping3d {
namespace {

constexpr int kFrames = 40;
constexpr double kRange_m = 5.0;
constexpr double kResolution_m = 0.05;

struct View {
  common::Pose3 T_map_camera;
  common::DepthImage depth;
};

/// A flight through a room with boxes, a view each few degrees.
std::vector<View> flight(unsigned seed) {
  std::mt19937 random(seed);
  const Room room = randomRoom(random);
  common::Pose3 pose = randomView(room, random);
  std::vector<View> views;
  for (int i = 0; i < kFrames; ++i) {
    const Eigen::Quaterniond turned = common::quaternionFrom({0.02, 0.1, 0.157 * i});
    const common::Pose3 T_room_camera{turned, pose.position_m};
    views.push_back({T_map_room * T_room_camera, depthImage(room, xtion(), T_room_camera, random, 0.05, 0.0)});
  }
  return views;
}

octomap::Pointcloud cloudOf(const View& view) {
  octomap::Pointcloud cloud;
  for (int v = 0; v < xtion().height_px; ++v)
    for (int u = 0; u < xtion().width_px; ++u) {
      const float depth_m = view.depth.at(u, v);
      if (!common::isMeasured(depth_m)) continue;
      const Eigen::Vector3f point_m =
          (view.T_map_camera * xtion().point_camera_m(u, v, static_cast<double>(depth_m))).cast<float>();
      cloud.push_back(point_m.x(), point_m.y(), point_m.z());
    }
  return cloud;
}

void swiftletVoxels(benchmark::State& state) {
  const std::vector<View> views = flight(static_cast<unsigned>(state.range(0)));
  VoxelConfig config;
  config.resolution_m = kResolution_m;
  config.range_max_m = kRange_m;
  std::size_t bytes = 0;
  for (auto _ : state) {
    VoxelMapper mapper(config);
    for (const View& view : views) mapper.insert(view.depth, xtion(), view.T_map_camera);
    bytes = mapper.map().bytes();
  }
  state.counters["MB"] = static_cast<double>(bytes) * 1e-6;
  state.counters["s_a_frame"] =
      benchmark::Counter(kFrames, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void octomapTree(benchmark::State& state) {
  const std::vector<View> views = flight(static_cast<unsigned>(state.range(0)));
  std::vector<octomap::Pointcloud> clouds;
  for (const View& view : views) clouds.push_back(cloudOf(view));
  std::size_t bytes = 0;
  for (auto _ : state) {
    octomap::OcTree tree(kResolution_m);
    for (int i = 0; i < kFrames; ++i) {
      const Eigen::Vector3f origin_m = views[static_cast<std::size_t>(i)].T_map_camera.position_m.cast<float>();
      tree.insertPointCloud(clouds[static_cast<std::size_t>(i)], {origin_m.x(), origin_m.y(), origin_m.z()}, kRange_m);
    }
    bytes = tree.memoryUsage();
  }
  state.counters["MB"] = static_cast<double>(bytes) * 1e-6;
  state.counters["s_a_frame"] =
      benchmark::Counter(kFrames, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

// The argument is the seed of the room. Both are run in turn, so that the load of the machine falls on both.
BENCHMARK(swiftletVoxels)->Arg(1)->Arg(2)->Arg(3)->Unit(benchmark::kMillisecond);
BENCHMARK(octomapTree)->Arg(1)->Arg(2)->Arg(3)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace swiftlet::mapping3d

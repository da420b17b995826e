#include "mapping3d/model/mapper3d.hpp"

#include <algorithm>
#include <cmath>

#include "common/config_fields.hpp"
#include "mapping3d/landmarks/model_icp.hpp"
#include "mapping3d/model/frame_without_people.hpp"

namespace swiftlet::mapping3d {
namespace {

using common::Pose3;
using common::RgbdFrame;

std::unique_ptr<FrameOdometry> makeOdometry(const RgbdOdometryConfig& config) {
  if (config.method == RgbdOdometryConfig::Method::kModelIcp) return std::make_unique<ModelIcp>(config.features);
  return std::make_unique<RgbdOdometry>(config);
}

/// Depths this far away determine turns, and the place only little; beyond, they are mostly wrong.
constexpr double kFarthestOfRecordings_m = 9.0;

}  // namespace

void Mapper3dConfig::describe(common::config::Fields& fields) {
  fields.section("odometry", odometry, "The pose of a frame.");
  fields.section("voxels", voxels, "Occupancy.");
  fields.section("submaps", submaps, "Pieces of the map, which move with the key scans of the 2D map.");
}

Mapper3dConfig configOfRecordings(RgbdOdometryConfig::Method method) {
  Mapper3dConfig config;
  config.odometry.method = method;
  config.odometry.begins_pieces = true;
  config.odometry.features.depth_noise.farthest_m = kFarthestOfRecordings_m;
  return config;
}

Mapper3d::Mapper3d(const Mapper3dConfig& config)
    : config_(config),
      odometry_(makeOdometry(config.odometry)),
      graph_(config.graph),
      submaps_(config.submaps, config.voxels, config.odometry.features.depth_noise) {}

MappedFrame Mapper3d::add(const RgbdFrame& frame, const FrameContext& context) {
  // What hangs on the first key frame must not move when that becomes a node of the graph.
  if (!context.scans && context.seed && graph_.size() == 0) graph_.beginAt(context.seed->T_map_camera);
  odometry_->moveTo(context.scans ? context.scans : graph_.poses());
  const bool mask = !context.people.empty() && context.seed;
  const RgbdFrame masked = mask ? withoutPeople(frame, context.seed->T_map_camera, context.people) : RgbdFrame{};
  const RgbdFrame& still = mask ? masked : frame;
  MappedFrame mapped;
  mapped.pose = odometry_->process(still, context.seed, context.depth_later);
  const RgbdPose& pose = mapped.pose;
  if (!context.scans && pose.isTracked()) grow(mapped);
  if (pose.isTracked())
    submaps_.draw({frame, still, pose.T_map_camera * pose.T_color_depth, pose.scan, context.people,
                   pose.became_key_frame, context.scans ? 0 : graph_.pieceOf(pose.scan)},
                  context.scans ? *context.scans : *graph_.poses());
  mapped.T_scan_camera = odometry_->keyFrames().T_map_scan(pose.scan).inverse() * pose.T_map_camera;
  return mapped;
}

/// The lost frame became a key frame, and hangs on no other one.
void Mapper3d::beginPiece(MappedFrame& mapped) {
  RgbdPose& pose = mapped.pose;
  const KeyFrameMap& keys = odometry_->keyFrames();
  const std::size_t first = keys.size() - (pose.became_key_frame ? 2 : 1);
  mapped.begun = BegunPiece{keys.at(first).stamp, graph_.add(keys.at(first).stamp, keys.placeOf(first).T_map_key, {})};
  odometry_->moveTo(graph_.poses());
  odometry_->hang(first, mapped.begun->scan);
  pose.aligned_to = {mapped.begun->scan};
}

void Mapper3d::grow(MappedFrame& mapped) {
  RgbdPose& pose = mapped.pose;
  if (pose.begins_piece) beginPiece(mapped);
  if (!pose.aligned_to.empty()) pose.scan = pose.aligned_to.front();
  if (!pose.became_key_frame) return;
  const KeyFrameMap& keys = odometry_->keyFrames();
  const auto number = static_cast<int>(graph_.size());
  const auto edges = trackEdges(odometry_->pyramid(), pose, number, keys, config_.odometry);
  pose.scan = graph_.add(pose.stamp, pose.T_map_camera, edges);
  odometry_->moveTo(graph_.poses());
  odometry_->hang(keys.size() - 1, pose.scan);
  checkFocal(pose);
  graph_.adjustNewest();
  const PlaceMatches matches = findPlace(odometry_->pyramid(), pose, keys, config_.odometry, config_.loop_candidates);
  if (!matches.loops.empty()) mapped.loops = graph_.close(matches.loops);
  if (const auto joined = graph_.join(matches.meetings)) {
    odometry_->joinTracks(joined->from, joined->into);
    submaps_.joinPieces(joined->from, joined->into);
  }
  odometry_->moveTo(graph_.poses());
  pose.T_map_camera = keys.T_map_scan(pose.scan);
}

void Mapper3d::checkFocal(const RgbdPose& pose) {
  const KeyFrameMap& keys = odometry_->keyFrames();
  if (focal_.isDone() || keys.size() < 2) return;
  const std::size_t before = keys.size() - 2;
  focal_.add(odometry_->pyramid(), pose, keys.at(before), keys.placeOf(before).T_map_key, config_.odometry);
}

}  // namespace swiftlet::mapping3d

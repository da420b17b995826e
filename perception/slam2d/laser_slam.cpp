#include "perception/slam2d/laser_slam.hpp"

namespace swiftlet::perception {

using common::Pose2;

struct LaserSlam::Impl {
  explicit Impl(const LaserSlamConfig& config) : front_end(config.front_end), graph(config.slam) {
    if (config.method == SlamMethod::kParticles) particles.emplace(config.particles);
  }

  std::optional<TrackedScan> place(const FollowedScan& followed);

  LaserFrontEnd front_end;
  Slam2d graph;
  std::optional<ParticleSlam> particles;
  TrackPieces pieces;
};

LaserSlam::LaserSlam(const LaserSlamConfig& config) : impl_(std::make_unique<Impl>(config)) {}
LaserSlam::~LaserSlam() = default;

std::optional<TrackedScan> LaserSlam::Impl::place(const FollowedScan& followed) {
  if (particles) {
    particles->addScan(followed.scan, followed.T_odom_robot, followed.covariance_since_last);
    if (particles->anchor() < 0) return std::nullopt;
    return TrackedScan{particles->anchor(), particles->T_anchor_body(), followed.matched};
  }
  graph.addScan(followed.scan, followed.T_odom_robot, followed.covariance_since_last);
  if (const auto task = graph.takeTask()) graph.apply(run(*task));
  return TrackedScan{graph.anchor(), graph.T_anchor_body(), followed.matched};
}

std::optional<TrackedScan> LaserSlam::add(const LaserSlamInput& input) {
  const auto followed = impl_->front_end.add(input);
  if (!followed) return std::nullopt;
  const std::uint64_t keys_before = keyScans();
  const std::optional<TrackedScan> tracked = impl_->place(*followed);
  impl_->pieces.add(*followed, keys_before, keyScans());
  return tracked;
}

void LaserSlam::finish() {
  if (impl_->particles) return;  // They know all along.
  if (const auto task = impl_->graph.takeLastTask()) impl_->graph.apply(run(*task));
}

std::vector<Pose2> LaserSlam::keyPoses() const {
  std::vector<Slam2d::KeyPose> keys = impl_->particles ? impl_->particles->keyPoses() : impl_->graph.keyPoses();
  std::vector<Pose2> poses;
  poses.reserve(keys.size());
  for (const Slam2d::KeyPose& key : keys) poses.push_back(key.T_map_body);
  return poses;
}

std::uint64_t LaserSlam::keyScans() const {
  return impl_->particles ? impl_->particles->counts().updates : impl_->graph.counts().key_scans;
}

common::OccupancyGrid LaserSlam::map() { return impl_->particles ? impl_->particles->map() : impl_->graph.snapshot(); }
const Slam2d& LaserSlam::slam() const { return impl_->graph; }
const ParticleSlam* LaserSlam::particles() const { return impl_->particles ? &*impl_->particles : nullptr; }
const LaserOdometryCounts& LaserSlam::odometryCounts() const { return impl_->front_end.odometryCounts(); }
LaserSlamCounts LaserSlam::counts() const { return impl_->front_end.counts(); }

TrackConnection LaserSlam::connection() const {
  return impl_->pieces.connection(keyScans(), impl_->particles ? std::vector<SlamEdge>{} : impl_->graph.edges());
}

}  // namespace swiftlet::perception

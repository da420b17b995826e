#include "perception/slam2d/laser_slam.hpp"

namespace swiftlet::perception {

using common::Pose2;

struct LaserSlam::Impl {
  explicit Impl(const LaserSlamConfig& config) : front_end(config.front_end), slam(makeSlam(config.slam)) {}

  LaserFrontEnd front_end;
  std::unique_ptr<PlanarSlam> slam;
  TrackPieces pieces;
};

LaserSlam::LaserSlam(const LaserSlamConfig& config) : impl_(std::make_unique<Impl>(config)) {}
LaserSlam::~LaserSlam() = default;

std::optional<TrackedScan> LaserSlam::add(const LaserSlamInput& input) {
  const auto followed = impl_->front_end.add(input);
  if (!followed) return std::nullopt;
  PlanarSlam& slam = *impl_->slam;
  const std::uint64_t keys_before = keyScans();
  (void)slam.addScan(followed->scan, followed->T_odom_robot, followed->covariance_since_last);
  if (const auto task = slam.takeTask()) slam.apply(run(*task));
  impl_->pieces.add(*followed, keys_before, keyScans());
  if (slam.anchor() < 0) return std::nullopt;
  return TrackedScan{slam.anchor(), slam.T_anchor_body(), followed->matched};
}

void LaserSlam::finish() {
  if (const auto task = impl_->slam->takeLastTask()) impl_->slam->apply(run(*task));
}

std::vector<Pose2> LaserSlam::keyPoses() const {
  std::vector<Pose2> poses;
  for (const PlanarSlam::KeyPose& key : impl_->slam->keyPoses()) poses.push_back(key.T_map_body);
  return poses;
}

std::uint64_t LaserSlam::keyScans() const { return impl_->slam->counts().key_scans; }
common::OccupancyGrid LaserSlam::map() { return impl_->slam->snapshot(); }
const PlanarSlam& LaserSlam::slam() const { return *impl_->slam; }
const LaserOdometryCounts& LaserSlam::odometryCounts() const { return impl_->front_end.odometryCounts(); }
LaserSlamCounts LaserSlam::counts() const { return impl_->front_end.counts(); }

TrackConnection LaserSlam::connection() const { return impl_->pieces.connection(keyScans(), impl_->slam->edges()); }

}  // namespace swiftlet::perception

#include "perception/slam2d/laser_slam.hpp"

#include <algorithm>

namespace swiftlet::perception {

using common::Pose2;

struct LaserSlam::Impl {
  explicit Impl(const LaserSlamConfig& config) : front_end(config.front_end), slam(makeSlam(config.slam)) {}

  LaserFrontEnd front_end;
  std::unique_ptr<PlanarSlam> slam;
  TrackPieces pieces;
  std::vector<ProjectedScan> key_scans;  ///< Reduced to the points that are matched.
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
  if (keyScans() > keys_before) impl_->key_scans.emplace_back().points_level_m = followed->scan.points_level_m;
  if (slam.anchor() < 0) return std::nullopt;
  return TrackedScan{slam.anchor(), slam.T_anchor_body(), followed->matched};
}

void LaserSlam::finish() {
  while (const auto task = impl_->slam->takeLastTask()) impl_->slam->apply(run(*task));
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

TrackConnection LaserSlam::connection(const MapJudgement& judgement) const {
  return impl_->pieces.connection(keyScans(), impl_->slam->edges(), judgement);
}

MapJudgement LaserSlam::judgement() const {
  const std::vector<Pose2> poses = keyPoses();
  std::vector<PlacedScan> keys;
  for (std::size_t i = 0; i < std::min(poses.size(), impl_->key_scans.size()); ++i)
    keys.push_back({&impl_->key_scans[i], poses[i]});
  return judgeMap(keys, ScanMatcher::kMaxRange_m);
}

}  // namespace swiftlet::perception
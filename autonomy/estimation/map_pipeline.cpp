#include "autonomy/estimation/map_pipeline.hpp"

#include <utility>

#include <fmt/format.h>

#include "perception/slam2d/slam_method.hpp"

namespace swiftlet::autonomy {

using common::Pose2;
using common::Time;

MapPipeline::MapPipeline(const perception::SlamMethodConfig& config, common::Duration job_latency,
                         common::JobRunner& jobs, common::EventLog& log)
    : job_latency_(job_latency),
      jobs_(jobs),
      slam_(makeSlam(config)),
      published_grid_(std::make_shared<common::OccupancyGrid>(slam_->snapshot())),
      published_keys_(std::make_shared<common::KeyPoses>()),
      log_(log) {}

MapStep MapPipeline::add(const MappedScan& mapped, Time now) {
  covariance_since_map_ += mapped.step_covariance;
  const Pose2 T_odom_body = planar(mapped.T_odom_body);
  MapStep step;
  if (mapped.matched) {
    auto update = slam_->addScan(mapped.scan, T_odom_body, covariance_since_map_);
    covariance_since_map_.setZero();
    T_odom_mapped_ = T_odom_body;
    step.T_map_body = update.T_map_body;
    step.known_key = update.known_key;
    step.gone = std::move(update.gone);
    if (update.drawn) ++grid_version_;
    if (update.key_scan) ++keys_version_;
    submitTask(now);
  } else {
    step.T_map_body = slam_->T_map_odom() * T_odom_body;
  }
  if (slam_->anchor() >= 0) {
    const Pose2 T_key_body = slam_->T_anchor_body() * between(T_odom_mapped_, T_odom_body);
    const common::Pose3 tilted = lifted(T_odom_body, 0.0).inverse() * mapped.T_odom_body;
    step.at_key = {slam_->anchor(), lifted(T_key_body, 0.0) * tilted};
  }
  return step;
}

std::shared_ptr<const common::OccupancyGrid> MapPipeline::grid() {
  if (published_grid_version_ != grid_version_) {
    published_grid_ = std::make_shared<common::OccupancyGrid>(slam_->snapshot());
    published_grid_version_ = grid_version_;
  }
  return published_grid_;
}

std::shared_ptr<const common::KeyPoses> MapPipeline::keyPoses() {
  if (published_keys_->version != keys_version_) {
    auto keys = std::make_shared<common::KeyPoses>();
    keys->version = keys_version_;
    for (const auto& key : slam_->keyPoses()) keys->keys.push_back({key.stamp, key.T_map_body});
    published_keys_ = std::move(keys);
  }
  return published_keys_;
}

void MapPipeline::submitTask(Time now) {
  if (!jobs_.idle("slam")) return;
  auto task = slam_->takeTask();
  if (!task) return;
  jobs_.submit("slam", now, job_latency_, [this, task = std::move(*task)]() -> common::JobRunner::Deliver {
    return [this, result = run(task)](Time delivered) { take(result, delivered); };
  });
}

void MapPipeline::take(const perception::SlamResult& result, Time delivered) {
  if (slam_->apply(result)) {
    ++grid_version_;
    ++keys_version_;
  }
  for (const auto& loop : result.accepted)
    log_.info(delivered, "slam2d", fmt::format("loop closed between key scans {} and {}", loop.from, loop.to),
              fmt::format("quality {:.2f}, {:.3f} m from the predicted pose", loop.quality, loop.shift_m));
}

}  // namespace swiftlet::autonomy

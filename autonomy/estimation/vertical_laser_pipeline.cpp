#include "autonomy/estimation/vertical_laser_pipeline.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "autonomy/arrivals/stamp_check.hpp"
#include "common/config_fields.hpp"
#include "perception/projection/placed_returns.hpp"

namespace swiftlet::autonomy {
namespace {

using common::Duration;
using common::Time;

constexpr const char* kDrawing = "mapping3d";
/// Sweeps that wait to be placed, or to be drawn: half a second of the fastest laser. More of them come only when the
/// link has held them back, or the work takes longer than it may.
constexpr std::size_t kMostWaiting = 20;
/// Greatest wait of a sweep for a scan of the first laser that is not older: two scans at 40 Hz.
constexpr double kSweepWait_s = 0.05;
/// A laser that sends no usable sweep for this long is silent.
constexpr double kSweepsSilent_s = 1.0;
/// The least noise, for a laser whose data sheet says that it has none.
constexpr double kLeastNoise_m = 0.001;

Time endOf(const common::LaserScan& sweep) {
  return sweep.stamps.measured + sweep.time_increment * static_cast<std::int64_t>(sweep.ranges_m.size());
}

}  // namespace

void VerticalLaserPipelineConfig::describe(common::config::Fields& fields) {
  fields.section("voxels", voxels, "Occupancy.");
  fields.section("submaps", submaps, "Pieces of the map, which move with the key scans of the 2D map.");
  fields("body_radius_m", body_radius_m, {0, 2},
         "Returns nearer to the body's origin come from the vehicle itself and are left out.");
}

VerticalLaserPipeline::VerticalLaserPipeline(const VerticalLaserPipelineConfig& config,
                                             const common::LaserConfig& laser, common::JobRunner& jobs,
                                             common::EventLog& log)
    : config_(config),
      laser_(laser),
      jobs_(jobs),
      silence_("upright laser", "sweep", kSweepsSilent_s, log),
      submaps_(std::make_shared<mapping3d::SubmapStore>(config.submaps, config.voxels)),
      publisher_(config.voxels.resolution_m, jobs),
      log_(log) {}

void VerticalLaserPipeline::add(std::shared_ptr<const common::VerticalScan> sweep) {
  const common::Stamps& stamps = sweep->stamps;
  if (const char* fault = stampFault(stamps, last_measured_)) {
    silence_.unusableArrived(stamps.arrived, fault);
    ++counts_.skipped;
    if (!std::exchange(any_fault_, true))
      log_.warn(stamps.arrived, kDrawing, "a sweep of the upright laser cannot be used",
                std::string(fault) + "; further ones are only counted");
    return;
  }
  silence_.usableArrived(stamps.arrived);
  ++counts_.sweeps;
  last_measured_ = stamps.measured;
  waiting_.push_back(std::move(sweep));
  if (waiting_.size() <= kMostWaiting) return;
  waiting_.pop_front();
  ++counts_.skipped;
}

std::optional<VerticalLaserPipeline::Interval> VerticalLaserPipeline::next() const {
  if (waiting_.empty()) return std::nullopt;
  return Interval{waiting_.front()->stamps.measured, endOf(*waiting_.front())};
}

Time VerticalLaserPipeline::waitUntil() const {
  return waiting_.front()->stamps.arrived + Duration::fromSeconds(kSweepWait_s);
}

void VerticalLaserPipeline::place(const std::optional<SweepSituation>& situation) {
  const auto sweep = std::move(waiting_.front());
  waiting_.pop_front();
  if (!situation) {
    ++counts_.unplaced;
    return;
  }
  mapping3d::PlacedSweep placed;
  placed.scan = situation->key;
  placed.people = situation->people;
  placed.weight_1_m2 = static_cast<float>(1.0 / std::pow(std::max(laser_.range_noise_m, kLeastNoise_m), 2));
  for (const auto& beam : perception::placeReturns(*sweep, laser_, situation->T_key_body, config_.body_radius_m))
    placed.rays_scan.push_back({beam.origin_m, beam.end_m});
  if (placed_.size() < kMostWaiting)
    placed_.push_back(std::move(placed));
  else
    ++counts_.skipped;
}

void VerticalLaserPipeline::draw(const std::shared_ptr<const common::KeyPoses>& keys, Time now) {
  silence_.watch(now);
  publisher_.fuse(keys, now);
  if (!jobs_.idle(kDrawing) || (placed_.empty() && !publisher_.beginLate(now))) return;
  counts_.drawn += placed_.size();
  const bool publish = placed_.empty() || publisher_.begin(now);
  jobs_.submit(
      kDrawing, now, Duration::fromSeconds(config_.latency_s),
      [this, submaps = submaps_, sweeps = std::exchange(placed_, {}), keys, publish]() -> common::JobRunner::Deliver {
        for (const mapping3d::PlacedSweep& sweep : sweeps) submaps->draw(sweep, *keys);
        if (!publish) return [](Time) {};
        return [this, snapshot = submaps->snapshot()](Time) { publisher_.setSubmaps(snapshot); };
      });
}

}  // namespace swiftlet::autonomy

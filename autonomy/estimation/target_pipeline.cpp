#include "autonomy/estimation/target_pipeline.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "common/config_fields.hpp"
#include "common/validation.hpp"

namespace swiftlet::autonomy {
namespace {

using common::Duration;
using common::Time;

constexpr const char* kTargets = "targets";
/// A frame waits this long for a scan that is not older, as the frames of the 3D map do by default.
constexpr double kWait_s = 0.05;
/// Least time from one frame that is looked at to the next: six a second see a target from several places.
constexpr double kLookPeriod_s = 0.15;
/// Declared time for looking at one frame (see common/jobs.hpp): three to five times what it takes.
constexpr double kLookLatency_s = 0.05;

}  // namespace

void TargetPipelineConfig::describe(common::config::Fields& fields) {
  fields.list("classes", classes, "Classes of targets that are looked for; without any, no frame is looked at.");
}

std::vector<common::Problem> TargetPipelineConfig::validate() const {
  std::vector<std::string> sorted = names();
  std::sort(sorted.begin(), sorted.end());
  const auto twice = std::adjacent_find(sorted.begin(), sorted.end());
  return common::Validation()
      .require(twice == sorted.end(), "classes",
               common::Message("config.name-twice", "two are called `{}`", twice == sorted.end() ? "" : *twice))
      .problems();
}

std::vector<std::string> TargetPipelineConfig::names() const {
  std::vector<std::string> names;
  for (const perception::TargetClassConfig& one : classes) names.push_back(one.name);
  return names;
}

TargetPipeline::TargetPipeline(const TargetPipelineConfig& config, common::JobRunner& jobs, double range_m,
                               common::EventLog& log)
    : config_(config),
      jobs_(jobs),
      detector_(std::make_shared<const perception::TargetDetector>(config.classes)),
      tracker_(config.tracker, config.classes, range_m),
      log_(log) {}

void TargetPipeline::add(std::shared_ptr<const common::RgbdFrame> frame) {
  if (last_taken_ && frame->stamps.measured < *last_taken_ + Duration::fromSeconds(kLookPeriod_s)) return;
  if (waiting_ && frame->stamps.measured <= waiting_->stamps.measured) return;
  waiting_ = std::move(frame);
}

std::optional<Time> TargetPipeline::next(double clock_offset_s) const {
  if (!waiting_ || !jobs_.idle(kTargets)) return std::nullopt;
  return waiting_->stamps.measured + waiting_->row_time * (waiting_->camera.height_px / 2) -
         Duration::fromSeconds(clock_offset_s);
}

Time TargetPipeline::waitUntil() const { return waiting_->stamps.arrived + Duration::fromSeconds(kWait_s); }

void TargetPipeline::look(const FrameSituation& situation, const common::CameraEstimate& camera, double drift_m,
                          Time now) {
  const std::shared_ptr<const common::RgbdFrame> frame = std::exchange(waiting_, nullptr);
  last_taken_ = frame->stamps.measured;
  if (!situation.at_key || !situation.body || !situation.supported) return;
  Place place{situation.at_key->key, situation.at_key->T_key_body * camera.T_body_camera, drift_m,
              situation.body->motion.rate_body_rad_s.norm(), situation.keys};
  jobs_.submit(kTargets, now, Duration::fromSeconds(kLookLatency_s),
               [this, detector = detector_, frame, place = std::move(place)]() -> common::JobRunner::Deliver {
                 return [this, frame, place, sightings = detector->detect(*frame)](Time delivered) {
                   take(sightings, *frame, place, delivered);
                 };
               });
}

void TargetPipeline::take(const std::vector<perception::TargetSighting>& sightings, const common::RgbdFrame& frame,
                          const Place& place, Time delivered) {
  tracker_.add(sightings,
               {frame, place.key, place.T_key_camera, place.position_sigma_m, place.turn_rate_rad_s, *place.keys});
  for (const common::Target& target : tracker_.targets(*place.keys)) {
    if (target.state != common::TargetState::kFound) continue;
    if (std::find(found_.begin(), found_.end(), target.id) != found_.end()) continue;
    found_.push_back(target.id);
    unreported_.push_back({delivered, target});
  }
}

void TargetPipeline::reportFound(const common::PlaceNames& names) {
  for (const Found& found : std::exchange(unreported_, {}))
    log_.info(found.at, kTargets, labelOf(found.target) + " found",
              fmt::format("at {} +- {:.2f} m, seen from {} places", names.of(found.target.position_map_m),
                          found.target.sigma_m(), found.target.views));
}

}  // namespace swiftlet::autonomy

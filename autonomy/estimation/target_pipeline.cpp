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
      frames_(kLookPeriod_s),
      log_(log) {}

std::optional<Time> TargetPipeline::next(double clock_offset_s) const {
  return jobs_.idle(kTargets) ? frames_.next(clock_offset_s) : std::nullopt;
}

void TargetPipeline::look(const FrameSituation& situation, const common::CameraEstimate& camera, double drift_m,
                          Time now) {
  auto placed = frames_.take(situation, camera.T_body_camera, drift_m);
  if (!placed) return;
  jobs_.submit(kTargets, now, Duration::fromSeconds(kLookLatency_s),
               [this, detector = detector_, placed = *std::move(placed)]() -> common::JobRunner::Deliver {
                 return [this, placed, sightings = detector->detect(*placed.frame)](Time delivered) {
                   take(sightings, placed, delivered);
                 };
               });
}

void TargetPipeline::take(const std::vector<perception::TargetSighting>& sightings, const PlacedFrame& placed,
                          Time delivered) {
  tracker_.add(sightings, {*placed.frame, placed.key, placed.T_key_camera, placed.position_sigma_m,
                           placed.turn_rate_rad_s, *placed.keys});
  for (const common::Target& target : tracker_.targets(*placed.keys)) {
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

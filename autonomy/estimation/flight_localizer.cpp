#include "autonomy/estimation/flight_localizer.hpp"

#include <utility>

#include <fmt/format.h>

#include "common/config_fields.hpp"
#include "common/place_names.hpp"

namespace swiftlet::autonomy {

using common::LocalizationState;
using common::Time;

void FlightLocalizerConfig::describe(common::config::Fields& fields) {
  fields.section("localizer", localizer, "Finding the pose, following it and noticing that it is lost.");
  fields("search_latency_s", search_latency_s, {0.01, 10}, "Declared time for a search of the whole map.");
}

FlightLocalizer::FlightLocalizer(const GivenMap& map, const FlightLocalizerConfig& config, common::JobRunner& jobs,
                                 common::EventLog& log)
    : config_(config),
      jobs_(jobs),
      map_(map),
      localizer_(*map.grid, map.T_given_grid, config.localizer, map.seed),
      log_(log) {}

void FlightLocalizer::load(const GivenMap& map) {
  localizer_ = perception::Localizer(*map.grid, map.T_given_grid, config_.localizer, map.seed);
  localization_ = {};
  map_ = map;
  ++maps_;
}

std::optional<perception::GivenBackground> FlightLocalizer::background(const common::Pose2& T_map_odom) const {
  if (!localization_.localized()) return std::nullopt;
  return perception::GivenBackground{map_.grid,
                                     map_.T_given_grid.inverse() * localization_.T_given_odom * T_map_odom.inverse()};
}

void FlightLocalizer::forget() {
  localizer_.forget();
  localization_.state = localizer_.state();
  localization_.places = 0;
  localization_.candidates.clear();
  localization_.refuted = false;
}

bool FlightLocalizer::wantsScan(const common::Pose2& T_odom_body) {
  return turns_.withholdNext(localizer_, T_odom_body);
}

void FlightLocalizer::add(const LocatedScan& located, Time now) {
  localization_.stamp = located.scan.stamp;
  passOver(located.step_covariance, located.interrupted);
  take(localizer_.follow(
           {located.scan, located.T_odom_body, since_last_.covariance, located.withheld, since_last_.interrupted}),
       now);
  since_last_ = {};
  submitSearch(now);
}

void FlightLocalizer::passOver(const Eigen::Matrix3d& step_covariance, bool interrupted) {
  since_last_.covariance += step_covariance;
  since_last_.interrupted |= interrupted;
}

void FlightLocalizer::take(const perception::LocalizationEstimate& estimate, Time now) {
  localization_.state = estimate.state;
  localization_.T_given_odom = estimate.T_map_odom;
  localization_.T_given_body = estimate.T_map_body;
  localization_.covariance = estimate.covariance;
  localization_.explained = estimate.explained;
  localization_.places = estimate.places;
  localization_.candidates = estimate.candidates;
  if (!std::exchange(localization_.refuted, estimate.refuted) && estimate.refuted)
    log_.warn(now, "localization", "the given map does not match this place",
              "many poses explain a part of the scans, and none explains all of them");
  if (!estimate.event) return;
  const bool lost = estimate.event->state == LocalizationState::kLost;
  std::string text = toString(estimate.event->state);
  if (localization_.localized())
    text += fmt::format(" at {}, heading {:.0f} deg", common::nameOfGivenPlace(localization_.T_given_body.position_m()),
                        localization_.T_given_body.yaw_rad / common::kRadPerDeg);
  log_.add({now,
            lost ? common::Severity::kWarning : common::Severity::kInfo,
            "localization",
            std::move(text),
            estimate.event->reason,
            {},
            common::Concern::kPosition});
}

void FlightLocalizer::submitSearch(Time now) {
  if (!jobs_.idle("localization")) return;
  auto task = localizer_.takeTask();
  if (!task) return;
  jobs_.submit("localization", now, common::Duration::fromSeconds(config_.search_latency_s),
               [this, map = maps_, task = std::move(*task)]() -> common::JobRunner::Deliver {
                 return [this, map, result = run(task)](Time delivered) {
                   if (map == maps_) take(localizer_.apply(result), delivered);
                 };
               });
}

}  // namespace swiftlet::autonomy

#include "interfaces/flight_summary.hpp"

#include <cmath>

#include <nlohmann/json.hpp>

#include "common/check.hpp"
#include "common/rounding.hpp"

namespace swiftlet::interfaces {
namespace {

using common::rounded;
using nlohmann::ordered_json;

ordered_json orNull(const std::optional<double>& value) {
  return value ? ordered_json(rounded(*value)) : ordered_json(nullptr);
}

ordered_json orNull(const std::optional<bool>& value) { return value ? ordered_json(*value) : ordered_json(nullptr); }

ordered_json phaseJson(const Phase& phase) {
  return {{"name", phase.name},
          {"begin_s", rounded(phase.begin.seconds())},
          {"end_s", rounded(phase.end.seconds())},
          {"duration_s", rounded((phase.end - phase.begin).seconds())},
          {"flown_by", phase.flown_by},
          {"reason", phase.reason}};
}

ordered_json frontierJson(const common::Frontier& frontier) {
  return {{"x_m", rounded(frontier.centroid_map_m.x())}, {"y_m", rounded(frontier.centroid_map_m.y())},
          {"length_m", rounded(frontier.length_m)},      {"reason", common::toString(frontier.reason)},
          {"explanation", frontier.explanation},         {"attempts", frontier.attempts}};
}

ordered_json targetJson(const common::Target& target) {
  const Eigen::Vector3d& at = target.position_map_m;
  return {{"label", labelOf(target)},
          {"name", target.name},
          {"state", common::toString(target.state)},
          {"x_m", rounded(at.x())},
          {"y_m", rounded(at.y())},
          {"z_m", rounded(at.z())},
          {"sigma_m", rounded(target.sigma_m())},
          {"views", target.views}};
}

ordered_json objectJson(const common::RecognizedObject& object) {
  const Eigen::Vector3d& at = object.T_map_object.position_m;
  const Eigen::Quaterniond& q = object.T_map_object.rotation;
  ordered_json covariance_m2 = ordered_json::array();
  for (int i = 0; i < 9; ++i) covariance_m2.push_back(object.covariance_m2(i / 3, i % 3));
  return {{"id", object.id},
          {"what", object.what},
          {"label", labelOf(object)},
          {"confirmed", object.confirmed},
          {"passage", common::toString(object.passage)},
          {"position_map_m", {rounded(at.x()), rounded(at.y()), rounded(at.z())}},
          {"rotation_map_xyzw", {q.x(), q.y(), q.z(), q.w()}},
          {"covariance_m2", covariance_m2},
          {"sigma_m", rounded(object.sigma_m())},
          {"yaw_sigma_rad", rounded(object.yaw_sigma_rad)},
          {"width_m", rounded(object.size_m.x())},
          {"height_m", rounded(object.size_m.y())},
          {"looks", object.looks},
          {"last_seen_s", rounded(object.last_seen.seconds())}};
}

/// In short, for the summary of the flight: those that were confirmed.
ordered_json confirmedJson(const std::vector<common::RecognizedObject>& objects) {
  ordered_json list = ordered_json::array();
  for (const common::RecognizedObject& object : objects)
    if (object.confirmed)
      list.push_back({{"label", labelOf(object)},
                      {"what", object.what},
                      {"passage", common::toString(object.passage)},
                      {"x_m", rounded(object.T_map_object.position_m.x())},
                      {"y_m", rounded(object.T_map_object.position_m.y())},
                      {"z_m", rounded(object.T_map_object.position_m.z())},
                      {"sigma_m", rounded(object.sigma_m())},
                      {"looks", object.looks}});
  return list;
}

ordered_json machineJson(const FlightSummary& summary) {
  return {{"started", summary.info.started},
          {"wall_time_s", orNull(summary.wall_time_s)},
          {"realtime_factor", orNull(summary.realtime_factor)},
          {"memory_peak_MB", orNull(summary.machine.memory_peak_MB)},
          {"frame_first_ms", orNull(summary.machine.frame_first_ms)},
          {"frame_last_ms", orNull(summary.machine.frame_last_ms)}};
}

ordered_json localizationJson(const LocalizationSummary& summary) {
  ordered_json pose = nullptr;
  if (const common::Pose2& at = summary.last.T_given_body; summary.last.localized())
    pose = {{"x_m", rounded(at.x_m)}, {"y_m", rounded(at.y_m)}, {"yaw_rad", rounded(at.yaw_rad)}};
  return {{"map", summary.map},
          {"state", common::toString(summary.last.state)},
          {"pose", pose},
          {"found_after_s", orNull(summary.found_after_s)},
          {"found_after_m", orNull(summary.found_after_m)},
          {"flown_s", rounded(summary.flown_s)},
          {"localized_s", rounded(summary.localized_s)}};
}

}  // namespace

const char* toString(Outcome outcome) {
  switch (outcome) {
    case Outcome::kFlying:
      return "flying";
    case Outcome::kDone:
      return "done";
    case Outcome::kFailed:
      return "failed";
    case Outcome::kCrashed:
      return "crashed";
    case Outcome::kStopped:
      return "stopped";
  }
  SWIFTLET_CHECK(false, static_cast<int>(outcome));
}

std::string toJson(const FlightSummary& summary) {
  ordered_json phases = ordered_json::array(), frontiers = ordered_json::array(), figures = ordered_json::object();
  for (const Phase& phase : summary.phases) phases.push_back(phaseJson(phase));
  for (const common::Frontier& frontier : summary.frontiers) frontiers.push_back(frontierJson(frontier));
  for (const Figure& figure : summary.figures) figures[figure.name] = rounded(figure.value);
  ordered_json json = {
      {"format", "swiftlet mission 1"},
      {"mission", summary.info.mission},
      {"mission_file", summary.info.mission_file},
      {"world", summary.info.world},
      {"system", summary.info.system},
      {"seed", summary.info.seed},
      {"version", summary.info.version.number},
      {"commit", summary.info.version.commit},
      {"dirty", orNull(summary.info.version.dirty)},
      {"outcome", toString(summary.outcome)},
      {"reason", summary.reason},
      {"mission_time_s", rounded(summary.mission_time.seconds())},
      {"distance_m", rounded(summary.distance_m)},
      {"explored_area_m2", orNull(summary.explored_area_m2)},
      {"coverage", orNull(summary.coverage)},
      {"battery_remaining", rounded(summary.battery_remaining)},
      {"phases", phases},
      {"frontiers", frontiers},
      {"figures", figures},
      {"machine", machineJson(summary)},
  };
  for (const common::Target& target : summary.targets) json["targets"].push_back(targetJson(target));
  if (!summary.objects.empty()) json["objects"] = confirmedJson(summary.objects);
  if (summary.octree_age_s) json["octree_age_s"] = rounded(*summary.octree_age_s);
  if (!summary.info.nature.empty()) json["nature"] = summary.info.nature;
  if (!summary.info.vehicle.empty()) json["vehicle"] = summary.info.vehicle;
  if (summary.localization) json["localization"] = localizationJson(*summary.localization);
  return json.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

std::string objectsJson(const std::vector<common::RecognizedObject>& objects) {
  ordered_json list = ordered_json::array();
  for (const common::RecognizedObject& object : objects) list.push_back(objectJson(object));
  return ordered_json{{"format", "swiftlet objects 1"}, {"objects", list}}.dump(
             2, ' ', false, ordered_json::error_handler_t::replace) +
         "\n";
}

}  // namespace swiftlet::interfaces

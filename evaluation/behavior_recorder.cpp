#include "evaluation/behavior_recorder.hpp"

#include <algorithm>
#include <utility>

#include "common/world.hpp"
#include "common/world/map_layer.hpp"
#include "common/world/people_layer.hpp"

namespace swiftlet::evaluation {
namespace {

constexpr common::Duration kInspectingPeriod = common::Duration::fromMilliseconds(100);

}  // namespace

void BehaviorRecorder::tick(const simulation::Truth& truth, const common::Pose3& T_map_truth,
                            const common::Pose3& T_world_map) {
  const double elapsed_s = last_tick_ ? (truth.stamp - *last_tick_).seconds() : 0.0;
  last_tick_ = truth.stamp;
  present_.height_world_m = truth.T_world_body.position_m.z();
  present_.closed_doors = truth.closed_doors;
  if (!truth.airborne) return;
  keepOut(T_map_truth.position_m.head<2>());
  inspect(truth);
  follow(truth, T_world_map, elapsed_s);
}

void BehaviorRecorder::keepOut(const Eigen::Vector2d& position_map_m) {
  if (!zones_) return;
  for (const common::Polygon& zone : *zones_) {
    const double distance_m = zone.signedDistance_m(position_map_m);
    if (std::find(left_.begin(), left_.end(), zone) == left_.end()) {
      if (distance_m <= 0.0) continue;
      left_.push_back(zone);
    }
    record_.keep_out_distance_m = std::min(distance_m, record_.keep_out_distance_m.value_or(distance_m));
  }
}

/// From when it has turned to the point.
void BehaviorRecorder::inspect(const simulation::Truth& truth) {
  const auto* inspected = std::get_if<common::InspectIntent>(&intent_.kind);
  if (inspected == nullptr || !status_.inspecting || truth.stamp < next_view_) return;
  next_view_ = truth.stamp + kInspectingPeriod;
  record_.inspecting.push_back({truth.T_world_body, inspected->point_map_m, inspected->point_height_m});
}

void BehaviorRecorder::follow(const simulation::Truth& truth, const common::Pose3& T_world_map, double elapsed_s) {
  const auto* wanted = std::get_if<common::FollowIntent>(&intent_.kind);
  const bool follows = wanted != nullptr && !people_world_m_.empty() && followed_map_m_ &&
                       status_.state == common::IntentState::kRunning;
  if (!follows) return;
  const Eigen::Vector2d person_world_m = people_world_m_.front();
  const double distance_m = (truth.T_world_body.position_m.head<2>() - person_world_m).norm();
  const bool in_distance =
      distance_m >= BehaviorRecord::Follow::kNear_m && distance_m <= BehaviorRecord::Follow::kFar_m;
  if (record_.follows.empty() || record_.follows.back().mode != wanted->mode) {
    if (!in_distance) return;
    record_.follows.push_back({wanted->mode, 0.0, 0.0, distance_m, distance_m, 0.0});
    lost_now_s_ = 0.0;
  }
  BehaviorRecord::Follow& record = record_.follows.back();
  record.followed_s += elapsed_s;
  if (in_distance) record.in_distance_s += elapsed_s;
  record.nearest_m = std::min(record.nearest_m, distance_m);
  record.farthest_m = std::max(record.farthest_m, distance_m);
  const Eigen::Vector2d believed_world_m = common::planar(T_world_map) * *followed_map_m_;
  lost_now_s_ =
      (believed_world_m - person_world_m).norm() > BehaviorRecord::Follow::kWrong_m ? lost_now_s_ + elapsed_s : 0.0;
  record.lost_s = std::max(record.lost_s, lost_now_s_);
}

void BehaviorRecorder::intent(const common::Intent& intent, const common::IntentStatus& status) {
  const bool was_running = status_.id != status.id || status_.state == common::IntentState::kRunning;
  if (status.id == intent.id && was_running && status.state == common::IntentState::kSucceeded) {
    if (const auto* survey = std::get_if<common::SurveyIntent>(&intent.kind)) record_.surveyed.push_back(survey->area);
    if (const auto* explore = std::get_if<common::ExploreIntent>(&intent.kind); explore != nullptr && present_.map) {
      present_.asked = *explore;
      record_.explored.push_back(present_);
    }
  }
  intent_ = intent;
  status_ = status;
}

void BehaviorRecorder::world(const common::World& world) {
  followed_map_m_ = world.people->followed_map_m;
  record_.targets = world.targets;
  record_.objects = world.objects;
  present_.map = world.map->grid;
  present_.map3d = world.map3d;
  present_.keep_out = world.map->keep_out;
  if (zones_ == world.map->keep_out) return;
  zones_ = world.map->keep_out;
  std::erase_if(left_, [&](const common::Polygon& zone) {
    return std::find(zones_->begin(), zones_->end(), zone) == zones_->end();
  });
}

}  // namespace swiftlet::evaluation

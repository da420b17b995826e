#include "perception/localization/place_posterior.hpp"

#include <algorithm>
#include <cmath>

#include "perception/localization/beam_sums.hpp"

namespace swiftlet::perception {
namespace {

using common::kRadPerDeg;
using common::Pose2;

/// A grid of poses around one pose, with (2 * half + 1) poses in each coordinate.
struct Neighbourhood {
  int half_positions = 1;
  double step_m = 0.05;
  int half_turns = 1;
  double step_rad = 0.01;
};
/// kCoarse covers the gaps between the poses of the coarse search; kFine refines to the resolution of the field.
constexpr Neighbourhood kCoarse{2, 0.05, 3, 0.5 * kRadPerDeg};
constexpr Neighbourhood kFine{1, 0.02, 1, 0.2 * kRadPerDeg};
/// Bounds the moves of the neighbourhood, each as far as it is wide: together 0.4 m with kCoarse.
constexpr int kMostMoves = 4;

/// Scores neighbourhoods of poses. Keeps its buffers between calls.
class PoseScorer {
 public:
  PoseScorer(Instructions instructions, const MapField& map, const std::vector<Eigen::Vector2f>& points_m)
      : instructions_(instructions), field_(map.view()) {
    for (const Eigen::Vector2f& p : points_m) {
      beams_x_.push_back(p.x() / static_cast<float>(field_.resolution_m));
      beams_y_.push_back(p.y() / static_cast<float>(field_.resolution_m));
    }
  }

  std::int32_t score(const Pose2& pose) {
    begin();
    add(pose);
    return sums()[0];
  }

  /// The best pose of the neighbourhood of a pose; the pose itself if others are only as good.
  Pose2 best(const Pose2& center, const Neighbourhood& around) {
    std::vector<Pose2> poses{center};
    for (int k = -around.half_turns; k <= around.half_turns; ++k)
      for (int y = -around.half_positions; y <= around.half_positions; ++y)
        for (int x = -around.half_positions; x <= around.half_positions; ++x)
          poses.push_back(
              {center.x_m + x * around.step_m, center.y_m + y * around.step_m, center.yaw_rad + k * around.step_rad});
    begin();
    for (const Pose2& pose : poses) add(pose);
    const std::vector<std::int32_t>& scores = sums();
    return poses[static_cast<std::size_t>(std::max_element(scores.begin(), scores.end()) - scores.begin())];
  }

 private:
  void begin() {
    for (std::vector<float>* values : {&x_, &y_, &cosine_, &sine_}) values->clear();
  }
  void add(const Pose2& pose) {
    x_.push_back(static_cast<float>((pose.x_m - field_.origin_m.x()) / field_.resolution_m));
    y_.push_back(static_cast<float>((pose.y_m - field_.origin_m.y()) / field_.resolution_m));
    cosine_.push_back(static_cast<float>(std::cos(pose.yaw_rad)));
    sine_.push_back(static_cast<float>(std::sin(pose.yaw_rad)));
  }
  const std::vector<std::int32_t>& sums() {
    sums_.resize(x_.size());
    sumBeams(instructions_, field_, {x_, y_, cosine_, sine_}, {beams_x_, beams_y_}, sums_);
    return sums_;
  }

  Instructions instructions_;
  FieldView field_;
  std::vector<float> beams_x_, beams_y_, x_, y_, cosine_, sine_;
  std::vector<std::int32_t> sums_;
};

Pose2 climbed(PoseScorer& scorer, Pose2 pose) {
  for (const Neighbourhood& around : {kCoarse, kFine}) {
    for (int move = 0; move < kMostMoves; ++move) {
      const Pose2 better = scorer.best(pose, around);
      const bool stays = better.x_m == pose.x_m && better.y_m == pose.y_m && better.yaw_rad == pose.yaw_rad;
      pose = better;
      if (stays) break;
    }
  }
  return pose;
}

/// The share of the points on known cells that end within `tolerance_m` of a wall. If fewer than half of all points are
/// on known cells, the share is taken of half of all points.
double explainedShare(const MapField& map, const std::vector<Eigen::Vector2f>& points_m, const Pose2& T_grid_points,
                      double tolerance_m) {
  int known = 0, explained = 0;
  for (const Eigen::Vector2f& point : points_m) {
    const MapField::Place place = map.at(T_grid_points * point.cast<double>());
    const bool on_wall = place.wall_distance_m <= tolerance_m;
    known += place.known || on_wall ? 1 : 0;
    explained += on_wall ? 1 : 0;
  }
  // A few points on known cells are no evidence for a place where most of the map is unknown.
  const double asked = std::max<double>(known, 0.5 * static_cast<double>(points_m.size()));
  return asked > 0.0 ? explained / asked : 0.0;
}

}  // namespace

bool PlaceDistinction::same(const Pose2& a, const Pose2& b) const {
  return (a.position_m() - b.position_m()).norm() <= distance_m &&
         std::abs(common::wrapAngle(a.yaw_rad - b.yaw_rad)) <= turn_rad;
}

double logLikelihood(const MapField& map, const std::vector<Eigen::Vector2f>& points_m, const Pose2& T_grid_points,
                     double point_weight) {
  PoseScorer scorer(Instructions::kScalar, map, points_m);
  return scorer.score(T_grid_points) * point_weight * map.topNats() / 255.0;
}

std::vector<LikelyPlace> likelyPlaces(Instructions instructions, const MapField& map,
                                      const std::vector<FittingPlace>& found,
                                      const std::vector<Eigen::Vector2f>& points_m, double point_weight,
                                      double tolerance_m, const PlaceDistinction& distinction) {
  PoseScorer scorer(instructions, map, points_m);
  const double nats = point_weight * map.topNats() / 255.0;
  std::vector<LikelyPlace> climbed_places;
  for (const FittingPlace& place : found) {
    const Pose2 pose = climbed(scorer, place.T_grid_points);
    const std::int32_t score = scorer.score(pose);
    climbed_places.push_back({pose, score / (255.0 * static_cast<double>(points_m.size())), score * nats, 0.0, 0.0});
  }
  std::stable_sort(climbed_places.begin(), climbed_places.end(),
                   [](const LikelyPlace& a, const LikelyPlace& b) { return a.log_likelihood > b.log_likelihood; });
  std::vector<LikelyPlace> places;
  double all = 0.0;
  for (LikelyPlace& place : climbed_places) {
    if (std::any_of(places.begin(), places.end(), [&](const LikelyPlace& better) {
          return distinction.same(better.T_grid_points, place.T_grid_points);
        }))
      continue;
    place.probability = std::exp(place.log_likelihood - climbed_places.front().log_likelihood);
    place.explained = explainedShare(map, points_m, place.T_grid_points, tolerance_m);
    all += place.probability;
    places.push_back(place);
  }
  for (LikelyPlace& place : places) place.probability /= all;
  return places;
}

}  // namespace swiftlet::perception

// Flies a tour through places that see all frontiers.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "planning/exploration/coarse_costs.hpp"
#include "planning/exploration/frontier_survey.hpp"
#include "planning/exploration/tour.hpp"
#include "planning/exploration/viewpoint_options.hpp"
#include "planning/exploration/volume_survey.hpp"

namespace swiftlet::planning {
namespace {

using common::CellIndex;
using Point = Eigen::Vector2d;

/// Frontiers, from the nearest on, for which viewpoints are evaluated in one call, and stops of a tour: what is farther
/// away hardly changes where to go first.
constexpr std::size_t kMostTourFrontiers = 40, kMostTourStops = 24;
/// A viewpoint covers another frontier only from this near: from farther away too little is seen behind it.
constexpr double kCover_m = 2.4;
/// Another tour must save this share of the time of the present one.
constexpr double kTourHysteresis = 0.10;
/// The viewpoint that is flown to is kept while this share of what it promised is left to be seen from it: what is seen
/// on the way there has not to be flown to.
constexpr double kGainLeft = 0.5;

/// Stops of the camera in one tour, and how far ahead of one its target is.
constexpr std::size_t kMostCameraStops = 16;
constexpr double kCameraTarget_m = 1.0;

/// What the laser part of a tour is asked: without what only the camera has looked at.
ExplorationInput ofLaser(const ExplorationInput& input) {
  ExplorationInput laser = input;
  std::erase_if(laser.attempts, [](const ExplorationAttempt& attempt) { return attempt.by_camera; });
  if (laser.current && laser.current->gain_m3 > 0.0) laser.current.reset();
  return laser;
}

Viewpoint viewpointOf(const CameraLook& look, const CostMap& map) {
  const Point place_m = map.centerOf(look.place), ahead(std::cos(look.yaw_map_rad), std::sin(look.yaw_map_rad));
  Viewpoint viewpoint{{place_m.x(), place_m.y(), look.yaw_map_rad}, place_m + kCameraTarget_m * ahead};
  viewpoint.gain_m3 = look.gain_m3;
  return viewpoint;
}

class TourChoice {
 public:
  /// Without a volume the tour is one of the laser alone. Refers to its arguments.
  TourChoice(const ExplorationInput& input, const ExplorerConfig& config)
      : input_(input),
        half_field_of_view_rad_(0.5 * config.laser_field_of_view_deg * std::numbers::pi / 180.0),
        survey_(input),
        map_(survey_.map()),
        scout_(map_, survey_.field(), config, input.bounds ? &*input.bounds : nullptr),
        viewpoints_(input, config, survey_, scout_) {}

  /// `all` has the current viewpoint and the attempts of the camera as well; null: the laser explores alone.
  ExplorationResult run(const ExplorationInput* all, const CameraFrustum& frustum) {
    if (survey_.shutIn()) return survey_.finish(std::nullopt, false);
    evaluate();
    bool has_current = !options_.empty() && placeCurrent();
    cover(has_current);
    if (all != nullptr) has_current |= addCameraStops(*all, frustum);
    if (stops_.empty()) return survey_.finish(std::nullopt, false);
    const TourCosts costs = costsOfTour();
    std::vector<std::size_t> order = shortestTour(costs);
    bool keep = false;
    if (has_current) {
      std::vector<std::size_t> kept = shortestTour(costs, 1);
      keep = tourCost(costs, kept) * (1.0 - kTourHysteresis) <= tourCost(costs, order);
      if (keep) order = std::move(kept);
    }
    for (std::size_t i = 0; i < order.size(); ++i)
      if (const auto frontier = stops_[order[i] - 1].frontier)
        survey_.score(*frontier, 1.0 / static_cast<double>(i + 1));
    return finish(stops_[order.front() - 1].viewpoint, keep);
  }

 private:
  struct Stop {
    std::optional<std::size_t> frontier;  ///< Of one of the laser.
    CellIndex place;
    double path_m = 0.0;
    Viewpoint viewpoint;
  };

  void evaluate() {
    for (const SeenFrontier& seen : survey_.seenBy(scout_)) {
      if (options_.size() >= kMostTourFrontiers) break;
      if (const auto nearest = viewpoints_.nearestOf(seen)) options_.push_back(*nearest);
    }
  }

  /// The current viewpoint is the first one. True if there is one.
  bool placeCurrent() {
    std::vector<std::size_t> frontiers;
    for (const ViewpointOption& option : options_) frontiers.push_back(option.frontier);
    auto current = viewpoints_.current(frontiers);
    if (current && current->view.gain_m2 < kGainLeft * input_.current->gain_m2) current.reset();
    if (current) options_.insert(options_.begin(), *current);
    return current.has_value();
  }

  /// Chooses stops of the tour that cover all frontiers: again and again the viewpoint that covers most of what is
  /// left.
  void cover(bool current_first) {
    std::vector<bool> is_covered(options_.size(), false);
    std::vector<std::vector<std::size_t>> covers(options_.size());
    for (std::size_t i = 0; i < options_.size(); ++i)
      for (std::size_t j = 0; j < options_.size(); ++j)
        if (options_[i].frontier == options_[j].frontier || sees(options_[i], options_[j].frontier))
          covers[i].push_back(j);
    const auto newOf = [&](std::size_t i) {
      return static_cast<std::size_t>(
          std::count_if(covers[i].begin(), covers[i].end(), [&](std::size_t j) { return !is_covered[j]; }));
    };
    while (stops_.size() < kMostTourStops) {
      std::size_t best = 0, most = 0;
      if (current_first && stops_.empty()) {
        most = newOf(0);
      } else {
        for (std::size_t i = 0; i < options_.size(); ++i)
          if (const std::size_t count = is_covered[i] ? 0 : newOf(i); count > most) {
            best = i;
            most = count;
          }
      }
      if (most == 0) break;
      const ViewpointOption& stop = options_[best];
      stops_.push_back({stop.frontier, stop.lookout.place, stop.lookout.path_m, viewpoints_.viewpointOf(stop)});
      for (const std::size_t j : covers[best]) is_covered[j] = true;
    }
  }

  /// Whether the middle of the frontier is within the fan of the viewpoint, with nothing known in between.
  bool sees(const ViewpointOption& from, std::size_t frontier) const {
    const std::vector<CellIndex>& cells = survey_.run(frontier).cells;
    const Point begin_m = map_.centerOf(from.lookout.place), end_m = map_.centerOf(cells[cells.size() / 2]);
    const Point line = end_m - begin_m;
    const double length_m = line.norm();
    if (length_m > kCover_m) return false;
    if (std::abs(common::wrapAngle(std::atan2(line.y(), line.x()) - from.view.yaw_map_rad)) > half_field_of_view_rad_)
      return false;
    return map_.clearance().isOpen(begin_m, end_m);
  }

  /// A current viewpoint of the camera becomes the first stop. True if there is one, of which enough is left.
  bool addCameraStops(const ExplorationInput& all, const CameraFrustum& frustum) {
    VolumeSurvey volume(all, map_, survey_.field(), frustum);
    const auto current = volume.current();
    const bool keeps = current && current->gain_m3 >= kGainLeft * all.current->gain_m3;
    for (const CameraLook& look : volume.cover(kMostCameraStops)) {
      left_m3_ += look.gain_m3;
      stops_.push_back({std::nullopt, look.place, look.path_m, viewpointOf(look, map_)});
    }
    if (!keeps) return false;
    const auto first_camera = std::find_if(stops_.begin(), stops_.end(), [](const Stop& s) { return !s.frontier; });
    first_camera->viewpoint.pose_map = all.current->pose_map;
    std::rotate(stops_.begin(), first_camera, first_camera + 1);
    return true;
  }

  ExplorationResult finish(Viewpoint next, bool keep) {
    const bool by_camera = next.gain_m3 > 0.0;
    const std::string to = fmt::format("next viewpoint {} for {:.1f} m3 of {:.1f} m3 for the camera",
                                       map_.names().of(next.pose_map.position_m()), next.gain_m3, left_m3_);
    ExplorationResult result = survey_.finish(std::move(next), keep);
    result.done = false;
    if (by_camera) result.reason = to;
    return result;
  }

  TourCosts costsOfTour() {
    CoarseCosts coarse(map_, survey_.field());
    std::vector<CellIndex> places;
    for (const Stop& stop : stops_) places.push_back(stop.place);
    TourCosts costs(stops_.size());
    for (std::size_t i = 0; i < stops_.size(); ++i) {
      const double yaw_rad = stops_[i].viewpoint.pose_map.yaw_rad;
      costs.between(0, i + 1) = legTime_s(stops_[i].path_m, input_.pose_map.yaw_rad, yaw_rad);
      const std::vector<double> legs_m = coarse.between_m(places[i], places);
      for (std::size_t j = 0; j < stops_.size(); ++j)
        costs.between(i + 1, j + 1) = legTime_s(legs_m[j], yaw_rad, stops_[j].viewpoint.pose_map.yaw_rad);
    }
    if (const auto home = homePlace()) {
      const std::vector<double> home_m = coarse.between_m(*home, places);
      for (std::size_t i = 0; i < stops_.size(); ++i)
        costs.toEnd(i + 1) = std::min(kFar_s, home_m[i] / kTravelSpeed_m_s);
    }
    return costs;
  }

  /// nullopt if the mission does not come home, or where home is not in the map.
  std::optional<CellIndex> homePlace() const {
    if (!input_.home_map_m) return std::nullopt;
    const CellIndex home = map_.cellAt(*input_.home_map_m);
    return map_.rect().contains(home) ? std::optional(home) : std::nullopt;
  }

  static double legTime_s(double path_m, double from_yaw_rad, double to_yaw_rad) {
    return std::min(kFar_s, travelTime_s(path_m, from_yaw_rad, to_yaw_rad) + kBrake_s);
  }

  /// Instead of an infinite time where no coarse path leads: longer than any flight.
  static constexpr double kFar_s = 1e5;

  const ExplorationInput& input_;
  double half_field_of_view_rad_;
  FrontierSurvey survey_;
  const CostMap& map_;
  Scout scout_;
  ViewpointOptions viewpoints_;
  std::vector<ViewpointOption> options_;
  std::vector<Stop> stops_;
  double left_m3_ = 0.0;  ///< Volume that the stops of the camera are expected to see.
};

}  // namespace

ExplorationResult exploreByTour(const ExplorationInput& input, const ExplorerConfig& config) {
  return TourChoice(input, config).run(nullptr, {});
}

ExplorationResult exploreByCameraTour(const ExplorationInput& input, const ExplorerConfig& config) {
  if (!config.camera || !input.volume.voxels) return exploreByTour(input, config);
  const ExplorationInput laser = ofLaser(input);
  return TourChoice(laser, config).run(&input, *config.camera);
}

}  // namespace swiftlet::planning

#include "autonomy/estimation/start_view.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace swiftlet::autonomy {

using common::Pose3;
using common::Time;

StartView::StartView(const LaserPipelineConfig& config, const common::LaserConfig& laser, double standing_height_m)
    : config_(config), laser_(laser), standing_height_m_(standing_height_m) {}

void StartView::add(const common::LaserScan& scan, const Eigen::Quaterniond& R_level_body) {
  scan_ = scan;
  R_level_body_ = R_level_body;
}

std::string StartView::problem(Time now, bool position_known) const {
  // Several periods of the slowest laser.
  constexpr double kSilent_s = 1.0;
  if (!scan_) return "the laser has sent no scan";
  const double silent_s = (now - scan_->stamps.arrived).seconds();
  if (silent_s > kSilent_s) return fmt::format("the laser has been silent for {:.1f} s", silent_s);
  const perception::ProjectedScan view = projected();
  std::string problem = heightProblem(view);
  return problem.empty() && !position_known ? positionProblem(view) : problem;
}

/// Every return counts. A vehicle that stands sees far walls so low above the floor that a small error of its attitude
/// would make floor of them.
perception::ProjectedScan StartView::projected() const {
  constexpr double kNoSurface_m = 1e4;
  perception::ScanProjectionConfig config = config_.projection;
  config.floor_height_odom_m = -kNoSurface_m;
  config.ceiling_height_odom_m = 0.0;
  config.max_rise_m = kNoSurface_m;
  const Pose3 standing{R_level_body_, {0.0, 0.0, standing_height_m_}};
  return perception::project(
      *scan_, laser_, [&](Time) { return standing; }, config);
}

std::string StartView::heightProblem(const perception::ProjectedScan& view) const {
  if (laser_.mirror_beams == 0) return "no beam of the laser looks down, and nothing else measures the height";
  // From the ground the floor may be too near to be measured.
  constexpr double kSigmas = 3.0;
  const double floor_m = standing_height_m_ + laser_.mirror_mount.z_m - kSigmas * laser_.range_noise_m;
  if (!view.mirror.empty() || floor_m < laser_.range_min_m) return "";
  return fmt::format("none of the {} beams down returns, and nothing else measures the height", laser_.mirror_beams);
}

/// Returns that leave one direction free, as the walls of a long corridor, carry a flight: the drift along it is
/// watched.
std::string StartView::positionProblem(const perception::ProjectedScan& view) const {
  const double reach_m = std::min({scan_->range_max_m, laser_.range_max_m, perception::ScanMatcher::kMaxRange_m});
  const auto returns = std::count_if(view.points_level_m.begin(), view.points_level_m.end(),
                                     [&](const Eigen::Vector2f& point_m) { return point_m.norm() <= reach_m; });
  if (returns < perception::ScanMatcher::kMinPoints)
    return fmt::format("{} beams of the laser return from within {:.1f} m; {} are needed to fix the position",
                       returns == 0 ? "no" : fmt::format("{}", returns), reach_m, perception::ScanMatcher::kMinPoints);
  return "";
}

}  // namespace swiftlet::autonomy

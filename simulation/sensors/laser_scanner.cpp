#include "simulation/sensors/laser_scanner.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "common/check.hpp"
#include "common/random.hpp"

namespace swiftlet::simulation {
namespace {

using common::Duration;
using common::Time;

constexpr float kErrorCode_m = 0.0F;
constexpr double kStep_m = 0.001;           // The device counts millimetres.
constexpr double kNoiseGrowsFrom_m = 10.0;  // Range noise is constant up to here, then proportional to the range.

}  // namespace

LaserScanner::LaserScanner(const common::LaserConfig& config, std::uint64_t seed)
    : config_(config),
      seed_(seed),
      time_increment_(
          Duration::fromNanoseconds(static_cast<std::int64_t>(std::floor(config.sweep_s * 1e9 / (config.beams - 1))))),
      rays_(static_cast<std::size_t>(config.beams)),
      distances_m_(static_cast<std::size_t>(config.beams)) {
  const common::Pose3 T_body_laser = config.mount.pose(), T_body_mirror = config.mirror_mount.pose();
  for (int beam = 0; beam < config.beams; ++beam) {
    const common::Pose3& T_body_source = config.isMirrorBeam(beam) ? T_body_mirror : T_body_laser;
    beams_.push_back({T_body_source.position_m, T_body_source.rotation * config.direction(beam)});
  }
}

// Between two moments the pose is blended linearly; in a millisecond the rotation's error is below a microradian.
void LaserScanner::sweepRays(Time start, const std::vector<Moment>& track, const RayCaster& rays) {
  SWIFTLET_CHECK(track.size() >= 2 && track.front().time <= start && track.back().time >= start + sweep());
  std::size_t beam = 0;
  for (std::size_t i = 0; i + 1 < track.size() && beam < beams_.size(); ++i) {
    const Moment &a = track[i], &b = track[i + 1];
    const Eigen::Matrix3d R0 = a.T_world_body.rotation.toRotationMatrix();
    const Eigen::Matrix3d dR = b.T_world_body.rotation.toRotationMatrix() - R0;
    const Eigen::Vector3d p0 = a.T_world_body.position_m, dp = b.T_world_body.position_m - p0;
    const double per_ns = 1.0 / static_cast<double>((b.time - a.time).nanoseconds());
    const std::size_t first = beam;
    for (; beam < beams_.size(); ++beam) {
      const Time time = start + time_increment_ * static_cast<std::int64_t>(beam);
      if (time > b.time) break;
      const double share = static_cast<double>((time - a.time).nanoseconds()) * per_ns;
      const Eigen::Matrix3d R = R0 + share * dR;
      const Beam& source = beams_[beam];
      rays_[beam] = {(p0 + share * dp + R * source.origin_body_m).cast<float>(),
                     (R * source.direction_body).normalized().cast<float>()};
    }
    const auto count = beam - first;
    rays.castAll(std::span(rays_).subspan(first, count), config_.range_max_m, b.actors,
                 std::span(distances_m_).subspan(first, count));
  }
}

void LaserScanner::addNoise(std::uint64_t frame, std::vector<float>& ranges_m) const {
  common::RandomStream random(seed_, "laser", frame);
  for (std::size_t i = 0; i < ranges_m.size(); ++i) {
    // Drawn for every beam, whatever it hits, so that the hit of one beam does not change the noise of the next.
    const bool dropped = random.chance(config_.dropout_rate);
    const double noise_m = random.gaussian(config_.range_noise_m);
    const double true_m = distances_m_[i];
    if (dropped) {
      ranges_m[i] = kErrorCode_m;
    } else if (!std::isfinite(true_m)) {
      ranges_m[i] = std::numeric_limits<float>::infinity();
    } else {
      const double noisy_m = true_m + noise_m * std::max(1.0, true_m / kNoiseGrowsFrom_m);
      const double counted_m = kStep_m * std::round(noisy_m / kStep_m);
      ranges_m[i] = counted_m < config_.range_min_m ? kErrorCode_m : static_cast<float>(counted_m);
    }
  }
}

common::LaserScan LaserScanner::scan(std::uint64_t frame, Time start, const std::vector<Moment>& track,
                                     const RayCaster& rays) {
  sweepRays(start, track, rays);
  common::LaserScan scan;
  scan.stamps.measured = start;
  scan.angle_min_rad = config_.angleMin_rad();
  scan.angle_increment_rad = config_.angleIncrement_rad();
  scan.time_increment = time_increment_;
  scan.range_min_m = config_.range_min_m;
  scan.range_max_m = config_.range_max_m;
  scan.ranges_m.resize(static_cast<std::size_t>(config_.beams));
  addNoise(frame, scan.ranges_m);
  return scan;
}

}  // namespace swiftlet::simulation

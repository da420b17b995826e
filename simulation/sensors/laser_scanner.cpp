#include "simulation/sensors/laser_scanner.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>

#include "common/check.hpp"
#include "simulation/sensors/daylight.hpp"
#include "simulation/world_model.hpp"

namespace swiftlet::simulation {
namespace {

using common::Duration;
using common::Time;

constexpr float kErrorCode_m = 0.0F;
/// The device counts millimetres (data sheet of the Hokuyo UTM-30LX).
constexpr double kStep_m = 0.001;
/// Range noise is constant up to here, then proportional to the range: 10 mm up to 10 m and 30 mm at 30 m on the data
/// sheet of the Hokuyo UTM-30LX.
constexpr double kNoiseGrowsFrom_m = 10.0;

/// The returned power goes with reflectance * cos(incidence) / range^2, so this times cos(incidence) is the square of
/// the range at which the beam is lost.
float seenSquared_m2(const LaserErrorsConfig& errors, double reflectance) {
  constexpr double kBlack = 0.04;  // At 905 nm.
  if (errors.dark_range_m <= 0.0) return std::numeric_limits<float>::infinity();
  return static_cast<float>(errors.dark_range_m * errors.dark_range_m * std::max(reflectance, kBlack) / kBlack);
}

}  // namespace

LaserScanner::LaserScanner(const common::LaserConfig& config, std::uint64_t seed)
    : LaserScanner(config, {}, WorldModel(), seed) {}

LaserScanner::LaserScanner(const common::LaserConfig& config, const LaserErrorsConfig& errors, const WorldModel& world,
                           std::uint64_t seed)
    : config_(config),
      errors_(errors),
      seed_(seed),
      time_increment_(
          Duration::fromNanoseconds(static_cast<std::int64_t>(std::floor(config.sweep_s * 1e9 / (config.beams - 1))))),
      rays_(static_cast<std::size_t>(config.beams)),
      distances_m_(static_cast<std::size_t>(config.beams)),
      hits_(errors.needsSurfaces() ? static_cast<std::size_t>(config.beams) : 0) {
  for (const Shape& shape : world.shapes) {
    seen_m2_.push_back(seenSquared_m2(errors, shape.color.mean()));
    glass_.push_back(shape.glass);
  }
  constexpr double kSkinAndCloth = 0.4;  // Reflectance at 905 nm.
  seen_m2_.push_back(seenSquared_m2(errors, kSkinAndCloth));
  if (errors.glass_angle_deg > 0.0)
    for (const Shape& shape : world.shapes) seen_.push_back(!shape.glass);
  const common::Pose3 T_true_sheet = errors.mount_error.pose();
  const common::Pose3 T_body_laser = T_true_sheet * config.mount.pose();
  const common::Pose3 T_body_mirror = T_true_sheet * config.mirror_mount.pose();
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
    castFrom(first, beam - first, b.actors, rays);
  }
}

void LaserScanner::castFrom(std::size_t first, std::size_t count, const std::vector<Actor>& actors,
                            const RayCaster& rays) {
  const auto beams = std::span(rays_).subspan(first, count);
  if (hits_.empty()) {
    rays.castAll(beams, config_.range_max_m, actors, std::span(distances_m_).subspan(first, count));
    return;
  }
  rays.castAll(beams, config_.range_max_m, actors, std::span(hits_).subspan(first, count));
  for (std::size_t i = first; i < first + count; ++i) {
    if (passesThrough(rays_[i], hits_[i])) hits_[i] = behindGlass(rays_[i], hits_[i], actors, rays);
    distances_m_[i] = static_cast<float>(hits_[i].distance_m);
  }
}

bool LaserScanner::passesThrough(const Ray& ray, const Hit& hit) const {
  const auto shape = static_cast<std::size_t>(hit.shape);
  if (errors_.glass_angle_deg <= 0.0 || !hit || shape >= glass_.size() || !glass_[shape]) return false;
  const double cos_incidence = std::abs(static_cast<double>(ray.direction_world.dot(hit.normal_world)));
  return cos_incidence < std::cos(errors_.glass_angle_deg * common::kRadPerDeg);
}

Hit LaserScanner::behindGlass(const Ray& ray, Hit hit, const std::vector<Actor>& actors, const RayCaster& rays) const {
  // More panes one behind the other than a building has; bounds the work of a ray.
  constexpr int kMostSurfaces = 16;
  constexpr double kStepBehind_m = 1e-3;  // Thinner than a pane.
  const Eigen::Vector3d origin = ray.origin_world_m.cast<double>(), direction = ray.direction_world.cast<double>();
  for (int surface = 0; surface < kMostSurfaces && passesThrough(ray, hit); ++surface) {
    const double passed_m = hit.distance_m + kStepBehind_m;
    hit = passed_m < config_.range_max_m
              ? rays.cast(origin + passed_m * direction, direction, config_.range_max_m - passed_m, actors)
              : Hit{};
    hit.distance_m += passed_m;  // Stays infinite where nothing is hit.
  }
  return hit;
}

bool LaserScanner::towardsSun(const Ray& ray) const {
  const double heading_rad = std::atan2(ray.direction_world.y(), ray.direction_world.x());
  return std::abs(common::wrapAngle(heading_rad - errors_.sun_direction_deg * common::kRadPerDeg)) <
         errors_.sun_width_deg * common::kRadPerDeg;
}

common::RandomStream LaserScanner::randomOf(const char* what, std::uint64_t frame, std::size_t beam) const {
  return {seed_, what, frame * distances_m_.size() + beam};
}

void LaserScanner::addSurfaceErrors(const std::vector<Actor>& actors, const RayCaster& rays) {
  constexpr float kLeastCos = 0.1F;
  const auto bias_m = static_cast<float>(errors_.incidence_bias_m);
  // Noise grows with the daylight that a surface returns, and the range at which the pulse is lost in it shrinks.
  const auto share = static_cast<float>(errors_.daylight_range_share);
  std::vector<std::uint8_t> lit;
  if (share < 1.0F) lit = inDaylight(rays_, hits_, actors, rays);
  for (std::size_t i = 0; i < hits_.size(); ++i) {
    const Hit& hit = hits_[i];
    if (!hit) continue;
    const float cos_incidence = std::abs(rays_[i].direction_world.dot(hit.normal_world));
    float seen_m2 = seen_m2_[std::min(static_cast<std::size_t>(hit.shape), seen_m2_.size() - 1)];
    if (!lit.empty() && lit[i] != 0) seen_m2 *= share * share;
    float& distance_m = distances_m_[i];
    if (distance_m * distance_m > seen_m2 * cos_incidence)
      distance_m = std::numeric_limits<float>::infinity();
    else
      distance_m += bias_m * (1.0F / std::max(kLeastCos, cos_incidence) - 1.0F);
  }
}

void LaserScanner::blindBySun(std::uint64_t frame) {
  for (std::size_t i = 0; i < distances_m_.size(); ++i)
    if (towardsSun(rays_[i]) && randomOf("sun", frame, i).chance(errors_.sun_dropout_rate))
      distances_m_[i] = std::numeric_limits<float>::infinity();
}

void LaserScanner::mixPixels(std::uint64_t frame) {
  // Mixed pixels arise where neighbouring beams differ by more than this; a slanted wall differs by less.
  constexpr float kEdge_m = 0.10F;
  for (std::size_t i = 0; i + 1 < distances_m_.size(); ++i) {
    const float step_m = distances_m_[i + 1] - distances_m_[i];
    if (!std::isfinite(step_m) || std::abs(step_m) <= kEdge_m) continue;
    common::RandomStream random = randomOf("mixed pixel", frame, i);
    if (random.chance(errors_.mixed_pixel_rate)) distances_m_[i] += static_cast<float>(random.uniform()) * step_m;
  }
}

void LaserScanner::noteGlass() {
  for (std::size_t i = 0; i < hits_.size(); ++i) {
    const auto shape = static_cast<std::size_t>(hits_[i].shape);
    if (hits_[i] && shape < seen_.size() && std::isfinite(distances_m_[i])) seen_[shape] = true;
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

/// By the laser's own clock, which is a little ahead or behind and gains or loses.
Time LaserScanner::stampOf(Time start) const {
  if (errors_.clock_offset_s == 0.0 && errors_.clock_drift_ppm == 0.0) return start;
  return start + Duration::fromSeconds(errors_.clock_offset_s + errors_.clock_drift_ppm * 1e-6 * start.seconds());
}

common::LaserScan LaserScanner::scan(std::uint64_t frame, Time start, const std::vector<Moment>& track,
                                     const RayCaster& rays) {
  sweepRays(start, track, rays);
  if (errors_.needsSurfaces()) addSurfaceErrors(track.back().actors, rays);
  if (errors_.sun_dropout_rate > 0.0) blindBySun(frame);
  if (errors_.mixed_pixel_rate > 0.0) mixPixels(frame);
  if (!seen_.empty()) noteGlass();
  common::LaserScan scan;
  scan.stamps.measured = stampOf(start);
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

// The laser: beams swept in time along the vehicle's path, some deflected down by the mirror, with range noise,
// millimetre steps, dropouts, and a shortest and a longest range; and with the errors of LaserErrorsConfig, each of
// which is off at 0.
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "common/geometry.hpp"
#include "common/random.hpp"
#include "common/sensor_event.hpp"
#include "common/vehicle_config.hpp"
#include "simulation/ray_caster.hpp"
#include "simulation/sensors/moment.hpp"
#include "simulation/sensors/sensor_config.hpp"

namespace swiftlet::simulation {

class LaserScanner {
 public:
  /// A laser as on its data sheet.
  LaserScanner(const common::LaserConfig& config, std::uint64_t seed);
  /// With errors that depend on the materials of the world's shapes.
  LaserScanner(const common::LaserConfig& config, const LaserErrorsConfig& errors, const WorldModel& world,
               std::uint64_t seed);

  common::Duration sweep() const { return time_increment_ * (config_.beams - 1); }

  /// Scan number `frame`, started at `start`. `track` is ordered in time and covers the whole sweep. Only the stamp
  /// `measured` is set. A beam that drops out, or hits nearer than range_min_m, reads 0 (the device's error code). A
  /// beam that hits nothing within range_max_m reads infinity.
  common::LaserScan scan(std::uint64_t frame, common::Time start, const std::vector<Moment>& track,
                         const RayCaster& rays);

  /// By shape of the world: whether a beam has ever returned from it; true for whatever is not glass. Empty if glass
  /// returns every beam.
  const std::vector<bool>& seen() const { return seen_; }

 private:
  struct Beam {
    Eigen::Vector3d origin_body_m;
    Eigen::Vector3d direction_body;
  };
  common::Time stampOf(common::Time start) const;
  void sweepRays(common::Time start, const std::vector<Moment>& track, const RayCaster& rays);
  void castFrom(std::size_t first, std::size_t count, const std::vector<Actor>& actors, const RayCaster& rays);
  /// Whether the beam goes through the surface, which is glass hit aslant (Foster 2013).
  bool passesThrough(const Ray& ray, const Hit& hit) const;
  /// The first hit behind the glass at `hit`.
  Hit behindGlass(const Ray& ray, Hit hit, const std::vector<Actor>& actors, const RayCaster& rays) const;
  /// Puts what the surfaces do to the beams into distances_m_: lost returns and biases.
  void addSurfaceErrors(const std::vector<Actor>& actors, const RayCaster& rays);
  void blindBySun(std::uint64_t frame);
  void mixPixels(std::uint64_t frame);
  bool towardsSun(const Ray& ray) const;
  void noteGlass();
  /// Random numbers of this beam of this scan alone, so that beams that need none take no time.
  common::RandomStream randomOf(const char* what, std::uint64_t frame, std::size_t beam) const;
  void addNoise(std::uint64_t frame, std::vector<float>& ranges_m) const;

  common::LaserConfig config_;
  LaserErrorsConfig errors_;
  std::uint64_t seed_;
  common::Duration time_increment_;
  std::vector<Beam> beams_;
  std::vector<Ray> rays_;  // Kept between scans to save the allocation.
  std::vector<float> distances_m_;
  /// Squared range at which a surface hit along its normal is still seen, by shape of the world; the last one is that
  /// of people and vehicles.
  std::vector<float> seen_m2_;
  std::vector<bool> glass_;  ///< By shape of the world.
  std::vector<bool> seen_;
  std::vector<Hit> hits_;  ///< Of the beams, when their surfaces matter.
};

}  // namespace swiftlet::simulation

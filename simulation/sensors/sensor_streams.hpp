// Sensors with their clocks: each makes the measurements that are due and gives them to the queue.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "common/time.hpp"
#include "simulation/ray_caster.hpp"
#include "simulation/sensors/camera.hpp"
#include "simulation/sensors/event_queue.hpp"
#include "simulation/sensors/laser_scanner.hpp"
#include "simulation/sensors/moment.hpp"
#include "simulation/sensors/rgbd_camera.hpp"

namespace swiftlet::simulation {

/// Counts the periods of a sensor; frame number `frame` is due at next().
struct SensorClock {
  explicit SensorClock(double rate_hz) : period(common::Duration::fromSeconds(1.0 / rate_hz)) {}
  common::Duration period;
  std::uint64_t frame = 0;
  common::Time next() const { return common::Time() + period * static_cast<std::int64_t>(frame); }
  bool due(common::Time now) const { return now >= next(); }
};

/// A laser with the track since the start of its present sweep.
class LaserStream {
 public:
  /// `sensor`: kLaser or kVerticalLaser.
  LaserStream(Sensor sensor, double rate_hz, LaserScanner scanner)
      : sensor_(sensor), scanner_(std::move(scanner)), clock_(rate_hz) {}

  /// Before the first step, at time 0.
  void begin(const Moment& start) { track_.assign(1, start); }
  /// Call each stream's step() after each physics step.
  void step(const Moment& moment, const RayCaster& rays, EventQueue& queue);
  const LaserScanner& scanner() const { return scanner_; }

 private:
  Sensor sensor_;
  LaserScanner scanner_;
  SensorClock clock_;
  std::vector<Moment> track_;
};

/// The operator's camera. Its frames are rendered only while they are wanted; the others are counted.
class CameraStream {
 public:
  /// The world must outlive it.
  CameraStream(const CameraConfig& config, const WorldModel& world, std::uint64_t seed)
      : config_(config), world_(world), seed_(seed), clock_(config.rate_hz) {}

  void setWanted(bool wanted) { wanted_ = wanted; }
  void step(const Moment& moment, const RayCaster& rays, EventQueue& queue);

 private:
  CameraConfig config_;
  const WorldModel& world_;
  std::uint64_t seed_;
  SensorClock clock_;
  std::optional<Camera> camera_;  ///< Made for the first frame that is wanted.
  bool wanted_ = false;
};

class RgbdStream {
 public:
  RgbdStream(double rate_hz, RgbdCamera camera) : camera_(std::move(camera)), clock_(rate_hz) {}

  void step(const Moment& moment, const RayCaster& rays, EventQueue& queue);

 private:
  RgbdCamera camera_;
  SensorClock clock_;
  std::vector<Moment> track_;  ///< Since the present frame began to be exposed.
};

}  // namespace swiftlet::simulation

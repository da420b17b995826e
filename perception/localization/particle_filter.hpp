// Monte Carlo localization (Dellaert, Fox, Burgard, Thrun 1999; Probabilistic Robotics, 8.3): particles are moved by
// the odometry with its noise (Grzonka 2009, eq. 4), weighted by the likelihood field (eq. 5) and resampled. Their
// number depends on the spread of the belief (Fox 2003).
//
// Frame: the map's grid.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/config_fwd.hpp"
#include "common/geometry.hpp"
#include "common/random.hpp"
#include "perception/localization/map_field.hpp"
#include "perception/scan_matching/window_sums.hpp"

namespace swiftlet::perception {

struct ParticleFilterConfig {
  int max_particles = 5000;
  bool adaptive = true;      ///< Whether there are as many particles as the belief needs (KLD sampling); otherwise
                             ///< always max_particles.
  double beam_weight = 0.2;  ///< Weight of one beam in the likelihood; 1 if all were independent, but neighbours are
                             ///< wrong about the map together.

  void describe(common::config::Fields& fields);
  std::vector<common::Problem> validate() const;
};

/// A possible pose of the vehicle.
struct PoseHypothesis {
  common::Pose2 T_grid_body;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< Of (x_m, y_m, yaw_rad), along the axes of the grid.
  double probability = 1.0;
};

/// Deterministic: the same calls with the same seed give the same particles. Not thread-safe.
class ParticleFilter {
 public:
  ParticleFilter(std::shared_ptr<const MapField> map, const ParticleFilterConfig& config, std::uint64_t seed,
                 Instructions instructions = bestInstructions());

  /// Spreads max_particles particles uniformly over the free cells, in any direction.
  void spreadOverFreeSpace();
  /// Draws max_particles particles around the hypotheses, in proportion to their probabilities and with their
  /// covariances. Takes at least one hypothesis.
  void spreadAround(std::span<const PoseHypothesis> hypotheses);

  /// Moves each particle by the step, in its own frame, with noise of that covariance: (x_m, y_m, yaw_rad), along the
  /// axes of the body before the step.
  void move(const common::Pose2& T_before_now, const Eigen::Matrix3d& covariance);
  /// Multiplies the weights by the likelihood of a scan's end points, given in the body frame.
  void weigh(std::span<const Eigen::Vector2f> points_body_m);
  /// Resamples in proportion to the weights, with low variance; all weights are equal afterwards.
  void resample();

  /// The weighted mean and covariance of the particles.
  PoseHypothesis estimate() const;

  std::size_t size() const { return x_m_.size(); }
  common::Pose2 particle(std::size_t i) const { return {x_m_[i], y_m_[i], yaw_rad_[i]}; }

 private:
  void resize(std::size_t count);
  void wrapAndTurn();
  void resampleAll(common::RandomStream& random);
  void resampleAdaptively(common::RandomStream& random);
  void keep(std::span<const std::uint32_t> chosen);

  std::shared_ptr<const MapField> map_;
  ParticleFilterConfig config_;
  std::uint64_t seed_;
  Instructions instructions_;
  std::uint64_t draws_ = 0;  ///< Index of the random stream for the next draw.

  std::vector<float> x_m_, y_m_, yaw_rad_, cosine_, sine_, weights_;
};

/// Cosine and sine of angles in [-2 pi, 2 pi], accurate to 1e-6 and the same on every machine.
void cosinesAndSines(std::span<const float> angles_rad, std::span<float> cosines, std::span<float> sines);

}  // namespace swiftlet::perception

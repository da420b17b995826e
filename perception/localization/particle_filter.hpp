// Monte Carlo localization (Dellaert, Fox, Burgard, Thrun 1999; Probabilistic Robotics, 8.3): particles are moved by
// the odometry with its noise (Grzonka 2009, eq. 4), weighed by the likelihood field (eq. 5) and drawn anew. How many
// there are follows the spread of the belief (Fox 2003).
//
// Frame: that of the map's grid.
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
  int min_particles = 500;
  bool adaptive = true;
  double kld_error = 0.05;
  double kld_quantile = 2.33;
  double kld_bin_m = 0.25;
  double kld_bin_deg = 10.0;
  int beams = 60;
  double beam_weight = 0.2;

  void describe(common::config::Fields& fields);
  std::vector<std::string> validate() const;
};

/// A place where the vehicle may be.
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

  /// Anywhere on the free cells, in any direction: max_particles.
  void spreadOverFreeSpace();
  /// In proportion to the probabilities, each as its covariance says. At least one hypothesis.
  void spreadAround(std::span<const PoseHypothesis> hypotheses);

  /// Moves each by the step in its own frame, and by noise of that covariance (x_m, y_m, yaw_rad; axes of the body
  /// before the step).
  void move(const common::Pose2& T_before_now, const Eigen::Matrix3d& covariance);
  /// Multiplies the weights by the likelihood of end points in the body frame.
  void weigh(std::span<const Eigen::Vector2f> points_body_m);
  /// Draws particles in proportion to their weights, with low variance; all weights are equal afterwards.
  void resample();

  struct Estimate {
    common::Pose2 T_grid_body;
    Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  };
  /// The weighted mean.
  Estimate estimate() const;

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
  std::uint64_t draws_ = 0;  ///< Names the random stream of the next draw.

  std::vector<float> x_m_, y_m_, yaw_rad_, cosine_, sine_, weights_;
  // Kept between calls.
  std::vector<float> cells_x_, cells_y_, beams_x_, beams_y_, other_;
  std::vector<std::int32_t> sums_;
  std::vector<std::uint32_t> chosen_;
  std::vector<double> cumulated_;
};

/// Cosine and sine of angles in [-2 pi, 2 pi], good to 1e-6 and the same on every machine.
void cosinesAndSines(std::span<const float> angles_rad, std::span<float> cosines, std::span<float> sines);

}  // namespace swiftlet::perception

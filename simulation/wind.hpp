// A steady wind with gusts about its mean: Gauss-Markov processes, or Dryden's spectra.
#pragma once

#include <cstdint>

#include <Eigen/Core>

#include "simulation/scenario.hpp"

namespace swiftlet::simulation {

class Wind {
 public:
  Wind(const WindConfig& config, int seed);

  const Eigen::Vector3d& velocity_world_m_s() const { return velocity_world_m_s_; }
  void step(std::uint64_t tick, double step_s);

 private:
  void stepGaussMarkov(std::uint64_t tick, double step_s);
  void stepDryden(std::uint64_t tick, double step_s);

  WindConfig config_;
  int seed_;
  Eigen::Vector3d velocity_world_m_s_;
  Eigen::Vector3d gust_m_s_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d driven_ = Eigen::Vector3d::Zero();    ///< Dryden: of first order, with variance 1.
  Eigen::Vector3d followed_ = Eigen::Vector3d::Zero();  ///< Dryden: driven_ behind a low pass.
};

}  // namespace swiftlet::simulation

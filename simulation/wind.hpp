// A steady wind with gusts: each horizontal component a Gauss-Markov process about its mean.
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
  WindConfig config_;
  int seed_;
  Eigen::Vector3d velocity_world_m_s_;
  Eigen::Vector2d gust_m_s_ = Eigen::Vector2d::Zero();
};

}  // namespace swiftlet::simulation

#include "simulation/wind.hpp"

#include <cmath>

#include "common/random.hpp"

namespace swiftlet::simulation {

Wind::Wind(const WindConfig& config, int seed)
    : config_(config), seed_(seed), velocity_world_m_s_(config.mean_x_m_s, config.mean_y_m_s, 0.0) {}

void Wind::step(std::uint64_t tick, double step_s) {
  common::RandomStream random(static_cast<std::uint64_t>(seed_), "wind", tick);
  const double keep = std::exp(-step_s / config_.gust_time_s);
  const double drive_m_s = config_.gust_m_s * std::sqrt(1.0 - keep * keep);
  for (int axis = 0; axis < 2; ++axis) gust_m_s_[axis] = keep * gust_m_s_[axis] + random.gaussian(drive_m_s);
  velocity_world_m_s_ = {config_.mean_x_m_s + gust_m_s_.x(), config_.mean_y_m_s + gust_m_s_.y(), 0.0};
}

}  // namespace swiftlet::simulation

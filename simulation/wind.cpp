#include "simulation/wind.hpp"

#include <cmath>

#include "common/random.hpp"

namespace swiftlet::simulation {

Wind::Wind(const WindConfig& config, int seed)
    : config_(config), seed_(seed), velocity_world_m_s_(config.mean_x_m_s, config.mean_y_m_s, 0.0) {}

void Wind::step(std::uint64_t tick, double step_s) {
  if (config_.model == GustModel::kDryden)
    stepDryden(tick, step_s);
  else
    stepGaussMarkov(tick, step_s);
  velocity_world_m_s_ = {config_.mean_x_m_s + gust_m_s_.x(), config_.mean_y_m_s + gust_m_s_.y(), gust_m_s_.z()};
}

void Wind::stepGaussMarkov(std::uint64_t tick, double step_s) {
  common::RandomStream random(static_cast<std::uint64_t>(seed_), "wind", tick);
  const double keep = std::exp(-step_s / config_.gust_time_s);
  const double drive_m_s = config_.gust_m_s * std::sqrt(1.0 - keep * keep);
  for (int axis = 0; axis < 2; ++axis) gust_m_s_[axis] = keep * gust_m_s_[axis] + random.gaussian(drive_m_s);
}

// With T = length scale / airspeed = gust_time_s, the lateral spectrum is that of white noise behind
// (1 + sqrt(3) T s) / (1 + T s)^2. Behind the first lag the noise is `driven_`; of its second lag `followed_` the whole
// is sqrt(3) driven_ + (1 - sqrt(3)) followed_, whose variance is 2.
void Wind::stepDryden(std::uint64_t tick, double step_s) {
  common::RandomStream random(static_cast<std::uint64_t>(seed_), "dryden wind", tick);
  const double keep = std::exp(-step_s / config_.gust_time_s), root3 = std::sqrt(3.0);
  for (int axis = 0; axis < 3; ++axis)
    driven_[axis] = keep * driven_[axis] + random.gaussian(std::sqrt(1.0 - keep * keep));
  followed_ += (1.0 - keep) * (driven_ - followed_);
  gust_m_s_ = config_.gust_m_s / std::sqrt(2.0) * (root3 * driven_ + (1.0 - root3) * followed_);
  gust_m_s_.x() = config_.gust_m_s * driven_.x();
}

}  // namespace swiftlet::simulation

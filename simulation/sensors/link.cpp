#include "simulation/sensors/link.hpp"

#include <algorithm>
#include <utility>

#include "common/random.hpp"

namespace swiftlet::simulation {

Link::Link(const LinkConfig& config, std::uint64_t seed, std::string name)
    : config_(config), seed_(seed), name_(std::move(name) + " link") {}

std::optional<common::Time> Link::arrival(std::uint64_t frame, common::Time ready) {
  common::RandomStream random(seed_, name_, frame);
  const bool lost = random.chance(config_.loss_rate);
  const double delay_s = config_.latency_s + config_.jitter_s * random.uniform();
  if (lost) return std::nullopt;
  last_ = std::max(last_, ready + common::Duration::fromSeconds(delay_s));
  return last_;
}

}  // namespace swiftlet::simulation

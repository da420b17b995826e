#include "simulation/sensors/link.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/random.hpp"

namespace swiftlet::simulation {

Link::Link(const LinkConfig& config, std::uint64_t seed, std::string name)
    : config_(config), seed_(seed), name_(std::move(name) + " link") {}

std::optional<common::Time> Link::arrival(std::uint64_t frame, common::Time ready) {
  common::RandomStream random(seed_, name_, frame);
  const bool lost = random.chance(config_.loss_rate);
  const double delay_s = config_.latency_s + config_.jitter_s * random.uniform();
  if (isOut(ready) || lost) return std::nullopt;
  const common::Time arrived = ready + common::Duration::fromSeconds(delay_s);
  if (!config_.in_order) return arrived;
  last_ = std::max(last_, arrived);
  return last_;
}

/// Outages begin as a Poisson process does: the time between them is exponential.
bool Link::isOut(common::Time ready) {
  if (config_.outage_every_s <= 0.0) return false;
  const auto pause = [&] {
    common::RandomStream random(seed_, name_ + " outage", outage_++);
    return common::Duration::fromSeconds(-config_.outage_every_s * std::log(1.0 - random.uniform()));
  };
  const auto length = common::Duration::fromSeconds(config_.outage_s);
  if (!next_outage_) next_outage_ = ready + pause();
  while (ready >= *next_outage_ + length) *next_outage_ += length + pause();
  return ready >= *next_outage_;
}

}  // namespace swiftlet::simulation

// The link from the computer to the autopilot: setpoints under way.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include "common/vehicle.hpp"
#include "simulation/sensors/link.hpp"

namespace swiftlet::simulation {

class SetpointLink {
 public:
  struct Arrival {
    common::Time time;
    common::Setpoint setpoint;
  };

  /// `seed` names the random stream.
  SetpointLink(const LinkConfig& config, std::uint64_t seed) : link_(config, seed, "command") {}

  void send(common::Time now, const common::Setpoint& setpoint) {
    if (const auto arrival = link_.arrival(sent_++, now)) under_way_.push_back({*arrival, setpoint});
  }
  /// Takes the next setpoint that has arrived by `now`, in the order of sending: none overtakes another.
  std::optional<Arrival> next(common::Time now) {
    if (under_way_.empty() || under_way_.front().time > now) return std::nullopt;
    const Arrival first = under_way_.front();
    under_way_.pop_front();
    return first;
  }

 private:
  Link link_;
  std::uint64_t sent_ = 0;
  std::deque<Arrival> under_way_;
};

}  // namespace swiftlet::simulation

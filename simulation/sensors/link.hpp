// The link from a sensor to the computer: latency, jitter, loss and outages; first in, first out if it is in order.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "common/time.hpp"
#include "simulation/sensors/sensor_config.hpp"

namespace swiftlet::simulation {

class Link {
 public:
  /// `name` names the random stream.
  Link(const LinkConfig& config, std::uint64_t seed, std::string name);

  /// The arrival time of measurement number `frame`, ready at `ready`; nullopt if it is lost. Call it in the order of
  /// frames. Leaving out a frame does not change the random draws of the others.
  std::optional<common::Time> arrival(std::uint64_t frame, common::Time ready);

 private:
  LinkConfig config_;
  std::uint64_t seed_;
  std::string name_;
  bool isOut(common::Time ready);

  common::Time last_;
  std::uint64_t outage_ = 0;                 ///< Number of the next outage.
  std::optional<common::Time> next_outage_;  ///< Its beginning; nullopt before the first measurement.
};

}  // namespace swiftlet::simulation

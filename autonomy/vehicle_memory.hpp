// What one flight learns of its vehicle and the next may start from.
#pragma once

#include <string>
#include <vector>

#include "common/config_fwd.hpp"
#include "control/thrust_table.hpp"

namespace swiftlet::autonomy {

/// A part of what an autonomy is made of, not an input: a recording is replayed with the memory of its flight.
struct VehicleMemory {
  static constexpr int kVersion = 1;

  int version = 0;
  std::string vehicle;           ///< Name on the data sheet of the vehicle it is of.
  control::ThrustPoints thrust;  ///< By rising voltage.

  void describe(common::config::Fields& fields);
  std::vector<common::Problem> validate() const;
};

}  // namespace swiftlet::autonomy

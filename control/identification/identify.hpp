// The model of a vehicle from its flights.
#pragma once

#include <string>
#include <vector>

#include "control/identification/axis_fit.hpp"
#include "control/identification/thrust_em.hpp"

namespace swiftlet::control {

struct Identification {
  VehicleModel model;                 ///< Its axes are those of equation 1; it contains C(U) if that was found.
  std::vector<std::string> problems;  ///< "forward: why it was not identified"; such an axis has the gain 0.
  std::vector<std::string> doubts;    ///< "yaw: what of it is uncertain", of axes that are used nevertheless.
  // The axes with damping, equation 2, for the report: whether k2 differs from 0.
  AxisModel damped_forward;
  AxisModel damped_left;
  AxisModel damped_up;
  ThrustEm thrust;
};

/// All flights are of that vehicle. Never fails as a whole: what cannot be determined is listed.
Identification identify(const std::vector<FlightSamples>& flights, const common::VehicleConfig& vehicle,
                        const AxisFitOptions& options = {});

}  // namespace swiftlet::control

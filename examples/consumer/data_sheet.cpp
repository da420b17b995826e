// Reads a vehicle's data sheet with Swiftlet's configuration and prints what follows from it.
#include <cstdio>

#include "common/config.hpp"
#include "common/error.hpp"
#include "common/vehicle_config.hpp"

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: data_sheet VEHICLE.yaml\n");
    return 2;
  }
  try {
    const auto vehicle = swiftlet::common::config::readFile<swiftlet::common::VehicleConfig>(argv[1]);
    std::printf("%s: hull radius %.3f m, thrust to weight %.2f\n", vehicle.name.c_str(), vehicle.hullRadius_m(),
                vehicle.max_thrust_n / (vehicle.mass_kg * 9.81));
    return 0;
  } catch (const swiftlet::common::InputError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}

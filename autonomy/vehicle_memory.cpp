#include "autonomy/vehicle_memory.hpp"

#include "common/config_fields.hpp"

namespace swiftlet::autonomy {

void VehicleMemory::describe(common::config::Fields& fields) {
  fields("version", version, {kVersion, kVersion}, "Version of this file's form.");
  fields("vehicle", vehicle, "Name of the vehicle, as on its data sheet.");
  fields.list("thrust", thrust, "The command that carries the weight, by battery voltage.");
}

std::vector<common::Problem> VehicleMemory::validate() const { return control::problemsOf(thrust); }

}  // namespace swiftlet::autonomy

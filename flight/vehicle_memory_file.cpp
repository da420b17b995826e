#include "flight/vehicle_memory_file.hpp"

#include <utility>

#include <fmt/format.h>

#include "common/config.hpp"
#include "common/error.hpp"
#include "common/rounding.hpp"
#include "control/thrust_table.hpp"

namespace swiftlet::flight {
namespace {

void refuseOtherBattery(const autonomy::VehicleMemory& memory, const common::VehicleConfig& vehicle,
                        const common::config::YamlReader& reader) {
  std::optional<common::Problem> problem = control::otherBatteryProblem(memory.thrust, vehicle);
  if (!problem) return;
  problem->location = reader.locationOf(problem->element);
  problem->hint = "give each battery a file of its own";
  throw common::InputError(*problem);
}

}  // namespace

VehicleMemorySetup setupOfMemory(const std::filesystem::path& file, const common::VehicleConfig& vehicle,
                                 std::size_t vehicles, MemoryUse use) {
  const bool writes = use == MemoryUse::kReadAndWrite;
  const auto unusable = [&](const common::Message& message, const std::string& hint) {
    return common::InputError({file.string()}, "--vehicle-memory", message, hint);
  };
  if (vehicles > 1)
    throw unusable(common::Message("vehicle-memory.several-vehicles", "is of one vehicle, but {} fly", vehicles),
                   "fly them one by one");
  auto memory = readVehicleMemory(file, vehicle);
  if (!memory && !writes)
    throw unusable(common::Message("file.missing", "no such file"), "a flight with `fly --vehicle-memory` makes one");
  const std::filesystem::path folder = file.parent_path();
  if (!folder.empty() && !std::filesystem::is_directory(folder))
    throw unusable(common::Message("file.no-folder", "its folder does not exist"), "make the folder first");
  if (writes)
    if (const auto written = interfaces::tryToWrite(file); !written)
      throw common::InputError({}, "--vehicle-memory", written.error().message.behind("cannot be written: "));
  VehicleMemorySetup setup;
  setup.kept = true;
  if (memory) setup.read = std::make_shared<const autonomy::VehicleMemory>(std::move(*memory));
  if (writes) setup.file = file;
  return setup;
}

std::optional<autonomy::VehicleMemory> readVehicleMemory(const std::filesystem::path& file,
                                                         const common::VehicleConfig& vehicle) {
  std::error_code failure;
  if (!std::filesystem::exists(file, failure)) return std::nullopt;
  common::config::YamlReader reader = common::config::YamlReader::fromFile(file.string());
  autonomy::VehicleMemory memory;
  reader.read(memory);
  if (memory.vehicle != vehicle.name)
    throw common::InputError(reader.locationOf("vehicle"), "vehicle",
                             common::Message("vehicle-memory.other-vehicle", "is that of `{}`, but `{}` flies",
                                             memory.vehicle, vehicle.name),
                             "give each vehicle a file of its own");
  refuseOtherBattery(memory, vehicle, reader);
  return memory;
}

std::string toYaml(autonomy::VehicleMemory memory) {
  for (control::ThrustPoint& point : memory.thrust)
    point = {common::rounded(point.voltage_v), common::rounded(point.hover_command), common::rounded(point.seen_s)};
  return "# What Swiftlet has learned of this vehicle in flight; --vehicle-memory reads and writes it.\n" +
         common::config::YamlPrinter(common::config::YamlPrinter::Comments::kNo).print(memory);
}

interfaces::Written writeVehicleMemory(const std::filesystem::path& file, const autonomy::VehicleMemory& memory) {
  return interfaces::writeAtomically(file, toYaml(memory), interfaces::Durability::kPower);
}

}  // namespace swiftlet::flight

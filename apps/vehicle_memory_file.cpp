#include "apps/vehicle_memory_file.hpp"

#include <utility>

#include <fmt/format.h>

#include "common/config.hpp"
#include "common/error.hpp"
#include "common/rounding.hpp"
#include "control/battery_span.hpp"

namespace swiftlet::apps {
namespace {

/// The table is learned within the span of the vehicle's battery, so a voltage outside is of another one.
void refuseOtherBattery(const autonomy::VehicleMemory& memory, const common::VehicleConfig& vehicle,
                        const common::config::YamlReader& reader) {
  constexpr double kRounding_v = 0.01;  // A knot at an end of the span may be written a little beyond it.
  const control::VoltageSpan span = control::batterySpan(vehicle);
  for (std::size_t i = 0; i < memory.thrust.size(); ++i) {
    const double voltage_v = memory.thrust[i].voltage_v;
    if (voltage_v >= span.low_v - kRounding_v && voltage_v <= span.high_v + kRounding_v) continue;
    const std::string key = fmt::format("thrust[{}].voltage_v", i);
    throw common::InputError(
        common::Problem{reader.locationOf(key), key,
                        fmt::format("{} V is of another battery: that of `{}` has {:.2f} to {:.2f} V in flight",
                                    voltage_v, vehicle.name, span.low_v, span.high_v),
                        "give each battery a file of its own"});
  }
}

}  // namespace

VehicleMemorySetup setupOfMemory(const std::filesystem::path& file, const common::VehicleConfig& vehicle,
                                 std::size_t vehicles, MemoryUse use) {
  const bool writes = use == MemoryUse::kReadAndWrite;
  const auto unusable = [&](const std::string& message, const std::string& hint) {
    return common::InputError(common::Problem{{file.string()}, "--vehicle-memory", message, hint});
  };
  if (vehicles > 1) throw unusable(fmt::format("is of one vehicle, but {} fly", vehicles), "fly them one by one");
  auto memory = readVehicleMemory(file, vehicle);
  if (!memory && !writes) throw unusable("there is no such file", "a flight with `fly --vehicle-memory` makes one");
  const std::filesystem::path folder = file.parent_path();
  if (!folder.empty() && !std::filesystem::is_directory(folder))
    throw unusable("its folder does not exist", "make the folder first");
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
    throw common::InputError(
        common::Problem{reader.locationOf("vehicle"), "vehicle",
                        fmt::format("is that of `{}`, but `{}` flies", memory.vehicle, vehicle.name),
                        "give each vehicle a file of its own"});
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

}  // namespace swiftlet::apps

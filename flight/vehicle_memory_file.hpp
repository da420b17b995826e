// The file of --vehicle-memory: what earlier flights have learned of one vehicle.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "autonomy/vehicle_memory.hpp"
#include "common/vehicle_config.hpp"
#include "interfaces/files/atomic_file.hpp"

namespace swiftlet::flight {

/// What a flight does with the memory of its vehicle.
struct VehicleMemorySetup {
  bool kept = false;                                    ///< What is read and what is learned are kept in the run.
  std::shared_ptr<const autonomy::VehicleMemory> read;  ///< What it starts from; null: the data sheet.
  std::filesystem::path file;                           ///< Where it is kept for the next flight; empty: nowhere.
};

enum class MemoryUse { kRead, kReadAndWrite };

/// The memory for --vehicle-memory. A flight that writes it may be the first, so the file may be missing then. Throws
/// common::InputError for a file that cannot be used, and for `vehicles` more than one.
VehicleMemorySetup setupOfMemory(const std::filesystem::path& file, const common::VehicleConfig& vehicle,
                                 std::size_t vehicles, MemoryUse use);

/// nullopt without such a file. Throws common::InputError, with line and column, for a file that is no memory or
/// that of another vehicle.
std::optional<autonomy::VehicleMemory> readVehicleMemory(const std::filesystem::path& file,
                                                         const common::VehicleConfig& vehicle);

/// Numbers have four decimals.
std::string toYaml(autonomy::VehicleMemory memory);

/// Readers see the old file or the new one, also after a power cut.
[[nodiscard]] interfaces::Written writeVehicleMemory(const std::filesystem::path& file,
                                                     const autonomy::VehicleMemory& memory);

}  // namespace swiftlet::flight

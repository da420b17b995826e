// The mission files of a folder, for the page.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "behaviors/registry.hpp"
#include "web/server/mission_shelf.hpp"

namespace swiftlet::flight {

class FolderShelf final : public web::MissionShelf {
 public:
  /// `first` is a mission of its own, listed before those of `folder`; a folder that does not exist has no missions.
  /// `map_seed`: of the particles, in the maps that missions load.
  FolderShelf(std::filesystem::path first, std::filesystem::path folder, std::uint64_t map_seed,
              behaviors::NodeTypes types)
      : first_(std::move(first)), folder_(std::move(folder)), map_seed_(map_seed), types_(std::move(types)) {}

  std::string list() override;
  tl::expected<common::StartMissionCommand, std::string> take(
      const std::string& file, const std::map<std::string, std::string>& parameters) override;

 private:
  /// Read again each time, so that a file that was edited is flown as it is.
  std::vector<std::filesystem::path> files() const;

  std::filesystem::path first_;
  std::filesystem::path folder_;
  std::uint64_t map_seed_;
  behaviors::NodeTypes types_;
};

/// The folder of missions that findData finds; a path that does not exist if it finds no folder.
std::filesystem::path shippedMissions();

}  // namespace swiftlet::flight

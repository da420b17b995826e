// The missions that a page may start. The program that owns the files implements it.
#pragma once

#include <map>
#include <string>

#include <tl/expected.hpp>

#include "common/command.hpp"

namespace swiftlet::web {

/// Called on the server's thread.
class MissionShelf {
 public:
  virtual ~MissionShelf() = default;

  /// [{"file", "about", "parameters": [{"key", "node", "port", "value", "expected", "choices"}]}], as JSON.
  virtual std::string list() = 0;
  /// The mission of a listed file with these parameters, or why it cannot be flown.
  virtual tl::expected<common::StartMissionCommand, std::string> take(
      const std::string& file, const std::map<std::string, std::string>& parameters) = 0;
};

}  // namespace swiftlet::web

// events.jsonl: one JSON object a line, in the order of the events, each written to the disk before the next.
#pragma once

#include <filesystem>
#include <string>

#include "common/event.hpp"
#include "interfaces/files/atomic_file.hpp"

namespace swiftlet::interfaces {

/// {"t_s": 12.5, "severity": "info", "source": "mission", "text": "...", "reason": "..."}, without the newline. An
/// event that names a vehicle also has "vehicle": "..." at its end.
std::string toJson(const common::Event& event);

class EventWriter {
 public:
  [[nodiscard]] static tl::expected<EventWriter, FileError> create(const std::filesystem::path& file);
  [[nodiscard]] Written write(const common::Event& event);

 private:
  explicit EventWriter(AppendFile file) : file_(std::move(file)) {}
  AppendFile file_;
};

}  // namespace swiftlet::interfaces

// events.jsonl: one JSON object a line, in the order they happened, each on the disk before the next is taken.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/event.hpp"
#include "interfaces/files/atomic_file.hpp"

namespace swiftlet::interfaces {

/// {"t_s": 12.5, "severity": "info", "source": "mission", "text": "...", "reason": "..."}, without the newline. With
/// "vehicle": "..." at its end when the event names one.
std::string toJson(const common::Event& event);

class EventWriter {
 public:
  [[nodiscard]] static tl::expected<EventWriter, FileError> create(const std::filesystem::path& file);
  [[nodiscard]] Written write(const common::Event& event);

 private:
  explicit EventWriter(AppendFile file) : file_(std::move(file)) {}
  AppendFile file_;
};

/// Throws InputError with file and line. A last line without its newline is that of a process that was killed while
/// writing, and is left out.
std::vector<common::Event> readEvents(const std::filesystem::path& file);

}  // namespace swiftlet::interfaces

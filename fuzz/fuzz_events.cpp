// links: interfaces common
// Any bytes as events.jsonl: refused as InputError, or events that are written and read back.
#include <cstdint>
#include <cstdlib>
#include <string>

#include "common/error.hpp"
#include "fuzz/scratch.hpp"
#include "interfaces/files/json_lines.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace swiftlet;
  try {
    const auto events = interfaces::readEvents(fuzz::put("events.jsonl", {reinterpret_cast<const char*>(data), size}));
    std::string written;
    for (const common::Event& event : events) written += interfaces::toJson(event) + "\n";
    if (interfaces::readEvents(fuzz::put("written.jsonl", written)).size() != events.size()) std::abort();
  } catch (const common::InputError& error) {
    if (error.problems().empty()) std::abort();
  }
  return 0;
}

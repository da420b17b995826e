// links: tree
// Any bytes as the value of a port: the first says of which type. What is read can be written, and reads back as the
// same value (a duration is written for people only).
#include <array>
#include <cstdint>
#include <string>

#include "behaviors/tree/port.hpp"

using namespace swiftlet::tree;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  constexpr std::array kTypes = {PortType::kAny,    PortType::kString,    PortType::kDouble,
                                 PortType::kInt,    PortType::kBool,      PortType::kPoint,
                                 PortType::kPoints, PortType::kRectangle, PortType::kDuration};
  const PortType type = kTypes[data[0] % kTypes.size()];
  const std::string text(reinterpret_cast<const char*>(data + 1), size - 1);
  const PortManifest port{.name = "p_s", .type = type, .minimum = -5.0, .maximum = 1e6};
  const ReadValue read = readValue(port, text);
  if (read.value.has_value() != read.problem.empty()) __builtin_trap();
  if (!read.value || type == PortType::kDuration) return 0;
  const std::string written = toString(*read.value);
  const auto again = parseValue(written, type, "s");
  if (!again || *again != *read.value) __builtin_trap();
  return 0;
}

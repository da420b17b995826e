#include "rendering/color.hpp"

#include <fmt/format.h>

namespace swiftlet::rendering {

std::string toHex(Color color) { return fmt::format("#{:02x}{:02x}{:02x}", color.red, color.green, color.blue); }

}  // namespace swiftlet::rendering

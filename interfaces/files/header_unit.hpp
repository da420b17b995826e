// The unit of length that the header of a cloud names in a comment. Neither .ply nor .pcd has a line for it.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace swiftlet::interfaces {

struct HeaderUnit {
  std::string word;  ///< As it is written there.
  double metres = 1.0;
};

/// The unit of "units: centimeters", "length_unit=mm" and, for unambiguous words, of "inches" alone. nullopt for
/// other texts: "scanned in 5 m steps" says nothing about the coordinates.
std::optional<HeaderUnit> unitIn(std::string_view comment);

}  // namespace swiftlet::interfaces

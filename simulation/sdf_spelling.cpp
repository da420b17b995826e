#include "simulation/sdf_spelling.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include <fmt/format.h>

#include "common/error.hpp"
#include "common/misleading.hpp"
#include "simulation/sdf_numbers.hpp"

namespace swiftlet::simulation {
namespace {

/// An element or attribute that is not a number, by the name of the element around it.
struct Part {
  std::string_view parent;
  std::string_view name;
};

/// What holds the geometry of things, each in the element where it belongs first.
constexpr std::array kHolders{Part{"sdf", "world"},   Part{"world", "model"},    Part{"world", "include"},
                              Part{"model", "link"},  Part{"link", "collision"}, Part{"collision", "geometry"},
                              Part{"sdf", "model"},   Part{"model", "model"},    Part{"model", "include"},
                              Part{"link", "visual"}, Part{"visual", "geometry"}};
constexpr std::array kOthers{Part{"world", "frame"},
                             Part{"model", "frame"},
                             Part{"frame", "attached_to"},
                             Part{"pose", "relative_to"},
                             Part{"pose", "rotation_format"},
                             Part{"model", "placement_frame"},
                             Part{"include", "placement_frame"},
                             Part{"include", "uri"},
                             Part{"mesh", "uri"},
                             Part{"mesh", "submesh"},
                             Part{"polyline", "point"},
                             Part{"heightmap", "uri"}};

std::vector<std::string> partsOf(std::string_view parent) {
  std::vector<std::string> names = numberElementsOf(parent);
  const auto add = [&](const auto& parts) {
    for (const Part& part : parts)
      if (part.parent == parent) names.emplace_back(part.name);
  };
  add(kHolders);
  add(kOthers);
  return names;
}

}  // namespace

std::string spellingHint(std::string_view name, std::string_view parent) {
  const std::vector<std::string> parts = partsOf(parent);
  // An attribute that is written as an element has the right name.
  if (parts.empty() || std::find(parts.begin(), parts.end(), name) != parts.end()) return {};
  if (std::string hint = common::misleadingHint(name); !hint.empty()) return hint;
  if (std::string hint = common::didYouMean(name, parts); !hint.empty()) return hint;
  const auto* home =
      std::find_if(kHolders.begin(), kHolders.end(), [&](const Part& part) { return part.name == name; });
  return home == kHolders.end() || name == "visual" ? "" : fmt::format("it belongs in a <{}>", home->parent);
}

}  // namespace swiftlet::simulation

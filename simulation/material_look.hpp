// The look of a thing by the visuals of an SDF file.
#pragma once

#include <optional>
#include <string>

#include <sdf/Visual.hh>

#include "simulation/world_model.hpp"

namespace swiftlet::simulation {

/// What the material says of a geometry.
struct Look {
  std::optional<Color> color;
  bool glass = false;
  std::optional<Pattern> pattern = {};
  std::string image = {};  ///< A file; empty if there is none.
  bool mirror = false;
};

/// The colour of a visual's material, if it has one.
std::optional<Color> colorOf(const sdf::Visual* visual);

/// The pattern of a material script of Gazebo, if it is one of the most common.
std::optional<Pattern> scriptPattern(const std::string& script);

/// A soft colour, different for each model, for models without a colour.
Color colorByName(const std::string& name);

}  // namespace swiftlet::simulation

#include "simulation/material_look.hpp"

#include <array>
#include <utility>

#include <sdf/Element.hh>
#include <sdf/Material.hh>

#include "common/random.hpp"
#include "simulation/appearance/patterns.hpp"

namespace swiftlet::simulation {
namespace {

/// Colours of the most common material scripts of Gazebo.
std::optional<Color> scriptColor(const std::string& script) {
  static const std::array<std::pair<const char*, Color>, 16> kColors{{{"Gazebo/Grey", {0.7F, 0.7F, 0.7F}},
                                                                      {"Gazebo/DarkGrey", {0.18F, 0.18F, 0.18F}},
                                                                      {"Gazebo/Gray", {0.7F, 0.7F, 0.7F}},
                                                                      {"Gazebo/White", {1.0F, 1.0F, 1.0F}},
                                                                      {"Gazebo/Black", {0.05F, 0.05F, 0.05F}},
                                                                      {"Gazebo/Red", {0.9F, 0.1F, 0.1F}},
                                                                      {"Gazebo/Green", {0.1F, 0.8F, 0.1F}},
                                                                      {"Gazebo/Blue", {0.1F, 0.1F, 0.9F}},
                                                                      {"Gazebo/Yellow", {0.95F, 0.9F, 0.1F}},
                                                                      {"Gazebo/Orange", {0.95F, 0.5F, 0.1F}},
                                                                      {"Gazebo/Purple", {0.8F, 0.1F, 0.8F}},
                                                                      {"Gazebo/Wood", {0.6F, 0.42F, 0.25F}},
                                                                      {"Gazebo/WoodFloor", {0.65F, 0.45F, 0.28F}},
                                                                      {"Gazebo/WoodPallet", {0.62F, 0.48F, 0.3F}},
                                                                      {"Gazebo/Bricks", {0.6F, 0.3F, 0.22F}},
                                                                      {"Gazebo/CeilingTiled", {0.9F, 0.9F, 0.88F}}}};
  for (const auto& [name, color] : kColors)
    if (script == name) return color;
  return std::nullopt;
}

}  // namespace

std::optional<Color> colorOf(const sdf::Visual* visual) {
  if (visual == nullptr || visual->Material() == nullptr) return std::nullopt;
  const sdf::Material& material = *visual->Material();
  if (auto color = scriptColor(material.ScriptName())) return color;
  if (!material.Element() || !material.Element()->HasElement("diffuse")) return std::nullopt;
  const auto diffuse = material.Diffuse();
  return Color(diffuse.R(), diffuse.G(), diffuse.B());
}

std::optional<Pattern> scriptPattern(const std::string& script) {
  static const std::array<std::pair<const char*, Pattern>, 5> kPatterns{{{"Gazebo/Wood", Pattern::kWood},
                                                                         {"Gazebo/WoodFloor", Pattern::kWood},
                                                                         {"Gazebo/WoodPallet", Pattern::kWood},
                                                                         {"Gazebo/Bricks", Pattern::kBrick},
                                                                         {"Gazebo/CeilingTiled", Pattern::kTiles}}};
  for (const auto& [name, pattern] : kPatterns)
    if (script == name) return pattern;
  return std::nullopt;
}

Color colorByName(const std::string& name) {
  common::RandomStream random(0, name);
  const auto channel = [&random] { return static_cast<float>(random.uniform(0.45, 0.85)); };
  const float red = channel(), green = channel(), blue = channel();
  return {red, green, blue};
}

}  // namespace swiftlet::simulation

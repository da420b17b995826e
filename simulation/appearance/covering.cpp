#include "simulation/appearance/covering.hpp"

#include <algorithm>
#include <array>

#include <Eigen/Geometry>

#include "common/random.hpp"
#include "simulation/world_model.hpp"

namespace swiftlet::simulation {
namespace {

/// Different details for surfaces that hang side by side; few, since each variant is a texture in memory.
constexpr std::uint64_t kVariants = 3;

// What is drawn with equal chances.
constexpr std::array kFloors{Pattern::kCarpet, Pattern::kWood, Pattern::kTiles};
constexpr std::array kCeilings{Pattern::kBlank, Pattern::kBlank, Pattern::kPlaster};
constexpr std::array kWalls{Pattern::kBlank,   Pattern::kPlaster, Pattern::kPosters, Pattern::kPosters,
                            Pattern::kPlaster, Pattern::kBrick,   Pattern::kBlank,   Pattern::kPosters};
constexpr std::array kFurniture{Pattern::kWood, Pattern::kBlank, Pattern::kWood, Pattern::kCarpet, Pattern::kPosters};

template <std::size_t kCount>
Pattern oneOf(const std::array<Pattern, kCount>& patterns, common::RandomStream& random) {
  return patterns[std::min(kCount - 1, static_cast<std::size_t>(random.uniform() * kCount))];
}

Eigen::Vector3f sizeOf(const Shape& shape) {
  Eigen::AlignedBox3f bounds;
  for (const Eigen::Vector3f& vertex : shape.vertices_world_m) bounds.extend(vertex);
  return bounds.isEmpty() ? Eigen::Vector3f(Eigen::Vector3f::Zero()) : Eigen::Vector3f(bounds.sizes());
}

}  // namespace

Covering coveringOf(const Shape& shape) {
  common::RandomStream random(0, "covering of " + nameOf(shape));
  const std::uint64_t variant = random.bits() % kVariants;
  if (shape.pattern) return {*shape.pattern, *shape.pattern, *shape.pattern, variant};
  // A piece of furniture is neither as high as a person nor as wide as a room.
  constexpr float kFurnitureHeight_m = 1.6F, kFurnitureWidth_m = 2.5F;
  const Eigen::Vector3f size_m = sizeOf(shape);
  if (size_m.z() < kFurnitureHeight_m && size_m.head<2>().maxCoeff() < kFurnitureWidth_m) {
    const Pattern all = oneOf(kFurniture, random);
    return {all, all, all, variant};
  }
  const Pattern up = oneOf(kFloors, random), side = oneOf(kWalls, random), down = oneOf(kCeilings, random);
  return {up, side, down, variant};
}

}  // namespace swiftlet::simulation

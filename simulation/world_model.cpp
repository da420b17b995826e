#include "simulation/world_model.hpp"

#include <algorithm>

namespace swiftlet::simulation {

std::string nameOf(const Shape& shape) { return shape.part.empty() ? shape.model : shape.model + "/" + shape.part; }

std::vector<std::string> WorldModel::modelNames() const {
  std::vector<std::string> names;
  for (const Shape& shape : shapes)
    if (std::find(names.begin(), names.end(), shape.model) == names.end()) names.push_back(shape.model);
  return names;
}

bool WorldModel::hasModel(const std::string& model) const {
  return std::any_of(shapes.begin(), shapes.end(), [&](const Shape& shape) { return shape.model == model; });
}

void WorldModel::moveModel(const std::string& model, const Eigen::Vector2d& shift_world_m) {
  const Eigen::Vector3f shift(static_cast<float>(shift_world_m.x()), static_cast<float>(shift_world_m.y()), 0.0F);
  for (Shape& shape : shapes) {
    if (shape.model != model) continue;
    for (Eigen::Vector3f& vertex : shape.vertices_world_m) vertex += shift;
    shape.T_world_shape.position_m.head<2>() += shift_world_m;
  }
}

void WorldModel::tintModel(const std::string& model, const Color& share) {
  const auto tint = [&share](Color& color) { color = color.cwiseProduct(share).cwiseMax(0.0F).cwiseMin(1.0F); };
  for (Shape& shape : shapes) {
    if (shape.model != model) continue;
    tint(shape.color);
    for (SurfaceMaterial& material : shape.materials) tint(material.color);
  }
}

Eigen::AlignedBox3f WorldModel::boundsOf_world_m(const std::string& model) const {
  Eigen::AlignedBox3f bounds;
  for (const Shape& shape : shapes)
    if (shape.model == model)
      for (const Eigen::Vector3f& vertex : shape.vertices_world_m) bounds.extend(vertex);
  return bounds;
}

Eigen::AlignedBox3f WorldModel::bounds_world_m() const {
  Eigen::AlignedBox3f bounds;
  for (const Shape& shape : shapes)
    for (const Eigen::Vector3f& vertex : shape.vertices_world_m) bounds.extend(vertex);
  return bounds;
}

}  // namespace swiftlet::simulation

#include "apps/world_file.hpp"

#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <system_error>

#include <fmt/format.h>
#include <Eigen/Geometry>

#include "common/markup.hpp"
#include "interfaces/files/atomic_file.hpp"
#include "interfaces/files/required.hpp"

namespace swiftlet::apps {
namespace {

namespace fs = std::filesystem;

/// The two triangles of a rectangle.
constexpr std::array<std::array<std::size_t, 3>, 2> kHalves{{{0, 1, 2}, {0, 2, 3}}};
constexpr simulation::Color::Scalar kGrey = 0.75F;

template <typename Number>
void appendBytes(std::string& bytes, Number number) {
  static_assert(std::endian::native == std::endian::little);
  std::array<char, sizeof number> raw;
  std::memcpy(raw.data(), &number, sizeof number);
  bytes.append(raw.data(), raw.size());
}

void appendVector(std::string& bytes, const Eigen::Vector3f& vector) {
  for (int axis = 0; axis < 3; ++axis) appendBytes(bytes, vector[axis]);
}

/// Binary STL, of which each triangle is 50 bytes.
std::size_t writeSurface(const MadeWorld& world, const fs::path& file) {
  constexpr std::size_t kHeaderBytes = 80, kPiece = 1 << 20;
  std::size_t written = 0;
  interfaces::required(interfaces::writeAtomically(file, [&](const interfaces::WriteBytes& write) {
    std::string bytes = "Surface of free space, in metres";
    bytes.resize(kHeaderBytes, ' ');
    appendBytes(bytes, static_cast<std::uint32_t>(kHalves.size() * world.surface_map_m.size()));
    for (const mapping3d::Quad& quad : world.surface_map_m) {
      const Eigen::Vector3f normal = (quad[1] - quad[0]).cross(quad[2] - quad[0]).normalized();
      for (const auto& half : kHalves) {
        appendVector(bytes, normal);
        for (const std::size_t corner : half) appendVector(bytes, quad[corner]);
        appendBytes(bytes, std::uint16_t{0});
      }
      if (bytes.size() < kPiece) continue;
      written += bytes.size();
      write(bytes);
      bytes.clear();
    }
    written += bytes.size();
    write(bytes);
  }));
  return written;
}

std::string sdfOf(const MadeWorld& world, const std::string& mesh) {
  const common::Pose2& pose = world.T_world_map;
  const simulation::StartConfig& start = world.start;
  const std::string geometry = fmt::format("<geometry><mesh><uri>{}</uri></mesh></geometry>", common::escaped(mesh));
  return fmt::format(R"(<?xml version="1.0"?>
<!-- Made by `swiftlet world` from a map. The mesh is the surface of the map's free space, seen from inside. -->
<sdf version="1.9">
  <world name="from_map">
    <frame name="start"><pose>{} {} {} 0 0 {}</pose></frame>
    <model name="building">
      <static>true</static>
      <pose>{} {} 0 0 0 {}</pose>
      <link name="surface">
        <collision name="surface">{}</collision>
        <visual name="surface">
          {}
          <material><diffuse>{} {} {} 1</diffuse></material>
        </visual>
      </link>
    </model>
  </world>
</sdf>
)",
                     start.x_m, start.y_m, start.z_m, start.yaw_deg * common::kRadPerDeg, pose.x_m, pose.y_m,
                     pose.yaw_rad, geometry, geometry, kGrey, kGrey, kGrey);
}

}  // namespace

fs::path meshOf(const fs::path& world_file) { return fs::path(world_file).replace_extension(".stl"); }

simulation::WorldModel modelOf(const MadeWorld& world, const fs::path& world_file) {
  simulation::WorldModel model;
  model.file = world_file.string();
  model.start_source = {model.file};
  simulation::Shape& shape = model.shapes.emplace_back();
  shape.model = "building";
  shape.part = "surface";
  shape.source = {model.file};
  shape.color.setConstant(kGrey);
  shape.materials.emplace_back();  // As of every mesh.
  const common::Pose3 T_world_map = common::lifted(world.T_world_map, 0.0);
  for (const mapping3d::Quad& quad : world.surface_map_m) {
    const auto first = static_cast<std::uint32_t>(shape.vertices_world_m.size());
    for (const Eigen::Vector3f& corner : quad)
      shape.vertices_world_m.push_back((T_world_map * corner.cast<double>()).cast<float>());
    for (const auto& half : kHalves) {
      std::array<std::uint32_t, 3> triangle;
      for (std::size_t i = 0; i < half.size(); ++i) triangle[i] = first + static_cast<std::uint32_t>(half[i]);
      shape.triangles.push_back(triangle);
    }
  }
  return model;
}

std::size_t writeWorld(const MadeWorld& world, const fs::path& world_file) {
  const fs::path mesh = meshOf(world_file);
  const std::size_t mesh_bytes = writeSurface(world, mesh);
  const std::string sdf = sdfOf(world, mesh.filename().string());
  if (const interfaces::Written written = interfaces::writeAtomically(world_file, sdf); !written) {
    std::error_code ignored;
    fs::remove(mesh, ignored);
    throw common::InputError({}, "", written.error().message);
  }
  return mesh_bytes + sdf.size();
}

}  // namespace swiftlet::apps

#include "simulation/solid_geometry.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>
#include <sdf/Box.hh>
#include <sdf/Capsule.hh>
#include <sdf/Cylinder.hh>
#include <sdf/Ellipsoid.hh>
#include <sdf/Heightmap.hh>
#include <sdf/Plane.hh>
#include <sdf/Sphere.hh>

#include "common/error.hpp"
#include "common/image_decoder.hpp"
#include "common/misleading.hpp"
#include "common/polygon.hpp"
#include "common/read_bytes.hpp"
#include "simulation/sdf_math.hpp"

namespace swiftlet::simulation {
namespace {

using common::Message;
using Result = tl::expected<Triangles, Message>;

/// The triangles, if every size is one that a thing can have.
template <typename Make>
Result ofSize(std::initializer_list<double> sizes_m, const Make& make) {
  for (const double size_m : sizes_m)
    if (!(size_m > 0.0 && size_m <= common::kGreatestCoordinate_m))
      return tl::unexpected(Message("geometry.size", "its size of {:g} m is not above 0 and at most {:g} m", size_m,
                                    common::kGreatestCoordinate_m));
  return make();
}

Result ofSize(const ignition::math::Vector3d& size_m, Triangles (*make)(const Eigen::Vector3d&)) {
  return ofSize({size_m.X(), size_m.Y(), size_m.Z()}, [&] { return make(toEigen(size_m)); });
}

Triangles ellipsoidTriangles(const Eigen::Vector3d& radii_m) { return capsuleTriangles(1.0, 0.0, radii_m); }

Triangles planeOf(const sdf::Plane& plane, double least_plane_m) {
  const Eigen::Vector2d size_m(plane.Size().X(), plane.Size().Y());
  return planeTriangles(toEigen(plane.Normal()),
                        size_m.cwiseMax(least_plane_m).cwiseMin(common::kGreatestCoordinate_m));
}

/// Gazebo takes the height of the first polyline for all.
Result prismOf(sdf::Element& geometry) {
  constexpr std::size_t kMostPoints = 1000;  // The triangles of a zigzag are as many as the square of its points.
  std::size_t points = 0;
  std::vector<std::vector<Eigen::Vector2d>> outlines_m;
  const double height_m = geometry.GetElement("polyline")->Get<double>("height");
  double extent_m = 0.0;
  for (auto line = geometry.GetElement("polyline"); line; line = line->GetNextElement("polyline")) {
    std::vector<Eigen::Vector2d>& outline_m = outlines_m.emplace_back();
    for (auto point = line->GetElement("point"); point; point = point->GetNextElement("point")) {
      if (++points > kMostPoints) continue;
      const auto at = point->Get<ignition::math::Vector2d>();
      outline_m.emplace_back(at.X(), at.Y());
      if (!outline_m.back().allFinite())
        return tl::unexpected(Message("geometry.not-finite", "a point of it is not finite"));
      extent_m = std::max(extent_m, outline_m.back().cwiseAbs().maxCoeff());
    }
    if (outline_m.size() < 3)
      return tl::unexpected(Message("geometry.too-few-points", "it has an outline of less than 3 points"));
  }
  if (points > kMostPoints)
    return tl::unexpected(Message("geometry.too-many-points",
                                  "the outlines of its <polyline> have {} points, {} at most are read, leave out "
                                  "points where the outline is straight",
                                  points, kMostPoints));
  return ofSize({height_m, extent_m}, [&] { return prismTriangles(outlines_m, height_m); });
}

/// Shares of the greatest height, row by row.
struct Relief {
  std::size_t columns = 0;
  std::vector<double> shares;
};

template <typename Value>
Relief thinned(int width_px, int height_px, double greatest, const Value& value) {
  static constexpr int kMostSide = 1025;  // Finer than the vehicle needs, and a million vertices.
  const auto kept = [](int side_px) { return std::min(side_px, kMostSide); };
  Relief relief{static_cast<std::size_t>(kept(width_px)), {}};
  const auto pixelOf = [](int index, int count, int side_px) {
    return static_cast<int>(std::int64_t{index} * (side_px - 1) / (count - 1));
  };
  for (int row = 0; row < kept(height_px); ++row)
    for (int column = 0; column < kept(width_px); ++column)
      relief.shares.push_back(
          value(pixelOf(row, kept(height_px), height_px), pixelOf(column, kept(width_px), width_px)) / greatest);
  return relief;
}

tl::expected<Relief, Message> readRelief(const std::string& bytes) {
  const auto tooSmall = [](const auto& picture) { return picture.width_px < 2 || picture.height_px < 2; };
  const tl::unexpected<Message> small(Message("geometry.picture-too-small", "it has less than 2 x 2 pixels"));
  if (const auto deep = common::decodeDepth(bytes)) {
    if (tooSmall(*deep)) return small;
    return thinned(deep->width_px, deep->height_px, 65535.0, [&deep](int row, int column) {
      return static_cast<double>(deep->codes[static_cast<std::size_t>(row) * static_cast<std::size_t>(deep->width_px) +
                                             static_cast<std::size_t>(column)]);
    });
  }
  auto grey = common::decodeColor(bytes);
  if (!grey) return tl::unexpected(grey.error().reason += "; heights are read from PNG and JPEG");
  if (tooSmall(*grey)) return small;
  return thinned(grey->width_px, grey->height_px, 255.0, [&grey](int row, int column) {
    return static_cast<double>(grey->rgb[3 * (static_cast<std::size_t>(row) * static_cast<std::size_t>(grey->width_px) +
                                              static_cast<std::size_t>(column))]);
  });
}

Result terrainOf(const sdf::Heightmap& heightmap, const UriResolver& resolver) {
  const std::string used_in = heightmap.Element()->FilePath();
  const auto file = resolver.find(heightmap.Uri(), used_in);
  if (!file)
    return tl::unexpected(Message("geometry.no-picture", "`{}` was not found, {}", heightmap.Uri(),
                                  resolver.hintFor(heightmap.Uri(), used_in)));
  if (const auto problem = common::problemOfFile(*file)) return tl::unexpected(messageOf(*problem));
  const auto relief = readRelief(common::readBytes(*file));
  if (!relief) return tl::unexpected(relief.error().behind(fmt::format("`{}`: ", file->string())));
  const Eigen::Vector3d size_m = toEigen(heightmap.Size());
  std::vector<double> heights_m;
  for (const double share : relief->shares) heights_m.push_back(share * size_m.z());
  return ofSize({size_m.x(), size_m.y(), size_m.z()}, [&] {
    Triangles terrain = terrainTriangles(heights_m, relief->columns, size_m.head<2>());
    for (Eigen::Vector3f& vertex : terrain.vertices_m) vertex += toEigen(heightmap.Position()).cast<float>();
    return terrain;
  });
}

Message unknownKind(const std::string& name) {
  static const std::vector<std::string> kKnown{"box",  "cylinder", "sphere",   "capsule",   "ellipsoid",
                                               "cone", "plane",    "polyline", "heightmap", "mesh"};
  std::string hint = common::misleadingHint(name);
  if (hint.empty()) hint = common::didYouMean(name, kKnown);
  return Message("geometry.unknown-kind", "<{}> is a geometry that the simulator does not know{}{}", name,
                 hint.empty() ? "" : ", ", hint);
}

/// What libsdformat 12 does not know by itself.
Result otherTriangles(const sdf::ElementPtr& geometry) {
  if (geometry && geometry->HasElement("polyline")) return prismOf(*geometry);
  if (geometry && geometry->HasElement("cone")) {
    const auto cone = geometry->GetElement("cone");
    const double radius_m = cone->Get<double>("radius", 0.5).first, length_m = cone->Get<double>("length", 1.0).first;
    return ofSize({radius_m, length_m}, [&] { return coneTriangles(radius_m, length_m); });
  }
  const auto kind = geometry ? geometry->GetFirstElement() : nullptr;
  return tl::unexpected(kind ? unknownKind(kind->GetName()) : Message("geometry.empty", "its geometry is empty"));
}

}  // namespace

Result solidTriangles(const sdf::Geometry& geometry, double least_plane_m, const UriResolver& resolver) {
  if (const auto* box = geometry.BoxShape()) return ofSize(box->Size(), boxTriangles);
  if (const auto* ellipsoid = geometry.EllipsoidShape()) return ofSize(ellipsoid->Radii(), ellipsoidTriangles);
  if (const auto* cylinder = geometry.CylinderShape())
    return ofSize({cylinder->Radius(), cylinder->Length()},
                  [&] { return cylinderTriangles(cylinder->Radius(), cylinder->Length()); });
  if (const auto* sphere = geometry.SphereShape())
    return ofSize({sphere->Radius()}, [&] { return capsuleTriangles(sphere->Radius(), 0.0); });
  if (const auto* capsule = geometry.CapsuleShape())
    return ofSize({capsule->Radius(), capsule->Length()},
                  [&] { return capsuleTriangles(capsule->Radius(), capsule->Length()); });
  if (const auto* plane = geometry.PlaneShape()) return planeOf(*plane, least_plane_m);
  if (const auto* heightmap = geometry.HeightmapShape()) return terrainOf(*heightmap, resolver);
  return otherTriangles(geometry.Element());
}

}  // namespace swiftlet::simulation

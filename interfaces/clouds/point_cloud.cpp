#include "interfaces/clouds/point_cloud.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <iterator>

#include <fmt/format.h>

#include "common/check.hpp"
#include "common/error.hpp"
#include "common/lower_case.hpp"
#include "interfaces/clouds/pcd_reader.hpp"
#include "interfaces/clouds/ply_reader.hpp"
#include "interfaces/files/unpacked_stream.hpp"

namespace swiftlet::interfaces {
namespace {

using common::SurfacePoint;

void append(std::string& bytes, std::uint32_t value) {
  for (int shift = 0; shift < 32; shift += 8) bytes.push_back(static_cast<char>(value >> shift & 0xffU));
}

void append(std::string& bytes, const Eigen::Vector3f& vector) {
  for (const float value : {vector.x(), vector.y(), vector.z()}) append(bytes, std::bit_cast<std::uint32_t>(value));
}

/// What a point has beside its place.
struct Columns {
  bool normals = false, colors = false;
};

std::string plyHeader(std::size_t points, const Columns& columns, std::optional<std::size_t> triangles = std::nullopt) {
  return fmt::format(
      "ply\nformat binary_little_endian 1.0\ncomment metres\nelement vertex {}\nproperty float x\nproperty float y\n"
      "property float z\n{}{}{}end_header\n",
      points, columns.normals ? "property float nx\nproperty float ny\nproperty float nz\n" : "",
      columns.colors ? "property uchar red\nproperty uchar green\nproperty uchar blue\n" : "",
      triangles ? fmt::format("element face {}\nproperty list uchar uint vertex_indices\n", *triangles) : "");
}

std::string pcdHeader(std::size_t points, const Columns& columns) {
  const auto line = [&](const char* of_normals, const char* of_color) {
    return std::string(columns.normals ? of_normals : "") + (columns.colors ? of_color : "");
  };
  return fmt::format(
      "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS x y z{}\nSIZE 4 4 4{}\n"
      "TYPE F F F{}\nCOUNT 1 1 1{}\nWIDTH {}\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS {}\nDATA binary\n",
      line(" normal_x normal_y normal_z", " rgb"), line(" 4 4 4", " 4"), line(" F F F", " U"), line(" 1 1 1", " 1"),
      points, points);
}

/// Hands on the bytes of a file, piece by piece.
void writePieces(std::span<const SurfacePoint> points, CloudFormat format, const WriteBytes& write) {
  constexpr std::size_t kPiece = 1 << 20;
  const auto any = [&](const auto& has) { return std::any_of(points.begin(), points.end(), has); };
  const Columns columns{any([](const SurfacePoint& point) { return !point.normal.isZero(); }),
                        any([](const SurfacePoint& point) { return point.rgb != common::kUnknownColor; })};
  std::string bytes =
      format == CloudFormat::kPly ? plyHeader(points.size(), columns) : pcdHeader(points.size(), columns);
  for (const SurfacePoint& point : points) {
    append(bytes, point.position_m);
    if (columns.normals) append(bytes, point.normal);
    const auto& [red, green, blue] = point.rgb;
    if (columns.colors && format == CloudFormat::kPcd)
      append(bytes, static_cast<std::uint32_t>(red << 16 | green << 8 | blue));
    else if (columns.colors)
      for (const std::uint8_t color : point.rgb) bytes.push_back(static_cast<char>(color));
    if (bytes.size() < kPiece) continue;
    write(bytes);
    bytes.clear();
  }
  write(bytes);
}

std::string plyOf(const common::SurfaceMesh& mesh) {
  std::string bytes = plyHeader(mesh.vertices.size(), {false, true}, mesh.triangles.size());
  for (const auto& [position_m, rgb] : mesh.vertices) {
    append(bytes, position_m);
    for (const std::uint8_t color : rgb) bytes.push_back(static_cast<char>(color));
  }
  for (const auto& triangle : mesh.triangles) {
    bytes.push_back(3);
    for (const std::uint32_t vertex : triangle) append(bytes, vertex);
  }
  return bytes;
}

/// Vertices count from 1.
std::string objOf(const common::SurfaceMesh& mesh) {
  std::string text = "# metres\n";
  const auto out = std::back_inserter(text);
  for (const auto& [position_m, rgb] : mesh.vertices)
    fmt::format_to(out, "v {:.5f} {:.5f} {:.5f} {:.4f} {:.4f} {:.4f}\n", position_m.x(), position_m.y(), position_m.z(),
                   rgb[0] / 255.0, rgb[1] / 255.0, rgb[2] / 255.0);
  for (const auto& [a, b, c] : mesh.triangles) fmt::format_to(out, "f {} {} {}\n", a + 1, b + 1, c + 1);
  return text;
}

}  // namespace

std::optional<CloudFormat> cloudFormatOf(const std::filesystem::path& file) {
  const std::string ending = common::endingOf(file);
  if (ending == ".ply") return CloudFormat::kPly;
  if (ending == ".pcd") return CloudFormat::kPcd;
  return std::nullopt;
}

std::string toCloud(std::span<const SurfacePoint> points, CloudFormat format) {
  std::string all;
  writePieces(points, format, [&](std::string_view bytes) { all += bytes; });
  return all;
}

Written writeCloud(const std::filesystem::path& file, std::span<const SurfacePoint> points) {
  const auto format = cloudFormatOf(file);
  SWIFTLET_CHECK(format.has_value(), file.string());
  return writeAtomically(file, [&](const WriteBytes& write) { writePieces(points, *format, write); });
}

bool isMeshName(const std::filesystem::path& file) {
  const std::string ending = common::endingOf(file);
  return ending == ".ply" || ending == ".obj";
}

Written writeMesh(const std::filesystem::path& file, const common::SurfaceMesh& mesh) {
  SWIFTLET_CHECK(isMeshName(file), file.string());
  return writeAtomically(file, common::endingOf(file) == ".obj" ? objOf(mesh) : plyOf(mesh));
}

StoredCloud parseCloud(std::string_view bytes, const std::string& name, CloudFormat format,
                       const CloudPlacement& placement) {
  // Text of a system whose lines end so alone.
  if (bytes.find('\n') == std::string_view::npos && bytes.find("ascii") < bytes.find('\r', bytes.find("ascii"))) {
    std::string lines(bytes);
    std::replace(lines.begin(), lines.end(), '\r', '\n');
    return format == CloudFormat::kPly ? parsePly(lines, name, placement) : parsePcd(lines, name, placement);
  }
  return format == CloudFormat::kPly ? parsePly(bytes, name, placement) : parsePcd(bytes, name, placement);
}

StoredCloud readCloud(const std::filesystem::path& file, const CloudPlacement& placement) {
  const auto format = cloudFormatOf(unpackedName(file));
  if (!format)
    throw common::InputError({file.string()}, "",
                             common::Message("cloud.other-ending", "is not named .ply or .pcd, plain or packed"));
  return parseCloud(readUnpacked(file), file.string(), *format, placement);
}

}  // namespace swiftlet::interfaces

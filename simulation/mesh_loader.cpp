#include "simulation/mesh_loader.hpp"

#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <assimp/Importer.hpp>

#include <algorithm>
#include <limits>

#include <fmt/format.h>

namespace swiftlet::simulation {
namespace {

struct Collected {
  Mesh mesh;
  Color color_sum = Color::Zero();
};

Color diffuseOf(const aiScene& scene, const aiMesh& part) {
  aiColor4D diffuse;
  if (part.mMaterialIndex >= scene.mNumMaterials) return Color::Constant(0.7F);
  if (scene.mMaterials[part.mMaterialIndex]->Get(AI_MATKEY_COLOR_DIFFUSE, diffuse) != aiReturn_SUCCESS)
    return Color::Constant(0.7F);
  return Color(diffuse.r, diffuse.g, diffuse.b).cwiseMax(0.0F).cwiseMin(1.0F);
}

/// The index of the colour among `colors`, to which it is added if it is new.
std::uint16_t numberOf(const Color& color, std::vector<Color>& colors) {
  auto found = std::find(colors.begin(), colors.end(), color);
  constexpr std::size_t kMost = std::numeric_limits<std::uint16_t>::max();
  if (found == colors.end() && colors.size() < kMost) found = colors.insert(found, color);
  return static_cast<std::uint16_t>(std::min<std::ptrdiff_t>(found - colors.begin(), kMost - 1));
}

void addPart(const aiScene& scene, const aiMesh& part, const aiMatrix4x4& T_root_node, Collected& out) {
  Triangles& triangles = out.mesh.triangles;
  const auto first = static_cast<std::uint32_t>(triangles.vertices_m.size());
  for (unsigned i = 0; i < part.mNumVertices; ++i) {
    const aiVector3D point = T_root_node * part.mVertices[i];
    triangles.vertices_m.emplace_back(point.x, point.y, point.z);
  }
  const Color color = diffuseOf(scene, part);
  const std::uint16_t number = numberOf(color, out.mesh.colors);
  for (unsigned i = 0; i < part.mNumFaces; ++i) {
    const aiFace& face = part.mFaces[i];
    if (face.mNumIndices != 3) continue;  // Points and lines have no surface.
    triangles.indices.push_back({first + face.mIndices[0], first + face.mIndices[1], first + face.mIndices[2]});
    out.mesh.color_of_triangle.push_back(number);
    out.color_sum += color;
  }
}

void addNode(const aiScene& scene, const aiNode& node, const aiMatrix4x4& T_root_parent, const std::string& submesh,
             bool wanted, Collected& out) {
  const aiMatrix4x4 T_root_node = T_root_parent * node.mTransformation;
  const bool here = wanted || submesh == node.mName.C_Str();
  for (unsigned i = 0; i < node.mNumMeshes; ++i) {
    const aiMesh& part = *scene.mMeshes[node.mMeshes[i]];
    if (here || submesh == part.mName.C_Str()) addPart(scene, part, T_root_node, out);
  }
  for (unsigned i = 0; i < node.mNumChildren; ++i) addNode(scene, *node.mChildren[i], T_root_node, submesh, here, out);
}

}  // namespace

tl::expected<Mesh, std::string> loadMesh(const std::string& file, const std::string& submesh) {
  Assimp::Importer importer;
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, true);
  const aiScene* scene = importer.ReadFile(file, aiProcess_Triangulate | aiProcess_JoinIdenticalVertices);
  if (scene == nullptr) return tl::unexpected(std::string(importer.GetErrorString()));
  Collected out;
  if (scene->mRootNode != nullptr) addNode(*scene, *scene->mRootNode, aiMatrix4x4(), submesh, submesh.empty(), out);
  if (out.mesh.triangles.indices.empty())
    return tl::unexpected(submesh.empty() ? std::string("it has no triangles")
                                          : fmt::format("it has no triangles in a submesh `{}`", submesh));
  for (const Eigen::Vector3f& vertex : out.mesh.triangles.vertices_m)
    if (!vertex.allFinite()) return tl::unexpected(std::string("it has a vertex that is not a number"));
  out.mesh.color = out.color_sum / static_cast<float>(out.mesh.triangles.indices.size());
  return std::move(out.mesh);
}

}  // namespace swiftlet::simulation

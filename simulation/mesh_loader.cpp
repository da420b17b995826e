#include "simulation/mesh_loader.hpp"

#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <assimp/Importer.hpp>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <limits>
#include <system_error>

#include "common/error.hpp"
#include "common/lower_case.hpp"
#include "common/read_bytes.hpp"
#include "simulation/mesh_kinds.hpp"

namespace swiftlet::simulation {
namespace {

using common::Message;

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

SurfaceMaterial materialOf(const aiScene& scene, const aiMesh& part) {
  SurfaceMaterial material{diffuseOf(scene, part), {}};
  if (part.mMaterialIndex >= scene.mNumMaterials || !part.HasTextureCoords(0)) return material;
  aiString image;
  for (const aiTextureType type : {aiTextureType_BASE_COLOR, aiTextureType_DIFFUSE})
    if (material.image.empty() &&
        scene.mMaterials[part.mMaterialIndex]->GetTexture(type, 0, &image) == aiReturn_SUCCESS)
      material.image = image.C_Str();
  return material;
}

/// Assimp counts v upwards.
Eigen::Vector2f imagePlaceOf(const aiMesh& part, unsigned vertex) {
  if (!part.HasTextureCoords(0)) return Eigen::Vector2f::Zero();
  const aiVector3D& place = part.mTextureCoords[0][vertex];
  constexpr float kMostRepetitions = 1e4F;  // A place must stay exact to a texel.
  const Eigen::Vector2f at(place.x, 1.0F - place.y);
  if (!(at.cwiseAbs().maxCoeff() <= kMostRepetitions)) return Eigen::Vector2f::Zero();
  return at.allFinite() ? at : Eigen::Vector2f(Eigen::Vector2f::Zero());
}

/// The index of the material among `materials`, to which it is added if it is new.
std::uint16_t numberOf(const SurfaceMaterial& material, std::vector<SurfaceMaterial>& materials) {
  auto found = std::find(materials.begin(), materials.end(), material);
  constexpr std::size_t kMost = std::numeric_limits<std::uint16_t>::max();
  if (found == materials.end() && materials.size() < kMost) found = materials.insert(found, material);
  return static_cast<std::uint16_t>(std::min<std::ptrdiff_t>(found - materials.begin(), kMost - 1));
}

void addPart(const aiScene& scene, const aiMesh& part, const aiMatrix4x4& T_root_node, Collected& out) {
  Triangles& triangles = out.mesh.triangles;
  const auto first = static_cast<std::uint32_t>(triangles.vertices_m.size());
  for (unsigned i = 0; i < part.mNumVertices; ++i) {
    const aiVector3D point = T_root_node * part.mVertices[i];
    triangles.vertices_m.emplace_back(point.x, point.y, point.z);
    out.mesh.image_places.push_back(imagePlaceOf(part, i));
  }
  const SurfaceMaterial material = materialOf(scene, part);
  const std::uint16_t number = numberOf(material, out.mesh.materials);
  for (unsigned i = 0; i < part.mNumFaces; ++i) {
    const aiFace& face = part.mFaces[i];
    if (face.mNumIndices != 3) continue;  // Points and lines have no surface.
    triangles.indices.push_back({first + face.mIndices[0], first + face.mIndices[1], first + face.mIndices[2]});
    out.mesh.material_of_triangle.push_back(number);
    out.color_sum += material.color;
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

/// The files of materials that an OBJ file names and that are not there. Assimp then takes the one that is named as the
/// OBJ file, if there is one.
std::vector<std::string> missingMaterials(std::filesystem::path file) {
  std::vector<std::string> missing;
  std::ifstream stream(file);
  std::error_code ignored;
  for (std::string line; std::getline(stream, line);) {
    constexpr std::string_view kKey = "mtllib ", kBlanks = " \t\r";
    if (!line.starts_with(kKey)) continue;
    line.erase(0, std::min(line.find_first_not_of(kBlanks, kKey.size()), line.size()));
    line.erase(line.find_last_not_of(kBlanks) + 1);
    if (!line.empty() && !std::filesystem::exists(file.parent_path() / line, ignored)) missing.push_back(line);
  }
  if (!missing.empty() && std::filesystem::exists(file.replace_extension(".mtl"), ignored)) missing.clear();
  return missing;
}

}  // namespace

tl::expected<Mesh, Message> loadMesh(const std::string& file, const std::string& submesh) {
  if (auto problem = common::problemOfFile(file)) {
    problem->location = {};  // The caller names the file.
    return tl::unexpected(messageOf(*problem));
  }
  Assimp::Importer importer;
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, true);
  const aiScene* scene = importer.ReadFile(file, aiProcess_Triangulate | aiProcess_JoinIdenticalVertices);
  if (scene == nullptr)
    return tl::unexpected(explainUnreadMesh(file, Message("mesh.not-read", "{}", importer.GetErrorString())));
  Collected out;
  if (scene->mRootNode != nullptr) addNode(*scene, *scene->mRootNode, aiMatrix4x4(), submesh, submesh.empty(), out);
  if (out.mesh.triangles.indices.empty())
    return tl::unexpected(submesh.empty()
                              ? explainUnreadMesh(file, Message("mesh.no-triangles", "it has no triangles"))
                              : Message("mesh.no-submesh", "it has no triangles in a submesh `{}`", submesh));
  for (const Eigen::Vector3f& vertex : out.mesh.triangles.vertices_m)
    if (!vertex.allFinite()) return tl::unexpected(Message("mesh.not-finite", "it has a vertex that is not a number"));
  out.mesh.color = out.color_sum / static_cast<float>(out.mesh.triangles.indices.size());
  if (common::endingOf(file) == ".obj") out.mesh.missing_materials = missingMaterials(file);
  return std::move(out.mesh);
}

}  // namespace swiftlet::simulation

// SDF geometry to triangles. Pose algebra is libsdformat's own (relative_to, attached_to, placement frames).
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sdf/Box.hh>
#include <sdf/Capsule.hh>
#include <sdf/Collision.hh>
#include <sdf/Cylinder.hh>
#include <sdf/Element.hh>
#include <sdf/Ellipsoid.hh>
#include <sdf/Frame.hh>
#include <sdf/Geometry.hh>
#include <sdf/Link.hh>
#include <sdf/Material.hh>
#include <sdf/Mesh.hh>
#include <sdf/Model.hh>
#include <sdf/Pbr.hh>
#include <sdf/Plane.hh>
#include <sdf/Sphere.hh>
#include <sdf/Visual.hh>
#include <sdf/World.hh>

#include "common/error.hpp"
#include "common/random.hpp"
#include "simulation/mesh_loader.hpp"
#include "simulation/sdf_reader.hpp"
#include "simulation/triangulate.hpp"
#include "simulation/world_model.hpp"

namespace swiftlet::simulation {
namespace {

using common::InputError;
using common::Problem;

// A collision plane is infinite in SDF.
constexpr double kEndlessPlane_m = 200.0;

Eigen::Vector3d toEigen(const ignition::math::Vector3d& v) { return {v.X(), v.Y(), v.Z()}; }

common::Pose3 toPose(const ignition::math::Pose3d& pose) {
  return {Eigen::Quaterniond(pose.Rot().W(), pose.Rot().X(), pose.Rot().Y(), pose.Rot().Z()).normalized(),
          toEigen(pose.Pos())};
}

common::SourceLocation locationOf(const sdf::ElementPtr& element, const std::string& file) {
  if (!element) return {file};
  return {element->FilePath().empty() ? file : element->FilePath(), element->LineNumber().value_or(0)};
}

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

std::optional<Color> colorOf(const sdf::Visual* visual) {
  if (visual == nullptr || visual->Material() == nullptr) return std::nullopt;
  const sdf::Material& material = *visual->Material();
  if (auto color = scriptColor(material.ScriptName())) return color;
  if (!material.Element() || !material.Element()->HasElement("diffuse")) return std::nullopt;
  const auto diffuse = material.Diffuse();
  return Color(diffuse.R(), diffuse.G(), diffuse.B());
}

/// Patterns of the most common material scripts of Gazebo.
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

/// The element of ours in a material, which other readers of SDF ignore.
constexpr const char* kTextureElement = "swiftlet:texture";

/// What the material says of a geometry.
struct Look {
  std::optional<Color> color;
  bool glass = false;
  std::optional<Pattern> pattern = {};
  std::string image = {};  ///< A file; empty if there is none.
};

/// A soft colour, different for each model, for models without a colour.
Color colorByName(const std::string& name) {
  common::RandomStream random(0, name);
  const auto channel = [&random] { return static_cast<float>(random.uniform(0.45, 0.85)); };
  const float red = channel(), green = channel(), blue = channel();
  return {red, green, blue};
}

class Loader {
 public:
  Loader(const std::string& file, const std::vector<std::string>& model_paths) : resolver_(file, model_paths) {
    world_.file = file;
  }

  WorldModel load() {
    const SdfFile file = readSdf(world_.file, resolver_);
    world_.warnings = file.warnings;
    if (const sdf::World* world = file.root.WorldByIndex(0)) {
      addWorld(*world);
    } else {
      const sdf::Model& model = *file.root.Model();
      addModel(model, common::Pose3{}, model.Name(), "");
      readStart(model, toPose(model.RawPose()));
    }
    if (file.wants_ground_plane)
      addShape("ground_plane", "", {world_.file}, common::Pose3{},
               planeTriangles(Eigen::Vector3d::UnitZ(), Eigen::Vector2d::Constant(kEndlessPlane_m)),
               Color::Constant(0.6F));
    if (!problems_.empty()) throw InputError(problems_);
    if (world_.shapes.empty())
      throw InputError(Problem{
          {world_.file}, "", "it has no geometry at all", "give its models links with <collision> or <visual>"});
    return std::move(world_);
  }

 private:
  void addWorld(const sdf::World& world) {
    for (std::uint64_t i = 0; i < world.ModelCount(); ++i) {
      const sdf::Model& model = *world.ModelByIndex(i);
      addModel(model, common::Pose3{}, model.Name(), "");
    }
    for (std::uint64_t i = 0; i < world.ActorCount(); ++i)
      warn(world.Element(), "actors of the world's file are left out; people come from the trial's file");
    readStart(world, common::Pose3{});
  }

  template <typename Parent>
  void readStart(const Parent& parent, const common::Pose3& T_world_parent) {
    world_.start_source = locationOf(parent.Element(), world_.file);
    const sdf::Frame* frame = parent.FrameByName("start");
    if (frame == nullptr) return;
    world_.start_source = locationOf(frame->Element(), world_.file);
    if (auto pose = resolve(frame->SemanticPose(), frame->Element())) world_.T_world_start = T_world_parent * *pose;
  }

  void addModel(const sdf::Model& model, const common::Pose3& T_world_parent, const std::string& top,
                const std::string& path) {
    const auto T_parent_model = resolve(model.SemanticPose(), model.Element());
    if (!T_parent_model) return;
    const common::Pose3 T_world_model = T_world_parent * *T_parent_model;
    for (std::uint64_t i = 0; i < model.LinkCount(); ++i) addLink(*model.LinkByIndex(i), T_world_model, top, path);
    for (std::uint64_t i = 0; i < model.ModelCount(); ++i) {
      const sdf::Model& nested = *model.ModelByIndex(i);
      addModel(nested, T_world_model, top, path + nested.Name() + "/");
    }
  }

  void addLink(const sdf::Link& link, const common::Pose3& T_world_model, const std::string& top,
               const std::string& path) {
    const auto T_model_link = resolve(link.SemanticPose(), link.Element());
    if (!T_model_link) return;
    const common::Pose3 T_world_link = T_world_model * *T_model_link;
    const std::string part = path + link.Name();
    const sdf::Visual* first_visual = link.VisualCount() > 0 ? link.VisualByIndex(0) : nullptr;
    for (std::uint64_t i = 0; i < link.CollisionCount(); ++i) {
      const sdf::Collision& collision = *link.CollisionByIndex(i);
      const sdf::Visual* visual = i < link.VisualCount() ? link.VisualByIndex(i) : first_visual;
      addGeometry(collision, T_world_link, top, part, lookOf(visual), kEndlessPlane_m);
    }
    if (link.CollisionCount() > 0) return;
    for (std::uint64_t i = 0; i < link.VisualCount(); ++i) {
      const sdf::Visual& visual = *link.VisualByIndex(i);
      addGeometry(visual, T_world_link, top, part, lookOf(&visual), 0.0);
    }
  }

  Look lookOf(const sdf::Visual* visual) {
    constexpr float kHalf = 0.5F;
    if (visual == nullptr) return {};
    const sdf::Material* material = visual->Material();
    const bool see_through = material != nullptr && material->Element() && material->Element()->HasElement("diffuse") &&
                             material->Diffuse().A() <= kHalf;
    return {colorOf(visual), see_through || visual->Transparency() >= kHalf, patternOf(material), imageOf(material)};
  }

  /// The albedo map, if its file is there.
  std::string imageOf(const sdf::Material* material) const {
    if (material == nullptr || material->PbrMaterial() == nullptr) return {};
    for (const auto type : {sdf::PbrWorkflowType::METAL, sdf::PbrWorkflowType::SPECULAR})
      if (const sdf::PbrWorkflow* workflow = material->PbrMaterial()->Workflow(type))
        return resolver_.find(workflow->AlbedoMap(), locationOf(material->Element(), world_.file).file)
            .value_or("")
            .string();
    return {};
  }

  std::optional<Pattern> patternOf(const sdf::Material* material) {
    if (material == nullptr) return std::nullopt;
    if (!material->Element() || !material->Element()->HasElement(kTextureElement))
      return scriptPattern(material->ScriptName());
    const auto word = material->Element()->Get<std::string>(kTextureElement);
    const std::optional<Pattern> pattern = patternFrom(word);
    if (!pattern) {
      const std::string similar = common::didYouMean(word, patternWords());
      problems_.push_back(
          {locationOf(material->Element(), world_.file), kTextureElement, fmt::format("there is no texture `{}`", word),
           similar.empty() ? fmt::format("expected is one of {}", fmt::join(patternWords(), ", ")) : similar});
    }
    return pattern;
  }

  template <typename Item>
  void addGeometry(const Item& item, const common::Pose3& T_world_link, const std::string& top, const std::string& part,
                   const Look& look, double least_plane_m) {
    const auto T_link_item = resolve(item.SemanticPose(), item.Element());
    if (!T_link_item || item.Geom() == nullptr) return;
    const common::Pose3 T_world_item = T_world_link * *T_link_item;
    if (const sdf::Mesh* mesh = item.Geom()->MeshShape()) {
      addMesh(*mesh, T_world_item, top, part, look);
      return;
    }
    const Triangles triangles = solidTriangles(*item.Geom(), least_plane_m);
    if (triangles.indices.empty()) {
      warn(item.Element(), fmt::format("`{}` has a geometry the simulator does not know; it is left out", item.Name()));
      return;
    }
    addShape(top, part, locationOf(item.Element(), world_.file), T_world_item, triangles,
             look.color.value_or(colorByName(top)), look);
  }

  static Triangles solidTriangles(const sdf::Geometry& geometry, double least_plane_m) {
    if (const auto* box = geometry.BoxShape()) return boxTriangles(toEigen(box->Size()));
    if (const auto* cylinder = geometry.CylinderShape())
      return cylinderTriangles(cylinder->Radius(), cylinder->Length());
    if (const auto* sphere = geometry.SphereShape()) return capsuleTriangles(sphere->Radius(), 0.0);
    if (const auto* capsule = geometry.CapsuleShape()) return capsuleTriangles(capsule->Radius(), capsule->Length());
    if (const auto* ellipsoid = geometry.EllipsoidShape())
      return capsuleTriangles(1.0, 0.0, toEigen(ellipsoid->Radii()));
    if (const auto* plane = geometry.PlaneShape())
      return planeTriangles(toEigen(plane->Normal()),
                            Eigen::Vector2d(plane->Size().X(), plane->Size().Y()).cwiseMax(least_plane_m));
    return {};
  }

  void addMesh(const sdf::Mesh& sdf_mesh, const common::Pose3& T_world_item, const std::string& top,
               const std::string& part, const Look& look) {
    const auto location = locationOf(sdf_mesh.Element(), world_.file);
    const auto path = resolver_.find(sdf_mesh.Uri(), sdf_mesh.FilePath());
    if (!path) {
      problems_.push_back({location, "mesh", fmt::format("`{}` was not found", sdf_mesh.Uri()),
                           "give the folder that holds it as a model path or in SDF_PATH"});
      return;
    }
    const auto key = std::make_pair(path->string(), sdf_mesh.Submesh());
    auto cached = meshes_.find(key);
    if (cached == meshes_.end()) cached = meshes_.emplace(key, loadMesh(key.first, key.second)).first;
    if (!cached->second) {
      problems_.push_back({location, "mesh", fmt::format("`{}`: {}", path->string(), cached->second.error()), ""});
      return;
    }
    Triangles triangles = cached->second->triangles;
    if (sdf_mesh.CenterSubmesh()) centre(triangles);
    const Eigen::Vector3f scale = toEigen(sdf_mesh.Scale()).cast<float>();
    for (Eigen::Vector3f& vertex : triangles.vertices_m) vertex = vertex.cwiseProduct(scale);
    addShape(top, part, location, T_world_item, triangles, look.color.value_or(cached->second->color), look);
    addMaterials(*cached->second, *path, look, world_.shapes.back());
  }

  /// A colour or an image of the world's file replaces those of the mesh. Images that are not there are left out:
  /// without them the surface has its colour.
  void addMaterials(const Mesh& mesh, const std::filesystem::path& mesh_file, const Look& look, Shape& shape) const {
    shape.materials = mesh.materials;
    shape.material_of_triangle = mesh.material_of_triangle;
    shape.image_places = mesh.image_places;
    for (SurfaceMaterial& material : shape.materials) {
      if (!look.image.empty() || look.color || material.image.empty())
        material.image = look.image;
      else
        material.image = resolver_.find(material.image, mesh_file).value_or("").string();
      if (look.color) material.color = *look.color;
    }
  }

  static void centre(Triangles& triangles) {
    Eigen::AlignedBox3f bounds;
    for (const Eigen::Vector3f& vertex : triangles.vertices_m) bounds.extend(vertex);
    for (Eigen::Vector3f& vertex : triangles.vertices_m) vertex -= bounds.center();
  }

  void addShape(const std::string& top, const std::string& part, const common::SourceLocation& source,
                const common::Pose3& T_world_item, const Triangles& triangles, const Color& color,
                const Look& look = {}) {
    Shape shape{top, part, source, color, {}, triangles.indices, look.glass, look.pattern};
    shape.T_world_shape = T_world_item;
    shape.image = look.image;
    shape.vertices_world_m.reserve(triangles.vertices_m.size());
    for (const Eigen::Vector3f& vertex : triangles.vertices_m)
      shape.vertices_world_m.push_back((T_world_item * vertex.cast<double>()).cast<float>());
    const auto finite = [](const Eigen::Vector3f& vertex) { return vertex.allFinite(); };
    if (!std::all_of(shape.vertices_world_m.begin(), shape.vertices_world_m.end(), finite))
      problems_.push_back({source, nameOf(shape), "its size or pose is not finite", ""});
    world_.shapes.push_back(std::move(shape));
  }

  std::optional<common::Pose3> resolve(const sdf::SemanticPose& semantic, const sdf::ElementPtr& element) {
    ignition::math::Pose3d pose;
    const sdf::Errors errors = semantic.Resolve(pose);
    if (errors.empty() && pose.IsFinite()) return toPose(pose);
    problems_.push_back({locationOf(element, world_.file), "pose",
                         errors.empty() ? std::string("it is not finite") : errors.front().Message(), ""});
    return std::nullopt;
  }

  void warn(const sdf::ElementPtr& element, const std::string& message) {
    world_.warnings.push_back(toString(Problem{locationOf(element, world_.file), "", message, ""}));
  }

  UriResolver resolver_;
  WorldModel world_;
  std::vector<Problem> problems_;
  std::map<std::pair<std::string, std::string>, tl::expected<Mesh, std::string>> meshes_;
};

}  // namespace

WorldModel loadWorld(const std::string& sdf_file, const std::vector<std::string>& model_paths) {
  return Loader(sdf_file, model_paths).load();
}

}  // namespace swiftlet::simulation

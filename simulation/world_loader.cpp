// SDF geometry to triangles. Pose algebra is libsdformat's own (relative_to, attached_to, placement frames).
#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sdf/Collision.hh>
#include <sdf/Element.hh>
#include <sdf/Frame.hh>
#include <sdf/Geometry.hh>
#include <sdf/Link.hh>
#include <sdf/Material.hh>
#include <sdf/Mesh.hh>
#include <sdf/Model.hh>
#include <sdf/Pbr.hh>
#include <sdf/Visual.hh>
#include <sdf/World.hh>

#include "common/error.hpp"
#include "common/polygon.hpp"
#include "common/read_bytes.hpp"
#include "simulation/appearance/patterns.hpp"
#include "simulation/material_look.hpp"
#include "simulation/mesh_loader.hpp"
#include "simulation/sdf_math.hpp"
#include "simulation/sdf_reader.hpp"
#include "simulation/solid_geometry.hpp"
#include "simulation/world_model.hpp"
#include "simulation/world_state.hpp"

namespace swiftlet::simulation {
namespace {

using common::InputError;
using common::Message;
using common::Problem;

/// The element of ours in a material, which other readers of SDF ignore.
constexpr const char* kTextureElement = "swiftlet:texture";
/// The word in it of what reflects; it is no pattern.
constexpr const char* kMirrorWord = "mirror";

/// Where a part of a model is.
struct Scope {
  std::string top;        ///< Name of the top-level model.
  std::string path;       ///< Nested models inside it, "kitchen/shelf/".
  std::string name = {};  ///< Of the model as <state> gives it, "house::kitchen::shelf".
  Eigen::Vector3f scale = Eigen::Vector3f::Ones();
};

class Loader {
 public:
  Loader(const std::string& file, const std::vector<std::string>& model_paths, IncompleteWorld incomplete)
      : resolver_(file, model_paths), incomplete_(incomplete) {
    world_.file = file;
  }

  WorldModel load() {
    const SdfFile file = readSdf(world_.file, resolver_);
    world_.warnings = file.warnings;
    for (const Problem& problem : file.missing) addMissing(problem);
    if (const sdf::World* world = file.root.WorldByIndex(0)) {
      addWorld(*world);
      for (std::uint64_t i = 1; i < file.root.WorldCount(); ++i)
        warn(file.root.WorldByIndex(i)->Element(),
             Message("world.further", "the file's first world is `{}`; this one is left out", world->Name()));
    } else {
      const sdf::Model& model = *file.root.Model();
      addModel(model, common::Pose3{}, {model.Name(), "", model.Name()});
      readStart(model, toPose(model.RawPose()));
    }
    if (file.wants_ground_plane)
      addShape({"ground_plane", ""}, "", {world_.file}, common::Pose3{},
               planeTriangles(Eigen::Vector3d::UnitZ(), Eigen::Vector2d::Constant(kEndlessPlane_m)),
               Color::Constant(0.6F));
    if (!problems_.empty()) throw InputError(problems_);
    if (world_.shapes.empty())
      throw InputError({world_.file}, "", Message("world.empty", "it has no geometry at all"),
                       "give its models links with <collision> or <visual>");
    return std::move(world_);
  }

 private:
  void addWorld(const sdf::World& world) {
    state_ = readState(world, world_.file);
    for (const Problem& insertion : state_.insertions) addMissing(insertion);
    world_.warnings.insert(world_.warnings.end(), state_.warnings.begin(), state_.warnings.end());
    for (std::uint64_t i = 0; i < world.ModelCount(); ++i) {
      const sdf::Model& model = *world.ModelByIndex(i);
      if (!state_.deleted.contains(model.Name())) addModel(model, common::Pose3{}, {model.Name(), "", model.Name()});
    }
    if (moved_by_state_ > 0)
      world_.warnings.push_back({state_.source, "state",
                                 Message("state.used", "models and links stand where it says, as in Gazebo classic"),
                                 ""});
    if (world.Element() && world.Element()->HasElement("population"))
      addMissing({locationOf(world.Element()->GetElement("population"), world_.file), "population",
                  Message("world.population", "its models, which Gazebo places by chance, are not read"),
                  "write them as <model>s"});
    for (std::uint64_t i = 0; i < world.ActorCount(); ++i)
      warn(world.Element(),
           Message("world.actor", "actors of the world's file are left out; people come from the trial's file"));
    readStart(world, common::Pose3{});
  }

  /// What is said here ends the loading, unless the world may be incomplete.
  void addMissing(Problem problem) {
    if (incomplete_ == IncompleteWorld::kAllowed) {
      problem.hint = "left out";
      world_.warnings.push_back(std::move(problem));
      return;
    }
    problem.hint += problem.hint.empty() ? "" : "; or ";
    problem.hint += "fly without it by --allow-incomplete-world";
    problems_.push_back(std::move(problem));
  }

  template <typename Parent>
  void readStart(const Parent& parent, const common::Pose3& T_world_parent) {
    world_.start_source = locationOf(parent.Element(), world_.file);
    const sdf::Frame* frame = parent.FrameByName("start");
    if (frame == nullptr) return;
    world_.start_source = locationOf(frame->Element(), world_.file);
    if (auto pose = resolve(frame->SemanticPose(), frame->Element())) world_.T_world_start = T_world_parent * *pose;
  }

  /// The pose by the frames of the file, unless the world's <state> has one.
  std::optional<common::Pose3> placed(const sdf::SemanticPose& semantic, const sdf::ElementPtr& element,
                                      const common::Pose3& T_world_parent, const EntityState* state) {
    auto T_parent_entity = resolve(semantic, element);
    if (!T_parent_entity) return std::nullopt;
    const common::Pose3 T_world_entity = T_world_parent * *T_parent_entity;
    if (state == nullptr || !state->T_world_entity) return T_world_entity;
    const common::Pose3 difference = T_world_entity.inverse() * *state->T_world_entity;
    constexpr double kSame = 1e-4;  // Saved with six digits.
    if (difference.position_m.norm() > kSame || difference.rotation.vec().norm() > kSame) ++moved_by_state_;
    return state->T_world_entity;
  }

  void addModel(const sdf::Model& model, const common::Pose3& T_world_parent, Scope scope) {
    const EntityState* state = state_.of(scope.name);
    const auto T_world_model = placed(model.SemanticPose(), model.Element(), T_world_parent, state);
    if (!T_world_model) return;
    if (state != nullptr) scope.scale = state->scale.cast<float>();
    for (std::uint64_t i = 0; i < model.LinkCount(); ++i) addLink(*model.LinkByIndex(i), *T_world_model, scope);
    for (std::uint64_t i = 0; i < model.ModelCount(); ++i) {
      const sdf::Model& nested = *model.ModelByIndex(i);
      addModel(nested, *T_world_model,
               {scope.top, scope.path + nested.Name() + "/", scope.name + "::" + nested.Name(), scope.scale});
    }
  }

  void addLink(const sdf::Link& link, const common::Pose3& T_world_model, const Scope& scope) {
    const auto T_world_link =
        placed(link.SemanticPose(), link.Element(), T_world_model, state_.of(scope.name + "::" + link.Name()));
    if (!T_world_link) return;
    const sdf::Visual* first_visual = link.VisualCount() > 0 ? link.VisualByIndex(0) : nullptr;
    for (std::uint64_t i = 0; i < link.CollisionCount(); ++i) {
      const sdf::Collision& collision = *link.CollisionByIndex(i);
      const sdf::Visual* visual = i < link.VisualCount() ? link.VisualByIndex(i) : first_visual;
      addGeometry(collision, *T_world_link, scope, link.Name(), lookOf(visual), kEndlessPlane_m);
    }
    if (link.CollisionCount() > 0) return;
    for (std::uint64_t i = 0; i < link.VisualCount(); ++i) {
      const sdf::Visual& visual = *link.VisualByIndex(i);
      addGeometry(visual, *T_world_link, scope, link.Name(), lookOf(&visual), 0.0);
    }
  }

  Look lookOf(const sdf::Visual* visual) {
    constexpr float kHalf = 0.5F;
    if (visual == nullptr) return {};
    const sdf::Material* material = visual->Material();
    const bool see_through = material != nullptr && material->Element() && material->Element()->HasElement("diffuse") &&
                             material->Diffuse().A() <= kHalf;
    if (textureWord(material) == kMirrorWord) return {colorOf(visual), false, Pattern::kBlank, {}, true};
    return {colorOf(visual), see_through || visual->Transparency() >= kHalf, patternOf(material), imageOf(material)};
  }

  /// The albedo map.
  std::string imageOf(const sdf::Material* material) {
    if (material == nullptr || material->PbrMaterial() == nullptr) return {};
    for (const auto type : {sdf::PbrWorkflowType::METAL, sdf::PbrWorkflowType::SPECULAR})
      if (const sdf::PbrWorkflow* workflow = material->PbrMaterial()->Workflow(type))
        return pictureOf(workflow->AlbedoMap(), locationOf(material->Element(), world_.file).file);
    return {};
  }

  /// The file of a picture; empty if it is not there or stands for something else. The surface then has its colour.
  std::string pictureOf(const std::string& uri, const std::filesystem::path& used_in) {
    const auto file = resolver_.find(uri, used_in);
    if (!file) return {};
    auto problem = common::problemOfFile(*file);
    if (!problem) return file->string();
    if (pictures_left_out_.insert(file->string()).second) leaveOut(*std::move(problem));
    return {};
  }

  void leaveOut(Problem problem) {
    constexpr const char* kLeftOut = "; it is left out";
    if (problem.hint.empty())
      problem.message += kLeftOut;
    else
      problem.hint += kLeftOut;
    world_.warnings.push_back(std::move(problem));
  }

  /// Nothing without the element.
  static std::optional<std::string> textureWord(const sdf::Material* material) {
    if (material == nullptr || !material->Element() || !material->Element()->HasElement(kTextureElement))
      return std::nullopt;
    return material->Element()->Get<std::string>(kTextureElement);
  }

  std::optional<Pattern> patternOf(const sdf::Material* material) {
    if (material == nullptr) return std::nullopt;
    const auto word = textureWord(material);
    if (!word) return scriptPattern(material->ScriptName());
    const std::optional<Pattern> pattern = patternFrom(*word);
    if (!pattern) {
      std::vector<std::string> words = patternWords();
      words.emplace_back(kMirrorWord);
      const std::string similar = common::didYouMean(*word, words);
      problems_.push_back({locationOf(material->Element(), world_.file), kTextureElement,
                           Message("world.no-texture", "there is no texture `{}`", *word),
                           similar.empty() ? fmt::format("expected is one of {}", fmt::join(words, ", ")) : similar});
    }
    return pattern;
  }

  template <typename Item>
  void addGeometry(const Item& item, const common::Pose3& T_world_link, const Scope& scope, const std::string& link,
                   const Look& look, double least_plane_m) {
    const auto T_link_item = resolve(item.SemanticPose(), item.Element());
    if (!T_link_item || item.Geom() == nullptr) return;
    const common::Pose3 T_world_item = T_world_link * *T_link_item;
    if (const sdf::Mesh* mesh = item.Geom()->MeshShape()) {
      addMesh(*mesh, T_world_item, scope, link, look);
      return;
    }
    const auto triangles = solidTriangles(*item.Geom(), least_plane_m, resolver_);
    if (!triangles) {
      const Problem problem{locationOf(item.Element(), world_.file), scope.top + "/" + scope.path + link,
                            triangles.error().behind(fmt::format("`{}`: ", item.Name())), ""};
      return std::is_same_v<Item, sdf::Collision> ? addMissing(problem) : leaveOut(problem);
    }
    addShape(scope, link, locationOf(item.Element(), world_.file), T_world_item, *triangles,
             look.color.value_or(colorByName(scope.top)), look);
    world_.shapes.back().terrain = item.Geom()->HeightmapShape() != nullptr;
  }

  void addMesh(const sdf::Mesh& sdf_mesh, const common::Pose3& T_world_item, const Scope& scope,
               const std::string& link, const Look& look) {
    const auto location = locationOf(sdf_mesh.Element(), world_.file);
    const auto path = resolver_.find(sdf_mesh.Uri(), location.file);
    if (!path) {
      addMissing({location, "mesh", Message("world.mesh-missing", "`{}` was not found", sdf_mesh.Uri()),
                  resolver_.hintFor(sdf_mesh.Uri(), location.file)});
      return;
    }
    const auto key = std::make_pair(path->string(), sdf_mesh.Submesh());
    auto cached = meshes_.find(key);
    if (cached == meshes_.end()) {
      cached = meshes_.emplace(key, loadMesh(key.first, key.second)).first;
      if (cached->second && !look.color) warnOfMaterials(*cached->second, key.first, location);
    }
    if (!cached->second) {
      addMissing({location, "mesh", cached->second.error().behind(fmt::format("`{}`: ", path->string())), ""});
      return;
    }
    Triangles triangles = cached->second->triangles;
    if (sdf_mesh.CenterSubmesh()) centre(triangles);
    const Eigen::Vector3f scale = toEigen(sdf_mesh.Scale()).cast<float>();
    for (Eigen::Vector3f& vertex : triangles.vertices_m) vertex = vertex.cwiseProduct(scale);
    addShape(scope, link, location, T_world_item, triangles, look.color.value_or(cached->second->color), look);
    addMaterials(*cached->second, *path, look, world_.shapes.back());
  }

  void warnOfMaterials(const Mesh& mesh, const std::string& file, const common::SourceLocation& location) {
    for (const std::string& missing : mesh.missing_materials)
      world_.warnings.push_back({location, "mesh",
                                 Message("mesh.no-materials", "`{}`: its materials `{}` were not found", file, missing),
                                 "they are left out"});
  }

  /// A colour or an image of the world's file replaces those of the mesh.
  void addMaterials(const Mesh& mesh, const std::filesystem::path& mesh_file, const Look& look, Shape& shape) {
    shape.materials = mesh.materials;
    shape.material_of_triangle = mesh.material_of_triangle;
    shape.image_places = mesh.image_places;
    for (SurfaceMaterial& material : shape.materials) {
      if (!look.image.empty() || look.color || material.image.empty())
        material.image = look.image;
      else
        material.image = pictureOf(material.image, mesh_file);
      if (look.color) material.color = *look.color;
    }
  }

  static void centre(Triangles& triangles) {
    Eigen::AlignedBox3f bounds;
    for (const Eigen::Vector3f& vertex : triangles.vertices_m) bounds.extend(vertex);
    for (Eigen::Vector3f& vertex : triangles.vertices_m) vertex -= bounds.center();
  }

  void addShape(const Scope& scope, const std::string& link, const common::SourceLocation& source,
                const common::Pose3& T_world_item, const Triangles& triangles, const Color& color,
                const Look& look = {}) {
    Shape shape{scope.top, scope.path + link, source, color, {}, triangles.indices, look.glass, look.pattern};
    shape.T_world_shape = T_world_item;
    shape.mirror = look.mirror;
    shape.image = look.image;
    shape.vertices_world_m.reserve(triangles.vertices_m.size());
    for (const Eigen::Vector3f& vertex : triangles.vertices_m)
      shape.vertices_world_m.push_back((T_world_item * vertex.cwiseProduct(scope.scale).cast<double>()).cast<float>());
    const auto fits = [](const Eigen::Vector3f& vertex) {
      return vertex.allFinite() &&
             vertex.cwiseAbs().maxCoeff() <= static_cast<float>(2.0 * common::kGreatestCoordinate_m);
    };
    if (!std::all_of(shape.vertices_world_m.begin(), shape.vertices_world_m.end(), fits))
      problems_.push_back(
          {source, nameOf(shape),
           Message("world.too-large", "its size or pose is not within {:g} m", common::kGreatestCoordinate_m),
           "SDF's unit is the metre"});
    world_.shapes.push_back(std::move(shape));
  }

  std::optional<common::Pose3> resolve(const sdf::SemanticPose& semantic, const sdf::ElementPtr& element) {
    ignition::math::Pose3d pose;
    const sdf::Errors errors = semantic.Resolve(pose);
    if (errors.empty() && pose.IsFinite()) return toPose(pose);
    problems_.push_back({locationOf(element, world_.file), "pose",
                         errors.empty() ? Message("world.pose-not-finite", "it is not finite")
                                        : Message("sdf.error", "{}", errors.front().Message()),
                         ""});
    return std::nullopt;
  }

  void warn(const sdf::ElementPtr& element, Message message) {
    world_.warnings.push_back({locationOf(element, world_.file), "", std::move(message), ""});
  }

  UriResolver resolver_;
  IncompleteWorld incomplete_;
  WorldState state_;
  int moved_by_state_ = 0;
  WorldModel world_;
  std::vector<Problem> problems_;
  std::set<std::string> pictures_left_out_;
  std::map<std::pair<std::string, std::string>, tl::expected<Mesh, Message>> meshes_;
};

}  // namespace

WorldModel loadWorld(const std::string& sdf_file, const std::vector<std::string>& model_paths,
                     IncompleteWorld incomplete) {
  return Loader(sdf_file, model_paths, incomplete).load();
}

}  // namespace swiftlet::simulation

// The world of the simulator: triangles with a colour and the name of the model they belong to, in the world's own
// frame (ENU, metres). Loaded once; then any thread may read it.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "common/error.hpp"
#include "common/geometry.hpp"

namespace swiftlet::simulation {

enum class Pattern;

/// Linear red, green, blue in [0, 1].
using Color = Eigen::Vector3f;

/// A material of a mesh.
struct SurfaceMaterial {
  Color color = Color::Constant(0.7F);
  std::string image = {};  ///< A file with the picture of the surface, PNG or JPEG; empty without a picture.

  bool operator==(const SurfaceMaterial& other) const = default;
};

/// One rigid piece of a model: a triangle soup.
struct Shape {
  std::string model;  ///< Name of the top-level model it belongs to.
  std::string part;   ///< Nested models and link inside it, "kitchen/shelf"; for messages.
  common::SourceLocation source;
  Color color = Color::Constant(0.7F);
  std::vector<Eigen::Vector3f> vertices_world_m;
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< Indices into the vertices; either winding.
  bool glass = false;                                   ///< Its material is transparent by half or more.
  std::optional<Pattern> pattern = {};                  ///< The pattern that its material names.
  std::string image = {};  ///< Stretched over each side of it, as `materials` are not; empty without a picture.
  std::vector<SurfaceMaterial> materials = {};           ///< Of a mesh; empty: `color` everywhere.
  std::vector<std::uint16_t> material_of_triangle = {};  ///< Indices into `materials`.
  std::vector<Eigen::Vector2f> image_places = {};  ///< Of the vertices in the images of their materials, see Mesh.
  common::Pose3 T_world_shape = {};                ///< Of the frame in which patterns keep their place on it.
  bool terrain = false;                            ///< Of a heightmap: what is beneath it is ground.
  bool mirror = false;                             ///< Laser and cameras see what it reflects.
};

/// "model/part".
std::string nameOf(const Shape& shape);

struct WorldModel {
  std::string file;
  std::vector<Shape> shapes;
  Color light = Color::Ones();  ///< Of the lamps: what cameras see of white under them.
  float indoor_light = 1.0F;    ///< Share of it where no daylight falls, see inDaylight.
  /// The pose of `<frame name="start">`, if the world has one.
  std::optional<common::Pose3> T_world_start;
  /// The line of that frame in the file, or else of the world.
  common::SourceLocation start_source;
  /// Elements that were skipped or replaced.
  std::vector<common::Problem> warnings;

  /// Names of the top-level models, in the order of the file.
  std::vector<std::string> modelNames() const;
  bool hasModel(const std::string& model) const;
  /// Shifts every shape of a model horizontally.
  void moveModel(const std::string& model, const Eigen::Vector2d& shift_world_m);
  /// Multiplies the colour of every shape of a model that has no picture; channels stay within [0, 1].
  void tintModel(const std::string& model, const Color& share);
  /// Smallest box around all shapes of a model; empty without shapes.
  Eigen::AlignedBox3f boundsOf_world_m(const std::string& model) const;
  /// Smallest box around all shapes.
  Eigen::AlignedBox3f bounds_world_m() const;
};

/// Whether a world of which something is not to be had is refused, or is flown without it.
enum class IncompleteWorld { kRefused, kAllowed };

/// Reads an SDF world, or a bare `<model>` file as a world of that one model; of several worlds the first. Boxes,
/// cylinders, spheres, capsules, ellipsoids, cones, planes, polylines, heightmaps and meshes are triangulated. The
/// collision geometry of a link is used, or its visual geometry if it has none. A visual with `<transparency>` of 0.5
/// or more, or with a diffuse alpha of 0.5 or less, is glass, as is the collision geometry that goes with it. A
/// material's `<swiftlet:texture>` names a Pattern or is `mirror`, and its albedo map or the textures of a mesh are
/// pictures for the cameras. A picture that is not there is left out, with a warning if a pointer of Git LFS or the
/// like stands for it. The poses of a `<state>` that Gazebo classic saved replace those of the models. `model://`,
/// `file://` and Fuel URIs are searched for as UriResolver does. The sun needs no file; the well-known ground plane is
/// replaced by one at z = 0 if it is not found. Throws common::InputError (file:line) if the file cannot be read or is
/// malformed, or, unless it may be incomplete, if something that it names cannot be found, a collision cannot be built
/// or an element that holds things is misspelt; otherwise that is a warning. Not thread-safe: libsdformat has global
/// state.
WorldModel loadWorld(const std::string& sdf_file, const std::vector<std::string>& model_paths = {},
                     IncompleteWorld incomplete = IncompleteWorld::kRefused);

}  // namespace swiftlet::simulation

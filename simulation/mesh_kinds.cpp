#include "simulation/mesh_kinds.hpp"

#include <assimp/Importer.hpp>

#include <algorithm>
#include <array>
#include <fstream>
#include <string_view>

#include "common/lower_case.hpp"

namespace swiftlet::simulation {
namespace {

using namespace std::string_view_literals;

constexpr const char* kRemedy = "export it as .dae, .obj, .stl or .glb from the program that made it";

struct Kind {
  std::string_view begins_with;  ///< Empty: it is recognized by its ending only.
  std::string_view endings;      ///< Each with a blank behind it.
  const char* name;
  bool read_in_part = false;  ///< Assimp reads some of them.
};
// The first that fits counts: an IFC file is also a STEP file by its first bytes.
constexpr std::array kKinds{
    Kind{"", ".ifc .ifczip ", "an IFC file of a building", true},
    Kind{"ISO-10303-21", ".step .stp .p21 ", "a STEP file, which holds the solids of CAD"},
    Kind{"", ".iges .igs ", "an IGES file, which holds the surfaces of CAD"},
    Kind{"BLENDER", ".blend ", "a file of Blender", true},
    Kind{"Kaydara FBX", ".fbx ", "an FBX file", true},
    Kind{"\xFF\xFE\xFF\x0ES\0k\0e\0t\0c\0h\0U\0p\0"sv, ".skp ", "a file of SketchUp"},
    Kind{"AC10", ".dwg ", "a drawing of AutoCAD"},
    Kind{"3D Geometry File", ".3dm ", "a file of Rhino"},
    Kind{"", ".max ", "a file of 3ds Max"},
    Kind{"", ".ma .mb ", "a file of Maya"},
    Kind{"", ".c4d ", "a file of Cinema 4D"},
    Kind{"", ".sldprt .sldasm ", "a file of SolidWorks"},
    Kind{"", ".ipt .iam ", "a file of Inventor"},
    Kind{"", ".catpart .catproduct ", "a file of CATIA"},
    Kind{"", ".f3d .f3z ", "a file of Fusion"},
    Kind{"", ".fcstd ", "a file of FreeCAD"},
    Kind{"", ".x_t .x_b ", "a Parasolid file, which holds the solids of CAD"},
    Kind{"", ".usd .usda .usdc .usdz ", "a USD file"},
};

std::string firstBytes(const std::string& file) {
  std::array<char, 80> first{};
  std::ifstream stream(file, std::ios::binary);
  stream.read(first.data(), first.size());
  return {first.data(), static_cast<std::size_t>(stream.gcount())};
}

const Kind* kindOf(const std::string& file) {
  const std::string first = firstBytes(file), ending = common::endingOf(file);
  const auto* found = std::find_if(kKinds.begin(), kKinds.end(), [&](const Kind& kind) {
    const bool by_content = !kind.begins_with.empty() && first.starts_with(kind.begins_with);
    return by_content || (!ending.empty() && kind.endings.find(ending + " ") != std::string_view::npos);
  });
  return found == kKinds.end() ? nullptr : found;
}

}  // namespace

common::Message explainUnreadMesh(const std::string& file, const common::Message& reason) {
  using common::Message;
  if (const Kind* kind = kindOf(file)) {
    if (kind->read_in_part)
      return Message("mesh.kind-not-read", "it is {} that cannot be read ({}): {}", kind->name, reason.text(), kRemedy);
    return Message("mesh.other-kind", "it is {}, not a mesh: {}", kind->name, kRemedy);
  }
  const std::string ending = common::endingOf(file);
  if (ending.empty() || Assimp::Importer().IsExtensionSupported(ending)) return reason;
  return Message("mesh.other-ending", "meshes are not read from files that end on `{}`: {}", ending, kRemedy);
}

}  // namespace swiftlet::simulation

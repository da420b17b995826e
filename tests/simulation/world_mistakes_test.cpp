// What people mistype in the files of worlds is said with its place and what was meant.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "common/error.hpp"
#include "fixtures.hpp"
#include "sdf_texts.hpp"
#include "simulation/world_model.hpp"

namespace swiftlet::simulation {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

class WorldMistakes : public ::testing::Test {
 protected:
  /// The models begin in line 3.
  WorldModel load(const std::string& models, IncompleteWorld incomplete = IncompleteWorld::kRefused) {
    return loadText("<sdf version='1.9'>\n<world name='w'>\n" + models + "</world></sdf>\n", incomplete);
  }
  WorldModel loadText(const std::string& text, IncompleteWorld incomplete = IncompleteWorld::kRefused) {
    return loadWorld(folder_.write("world.sdf", text), {}, incomplete);
  }
  std::string refusalOfText(const std::string& text) {
    try {
      loadText(text);
    } catch (const common::InputError& error) {
      return error.what();
    }
    return "no error";
  }
  std::string refusalOf(const std::string& models) {
    return refusalOfText("<sdf version='1.9'>\n<world name='w'>\n" + models + "</world></sdf>\n");
  }

  TemporaryFolder folder_{"swiftlet_world_mistakes"};
};

std::string state(const std::string& inside) { return "<state world_name='w'>\n" + inside + "</state>\n"; }

const std::string kPose = "<pose>4 0 0 0 0 0</pose>";

TEST_F(WorldMistakes, FilesThatHoldNoMeshAreNamedByTheirKind) {
  const std::string step = "ISO-10303-21;\nHEADER;\nFILE_SCHEMA(('AUTOMOTIVE_DESIGN'));\nENDSEC;\n";
  for (const auto& [file, text, kind] :
       std::vector<std::array<std::string, 3>>{{"a.step", step, "it is a STEP file"},
                                               {"a.stl", step, "it is a STEP file"},
                                               {"a.igs", "junk", "it is an IGES file"},
                                               {"a.blend", "BLENDER-v402", "it is a file of Blender"},
                                               {"a.skp", "junk", "it is a file of SketchUp"},
                                               {"a.fbx", "Kaydara FBX", "it is an FBX file that cannot be read"},
                                               {"a.xyz", "junk", "that end on `.xyz`"}}) {
    folder_.write(file, text);
    EXPECT_THAT(refusalOf(model("m", "<mesh><uri>" + file + "</uri></mesh>")),
                AllOf(HasSubstr("world.sdf:3: mesh: "), HasSubstr(kind), HasSubstr(".dae, .obj, .stl or .glb"),
                      Not(HasSubstr("schema"))))
        << file;
  }
}

TEST_F(WorldMistakes, MaterialsOfAMeshThatAreNotThereAreSaidOnce) {
  folder_.write("red.obj", "mtllib red_paint.mtl\r\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl red\nf 1 2 3\n");
  const std::string mesh = "<mesh><uri>red.obj</uri></mesh>";
  EXPECT_THAT(load(model("a", mesh) + model("b", mesh)).warnings,
              ElementsAre(AllOf(HasSubstr("world.sdf:3: mesh: "), HasSubstr("red.obj"), HasSubstr("`red_paint.mtl`"))));
  folder_.write("red_paint.mtl", "newmtl red\nKd 1 0 0\n");
  EXPECT_THAT(load(model("a", mesh)).warnings, IsEmpty());
}

}  // namespace
}  // namespace swiftlet::simulation

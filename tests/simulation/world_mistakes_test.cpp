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
#include "tests/support/problem_matchers.hpp"

namespace swiftlet::simulation {
namespace {

using test_support::HasProblem;
using test_support::kAnyName;
using test_support::ProblemIs;
using test_support::problemsOf;
using ::testing::AllOf;
using ::testing::ElementsAre;
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
  std::vector<common::Problem> refusalOfText(const std::string& text) {
    return problemsOf([&] { loadText(text); });
  }
  std::vector<common::Problem> refusalOf(const std::string& models) {
    return refusalOfText("<sdf version='1.9'>\n<world name='w'>\n" + models + "</world></sdf>\n");
  }

  TemporaryFolder folder_{"swiftlet_world_mistakes"};
};

std::string state(const std::string& inside) { return "<state world_name='w'>\n" + inside + "</state>\n"; }

const std::string kPose = "<pose>4 0 0 0 0 0</pose>";

TEST_F(WorldMistakes, NamesOfAStateThatTheWorldDoesNotHaveAreSaid) {
  const std::string inner = model("inner", kBox);
  const std::string outer = "<model name='outer'><static>1</static>" + inner.substr(0, inner.size() - 1) + "</model>\n";
  const auto warningsOf = [&](const std::string& inside) {
    return load(model("p", kBox) + outer + state(inside)).warnings;
  };
  const auto saidOnce = [](const std::string& says) {
    return ElementsAre(ProblemIs("state.nothing-of-that-name", "world.sdf:6: state", says));
  };
  EXPECT_THAT(warningsOf("<model name='P'>" + kPose + "</model>"), saidOnce("`p`"));
  EXPECT_THAT(warningsOf("<model name='p\u200B'>" + kPose + "</model>"), saidOnce("(U+200B)"));
  EXPECT_THAT(warningsOf("<model name='ghost'>" + kPose + "</model>"), saidOnce("there is p, outer, outer::inner"));
  EXPECT_THAT(warningsOf("<model name='p'><link name='body'>" + kPose + "</link></model>"),
              saidOnce("`p` has no link `body`"));
  EXPECT_THAT(warningsOf("<model name='outer'><model name='iner'>" + kPose + "</model></model>"), saidOnce("`inner`"));
  EXPECT_THAT(warningsOf("<deletions><name>outr</name></deletions>"), saidOnce("`outer`"));
}

TEST_F(WorldMistakes, NamesOfAStateAsGazeboWritesThemPass) {
  const std::string inner = model("inner", kBox);
  const std::string things = model("p", kBox) + model("gone", kBox) + "<light name='sun' type='directional'/>\n" +
                             "<model name='outer'><static>1</static>" + inner + "</model>\n" +
                             "<include><uri>model://ground_plane</uri></include>\n";
  const WorldModel w =  // Only older versions of SDF allow `::` in names.
      loadText("<sdf version='1.6'><world name='w'>" + things +
               state("<deletions><name>gone</name><name>sun</name></deletions>"
                     "<model name=' p '><pose>0 0 0 0 0 0</pose><link name='l'><pose>0 0 0 0 0 0</pose></link></model>"
                     "<model name='outer'><model name='inner'><link name='l'><pose>0 0 0 0 0 0</pose></link></model>"
                     "<link name='inner::l'><pose>0 0 0 0 0 0</pose></link></model>"
                     "<model name='outer::inner'><pose>0 0 0 0 0 0</pose></model>"
                     "<model name='ground_plane'><link name='link'><pose>0 0 0 0 0 0</pose></link></model>"
                     "<light name='lamp'><pose>0 0 10 0 0 0</pose></light>") +
               "</world></sdf>");
  EXPECT_THAT(w.warnings, Not(HasProblem("state.nothing-of-that-name")));
}

TEST_F(WorldMistakes, CharactersThatAreNotSeenAreNamed) {
  const std::string named = "(U+200B)";
  const std::string box = model("box", kBox);
  const auto with = [&](const std::string& part, const std::string& instead) {
    std::string text = box;
    return text.replace(text.find(part), part.size(), instead);
  };
  EXPECT_THAT(refusalOf(box + model("thing", "<bo\u200Bx><size>1 2 3</size></bo\u200Bx>")),
              HasProblem(kAnyName, "world.sdf:4", named));
  EXPECT_THAT(refusalOf(with("collision name", "colli\u200Bsion name")), HasProblem("xml.mismatched-tag", "", named))
      << "its end has it not";
  EXPECT_THAT(refusalOf(with("model name", "model\u00A0name")),
              HasProblem("xml.misleading-name", "world.sdf:3", "(U+00A0)"));
  EXPECT_THAT(refusalOf(with("'box'", "\u201Cbox\u201D")), HasProblem("xml.no-quotes", "world.sdf:3:1", "(U+201C)"));
  EXPECT_THAT(refusalOf(with("<pose>", "<pose relative_to='wo\u200Brld'>")), HasProblem(kAnyName, "", named));
  EXPECT_THAT(refusalOf(box + model("thing", "<bxo><size>1 2 3</size></bxo>")), HasProblem(kAnyName, "", "`box`"));
  EXPECT_THAT(refusalOf(box + "<include><uri>model://she\u200Blf</uri></include>"), HasProblem(kAnyName, "", named));
  EXPECT_THAT(refusalOfText("<sdf version='1.9\u200B'/>"), HasProblem("sdf.no-version", "sdf", named));
  EXPECT_THAT(refusalOfText("<sdf version='x'/>"), HasProblem("sdf.no-version", "sdf", "`x`"));
}

TEST_F(WorldMistakes, EncodingsThatAreDeclaredAreRead) {
  const auto text = [](const std::string& encoding, const std::string& name) {
    return "<?xml version='1.0' encoding='" + encoding + "'?>\n<sdf version='1.9'>\n<world name='w'>\n" +
           model(name, kBox) + "</world></sdf>\n";
  };
  for (const auto& [encoding, name] : {std::pair{"KOI8-R", "\xD3\xD4\xCF\xCC"},
                                       {"windows-1251", "\xF1\xF2\xEE\xEB"},
                                       {"UTF-8", "\u0441\u0442\u043E\u043B"}})
    EXPECT_THAT(loadText(text(encoding, name)).modelNames(), ElementsAre("\u0441\u0442\u043E\u043B")) << encoding;
  EXPECT_THAT(loadText(text("ISO-8859-1", "M\xFCller")).modelNames(), ElementsAre("M\u00FCller"));
  EXPECT_THAT(loadText(text("UTF-8", "M\xFCller")).modelNames(), ElementsAre("M\u00FCller"));
  EXPECT_THAT(refusalOfText(text("KOI9-R", "\xD3\xD4")), HasProblem("encoding.unknown", "world.sdf:1", "`KOI9-R`"));
  EXPECT_THAT(refusalOfText(text("ASCII", "M\xFCller")), HasProblem("encoding.other-bytes", "world.sdf:1", "`ASCII`"));
  EXPECT_THAT(refusalOfText(std::string("\xFF\xFE<\0s", 5)),
              HasProblem("encoding.other-bytes", "world.sdf:1", "`UTF-16LE`"));
}

TEST_F(WorldMistakes, FilesThatHoldNoMeshAreNamedByTheirKind) {
  const std::string step = "ISO-10303-21;\nHEADER;\nFILE_SCHEMA(('AUTOMOTIVE_DESIGN'));\nENDSEC;\n";
  for (const auto& [file, text, kind] : std::vector<std::array<std::string, 3>>{{"a.step", step, "STEP"},
                                                                                {"a.stl", step, "STEP"},
                                                                                {"a.igs", "junk", "IGES"},
                                                                                {"a.blend", "BLENDER-v402", "Blender"},
                                                                                {"a.skp", "junk", "SketchUp"},
                                                                                {"a.fbx", "Kaydara FBX", "FBX"},
                                                                                {"a.xyz", "junk", "`.xyz`"}}) {
    folder_.write(file, text);
    EXPECT_THAT(refusalOf(model("m", "<mesh><uri>" + file + "</uri></mesh>")),
                AllOf(HasProblem(kAnyName, "world.sdf:3: mesh", kind), Not(HasProblem("mesh.not-read"))))
        << file;
  }
}

TEST_F(WorldMistakes, MaterialsOfAMeshThatAreNotThereAreSaidOnce) {
  folder_.write("red.obj", "mtllib red_paint.mtl\r\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl red\nf 1 2 3\n");
  const std::string mesh = "<mesh><uri>red.obj</uri></mesh>";
  EXPECT_THAT(load(model("a", mesh) + model("b", mesh)).warnings,
              ElementsAre(ProblemIs("mesh.no-materials", "world.sdf:3: mesh", "`red_paint.mtl`")));
  folder_.write("red_paint.mtl", "newmtl red\nKd 1 0 0\n");
  EXPECT_THAT(load(model("a", mesh)).warnings, IsEmpty());
}

TEST_F(WorldMistakes, MisspeltElementsThatHoldThingsMakeAWorldIncomplete) {
  const std::string box = model("box", kBox);
  const std::string thing = model("thing", kBox, "3 0 0 0 0 0");
  for (const auto& [right, wrong] : {std::pair{"collision", "colision"},
                                     {"collision", "Collision"},
                                     {"geometry", "geometri"},
                                     {"link", "lnik"},
                                     {"model", "modle"},
                                     {"pose", "poze"},
                                     {"size", "siez"}}) {
    std::string text = thing;
    for (const std::string before : {"<", "</"}) {
      const std::size_t at = text.find(before + right);
      text.replace(at + before.size(), std::string(right).size(), wrong);
    }
    EXPECT_THAT(refusalOf(box + text),
                AllOf(HasProblem("sdf.no-such-part", "world.sdf:4", std::string("`") + wrong + "`"),
                      HasProblem("sdf.no-such-part", "world.sdf:4", std::string("`") + right + "`")));
    const WorldModel w = load(box + text, IncompleteWorld::kAllowed);
    EXPECT_THAT(w.warnings, HasProblem("sdf.no-such-part", "world.sdf:4", wrong));
  }
}

TEST_F(WorldMistakes, ThingsInTheWrongElementMakeAWorldIncomplete) {
  const std::string box = model("box", kBox);
  EXPECT_THAT(refusalOf(box + "<link name='l'/>\n"), HasProblem("sdf.no-such-part", "world.sdf:4", "<model>"));
  EXPECT_THAT(refusalOf(box + "<model name='m'><static>1</static><link name='l'/>\n<collision name='c'><geometry>" +
                        kBox + "</geometry></collision></model>"),
              HasProblem("sdf.no-such-part", "world.sdf:5", "<link>"));
}

TEST_F(WorldMistakes, OtherElementsThatSdfDoesNotHaveAreOnlySaid) {
  for (const std::string odd : {"<frobnicate>3</frobnicate>", "<road_surface/>", "<gravitty>0 0 -9.8</gravitty>"})
    EXPECT_THAT(load(model("box", kBox) + odd).warnings, ElementsAre(ProblemIs("sdf.error", "world.sdf:4"))) << odd;
}

}  // namespace
}  // namespace swiftlet::simulation

#include "simulation/world_model.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <functional>

#include "common/error.hpp"
#include "common/random.hpp"
#include "fixtures.hpp"
#include "sdf_texts.hpp"
#include "simulation/ray_caster.hpp"
#include "simulation/truth_map.hpp"
#include "tests/support/problem_matchers.hpp"

namespace swiftlet::simulation {
namespace {

using test_support::HasProblem;
using test_support::kAnyName;
using test_support::ProblemIs;
using test_support::problemsOf;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

std::string worldFile(const std::string& inside) {
  return "<?xml version=\"1.0\"?>\n<sdf version=\"1.9\">\n<world name=\"w\">\n" + inside + "\n</world>\n</sdf>\n";
}

class WorldFile : public ::testing::Test {
 protected:
  WorldModel load(const std::string& inside) { return loadWorld(folder_.write("w.sdf", worldFile(inside))); }
  /// Why a world cannot be used; nothing goes to the terminal.
  std::vector<common::Problem> problem(const std::function<void()>& loading) {
    ::testing::internal::CaptureStderr();
    auto problems = problemsOf(loading);
    EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
    return problems;
  }
  std::vector<common::Problem> refusalOf(const std::string& inside) {
    return problem([&] { load(inside); });
  }
  TemporaryFolder folder_{"swiftlet_world"};
};

double surfaceVolume(const Shape& shape) {  // For a closed shape, with either winding.
  const Eigen::Vector3f centre = shape.vertices_world_m[0];
  double volume = 0.0;
  Eigen::Vector3f middle = Eigen::Vector3f::Zero();
  for (const auto& vertex : shape.vertices_world_m) middle += vertex;
  middle /= static_cast<float>(shape.vertices_world_m.size());
  for (const auto& t : shape.triangles) {
    const Eigen::Vector3f a = shape.vertices_world_m[t[0]] - middle, b = shape.vertices_world_m[t[1]] - middle,
                          c = shape.vertices_world_m[t[2]] - middle;
    volume += std::abs(a.cross(b).dot(c)) / 6.0;
  }
  return centre.allFinite() ? volume : NAN;
}

TEST_F(WorldFile, MaterialsThatAreHalfTransparentAreGlass) {
  const auto pane = [](const std::string& name, const std::string& visual) {
    return "<model name=\"" + name + "\"><static>true</static><link name=\"l\"><collision name=\"c\"><geometry>" +
           kBox + "</geometry></collision><visual name=\"v\"><geometry>" + kBox + "</geometry>" + visual +
           "</visual></link></model>\n";
  };
  const WorldModel w = load(pane("window", "<transparency>0.7</transparency>") +
                            pane("door", "<material><diffuse>0.8 0.9 1 0.3</diffuse></material>") +
                            pane("curtain", "<transparency>0.2</transparency>") +
                            pane("wall", "<material><diffuse>0.8 0.9 1 1</diffuse></material>") + model("bare", kBox));
  std::vector<std::string> glass;
  for (const Shape& shape : w.shapes)
    if (shape.glass) glass.push_back(shape.model);
  EXPECT_THAT(glass, ElementsAre("window", "door"));
}

TEST_F(WorldFile, TriangulatesEverySolid) {
  const WorldModel w =
      load(model("box", kBox) + model("cylinder", "<cylinder><radius>1</radius><length>2</length></cylinder>") +
           model("sphere", "<sphere><radius>1</radius></sphere>") +
           model("capsule", "<capsule><radius>1</radius><length>2</length></capsule>") +
           model("ellipsoid", "<ellipsoid><radii>1 2 3</radii></ellipsoid>"));
  EXPECT_THAT(w.modelNames(), ElementsAre("box", "cylinder", "sphere", "capsule", "ellipsoid"));
  EXPECT_THAT(w.warnings, IsEmpty());
  const double ball = 4.0 / 3.0 * M_PI;
  EXPECT_NEAR(surfaceVolume(w.shapes[0]), 6.0, 1e-5);
  EXPECT_NEAR(surfaceVolume(w.shapes[1]), 2 * M_PI, 0.02 * 2 * M_PI);
  EXPECT_NEAR(surfaceVolume(w.shapes[2]), ball, 0.02 * ball);
  EXPECT_NEAR(surfaceVolume(w.shapes[3]), ball + 2 * M_PI, 0.02 * (ball + 2 * M_PI));
  EXPECT_NEAR(surfaceVolume(w.shapes[4]), 6 * ball, 0.02 * 6 * ball);
}

TEST_F(WorldFile, AppliesPosesOfModelsLinksAndFrames) {
  const WorldModel w = load(R"(<frame name="corner"><pose>10 0 0 0 0 1.5707963267948966</pose></frame>
<model name="m"><static>true</static><pose relative_to="corner">1 0 0 0 0 0</pose>
  <link name="l"><pose>2 0 0 0 0 0</pose>
    <collision name="c"><pose>0 0 5 0 0 0</pose><geometry>)" +
                            kBox + R"(</geometry></collision></link>
  <model name="nested"><pose>0 0 -20 0 0 0</pose><link name="k"><collision name="c"><geometry>)" +
                            kBox + R"(</geometry></collision></link></model>
</model>
<frame name="start"><pose relative_to="corner">0 3 0 0 0 0</pose></frame>)");
  ASSERT_EQ(w.shapes.size(), 2U);
  Eigen::AlignedBox3f box;
  for (const auto& vertex : w.shapes[0].vertices_world_m) box.extend(vertex);
  EXPECT_LT((box.center() - Eigen::Vector3f(10, 3, 5)).norm(), 1e-5F);
  EXPECT_LT((box.sizes() - Eigen::Vector3f(2, 1, 3)).norm(), 1e-5F) << "turned by a quarter";
  EXPECT_EQ(nameOf(w.shapes[0]), "m/l");
  EXPECT_EQ(nameOf(w.shapes[1]), "m/nested/k");
  ASSERT_TRUE(w.T_world_start);
  EXPECT_LT((w.T_world_start->position_m - Eigen::Vector3d(7, 0, 0)).norm(), 1e-9);
  EXPECT_NEAR(common::yawOf(w.T_world_start->rotation), M_PI / 2, 1e-9);
}

TEST_F(WorldFile, UsesTheVisualAndItsColourWhenALinkHasNoCollision) {
  const WorldModel w =
      load(R"(<model name="m"><static>true</static><link name="l"><visual name="v"><geometry>)" + kBox +
           R"(</geometry><material><diffuse>0.1 0.2 0.3 1</diffuse></material></visual></link></model>)");
  ASSERT_EQ(w.shapes.size(), 1U);
  EXPECT_LT((w.shapes[0].color - Color(0.1F, 0.2F, 0.3F)).norm(), 1e-5F);
}

TEST_F(WorldFile, FindsIncludedModelsAndMeshesOnThePaths) {
  folder_.write("library/crate/model.config",
                "<model><name>crate</name><version>1</version><sdf version='1.6'>model.sdf</sdf></model>");
  folder_.write("library/crate/model.sdf",
                "<sdf version='1.6'><model name='crate'><static>1</static><link name='l'><collision name='c'><geometry>"
                "<mesh><uri>model://crate/meshes/t.obj</uri><scale>2 2 "
                "2</scale></mesh></geometry></collision></link></model></sdf>");
  folder_.write("library/crate/meshes/t.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 2 4\n");
  const std::string file = folder_.write(
      "w.sdf",
      worldFile("<include><uri>model://crate</uri><name>one</name><pose>1 0 0 0 0 0</pose></include>\n"
                "<model name=\"outer\"><static>1</static><include><uri>model://crate</uri></include></model>"));
  const WorldModel w = loadWorld(file, {(folder_.path() / "library").string()});
  EXPECT_THAT(w.modelNames(), ElementsAre("one", "outer"));
  EXPECT_NEAR(w.bounds_world_m().max().x(), 3.0F, 1e-5F);
  ASSERT_EQ(w.shapes.size(), 2U);
  for (const Shape& shape : w.shapes) EXPECT_EQ(shape.triangles.size(), 2U);
  EXPECT_THAT(problem([&] { loadWorld(file); }), HasProblem("sdf.not-found", "w.sdf:4", "--model-path"));
}

TEST_F(WorldFile, FindsModelsIncludedByIncludedModels) {
  const auto sdf = [](const std::string& name, const std::string& inside) {
    return "<sdf version='1.9'>\n<model name='" + name + "'><static>1</static>" + inside + "</model></sdf>";
  };
  folder_.write("models/outer/model.config",
                "<model><name>outer</name><version>1</version><sdf version='1.9'>model.sdf</sdf></model>");
  folder_.write("models/outer/model.sdf", sdf("outer", "<include><uri>model://inner.sdf</uri></include>"));
  const std::string inside = "<include><uri>model://outer</uri></include>\n" + model("box", kBox);
  EXPECT_THAT(refusalOf(inside), HasProblem("sdf.not-found", "outer/model.sdf:2", "model://inner.sdf"))
      << "an obstacle would be missing in the world";
  folder_.write("models/inner.sdf", sdf("inner", "<link name='l'><collision name='c'><geometry>" + kBox +
                                                     "</geometry></collision></link>"));
  EXPECT_THAT(load(inside).modelNames(), ElementsAre("outer", "box"));
}

TEST_F(WorldFile, RefusesFilesThatIncludeEachOther) {
  EXPECT_THAT(refusalOf("<include><uri>w.sdf</uri></include>"),
              HasProblem("sdf.include-circle", "w.sdf:4:10: include"));
  folder_.write("models/ring/model.sdf",
                "<sdf version='1.9'><model name='ring'>\n<include><uri>model://ring</uri></include></model></sdf>");
  EXPECT_THAT(refusalOf("<include><uri> model://ring </uri></include>"),
              HasProblem("sdf.include-circle", "ring/model.sdf:2"));
}

TEST_F(WorldFile, PutsAFloorWhereTheWellKnownGroundPlaneIsMissing) {
  const WorldModel w = load(
      "<include><uri>https://fuel.gazebosim.org/1.0/OpenRobotics/models/Ground Plane</uri></include>\n"
      "<include><uri>model://sun</uri></include>\n" +
      model("box", kBox, "3 0 5 0 0 0"));
  EXPECT_NEAR(RayCaster(w).cast({50, 20, 7}, {0, 0, -1}, 100).distance_m, 7.0, 1e-4);
  EXPECT_THAT(w.warnings, ElementsAre(ProblemIs("sdf.not-found", "w.sdf:4", "z = 0"),
                                      ProblemIs("sdf.not-found", "w.sdf:5", "sun")));
}

TEST_F(WorldFile, WarnsOfUnknownElementsWithLineNumbers) {
  const WorldModel w = load("<frobnicate>3</frobnicate>\n" + model("box", kBox));
  EXPECT_THAT(w.warnings, ElementsAre(ProblemIs("sdf.error", "w.sdf:4", "frobnicate")));
  const std::string file =
      folder_.write("w.sdf", worldFile(model("box", kBox) + model("odd", "<donut><size>1</size></donut>")));
  const WorldModel odd = loadWorld(file, {}, IncompleteWorld::kAllowed);
  EXPECT_THAT(odd.warnings, HasProblem("geometry.unknown-kind", "w.sdf:5", "donut"));
}

TEST_F(WorldFile, AcceptsASingleModelAsAWorld) {
  const std::string file = folder_.write("model.sdf", "<sdf version=\"1.9\">\n" + model("thing", kBox) + "</sdf>");
  EXPECT_THAT(loadWorld(file).modelNames(), ElementsAre("thing"));
}

TEST_F(WorldFile, ReportsThePlaceOfMistakes) {
  EXPECT_THAT(problem([&] { loadWorld((folder_.path() / "none.sdf").string()); }),
              HasProblem("file.not-opened", "none.sdf"));
  EXPECT_THAT(problem([&] { loadWorld(folder_.path().string()); }), HasProblem("file.is-folder"));
  EXPECT_THAT(refusalOf("<model name=\"a\">"), HasProblem("xml.mismatched-tag", "w.sdf:5"));
  EXPECT_THAT(problem([&] { loadWorld(folder_.write("w.sdf", "")); }), HasProblem("xml.no-element"));
  EXPECT_THAT(problem([&] { loadWorld(folder_.write("w.sdf", "<robot name='r'/>")); }),
              HasProblem("sdf.other-root", "w.sdf:1: robot"));
  for (const std::string version : {"<sdf>", "<sdf version='junk'>", "<sdf version=''>"})
    EXPECT_THAT(problem([&] { loadWorld(folder_.write("w.sdf", version + "</sdf>")); }),
                HasProblem("sdf.no-version", "w.sdf:1: sdf"));
  EXPECT_THAT(problem([&] { loadWorld(folder_.write("w.sdf", "<sdf version='1.9'>\n</sdf>")); }),
              HasProblem("sdf.no-world"));
  EXPECT_THAT(refusalOf(model("a", "<box><size>a b 1</size></box>")),
              HasProblem("sdf.no-number", "w.sdf:4", "`a b 1`"));
  EXPECT_THAT(refusalOf(model("a", kBox) + model("a", kBox)), HasProblem("sdf.error", "", "[a]"));
  EXPECT_THAT(refusalOf(model("a", kBox) + "<model name=\"b\">\n<pose relative_to=\"nowhere\"/>" +
                        "<link name=\"l\"/></model>"),
              HasProblem("sdf.error", "w.sdf:6", "nowhere"));
  EXPECT_THAT(refusalOf(model("a", "<mesh><uri>model://x/y.dae</uri></mesh>")),
              HasProblem("world.mesh-missing", "w.sdf:4: mesh", "`model://x/y.dae`"));
  folder_.write("bad.dae", "<COLLADA>");
  folder_.write("lfs.dae", "version https://git-lfs.github.com/spec/v1\noid sha256:83d7\nsize 9\n");
  EXPECT_THAT(refusalOf(model("a", "<mesh><uri>lfs.dae</uri></mesh>")),
              HasProblem("file.pointer", "w.sdf:4: mesh", "`git lfs pull`"));
  EXPECT_THAT(refusalOf(model("a", "<mesh><uri>bad.dae</uri></mesh>")),
              HasProblem(kAnyName, "w.sdf:4: mesh", "bad.dae"));
  EXPECT_THAT(refusalOf(""), HasProblem("world.empty", "w.sdf"));
}

TEST_F(WorldFile, AnyContentIsLoadedOrRefusedWithoutACrash) {
  const std::string sound = worldFile("<frame name=\"start\"><pose>1 2 0 0 0 0</pose></frame>\n" + model("box", kBox) +
                                      model("ball", "<sphere><radius>1</radius></sphere>"));
  int loaded = 0, refused = 0;
  for (std::uint64_t i = 0; i < 80; ++i) {
    common::RandomStream random(1, "mutation", i);
    std::string text = sound;
    const bool values_only = i % 2 == 0;  // The other half breaks the XML as well.
    for (int change = 0; change < 2; ++change) {
      auto at = static_cast<std::size_t>(random.uniform(0, static_cast<double>(text.size())));
      if (values_only) at = std::min(text.find_first_of("0123456789", at), text.size() - 2);
      switch (values_only ? 0 : random.bits() % 3) {
        case 0:
          text[at] = "0123456789.-eax"[random.bits() % 15];
          break;
        case 1:
          text.erase(at, 1 + random.bits() % 8);
          break;
        default:
          text.insert(at, text.substr(random.bits() % text.size(), random.bits() % 30));
          break;
      }
    }
    const auto problems = problem([&] { loadWorld(folder_.write("w.sdf", text)); });
    (problems.empty() ? loaded : refused) += 1;
    for (const common::Problem& one : problems) EXPECT_TRUE(one.location.file.ends_with("w.sdf")) << text;
  }
  EXPECT_GT(loaded, 3);
  EXPECT_GT(refused, 10);
}

TEST_F(WorldFile, RefusesSizesThatAreNotNumbers) {
  EXPECT_THAT(refusalOf(model("a", "<box><size>nan 1 1</size></box>")), HasProblem(kAnyName, "w.sdf:4"));
  EXPECT_THAT(refusalOf(model("a", "<sphere><radius>inf</radius></sphere>")), HasProblem(kAnyName, "w.sdf:4"));
}

TEST_F(WorldFile, ReportsAnInvalidStart) {
  const std::string floor = model("floor", "<box><size>4 4 0.1</size></box>", "0 0 -0.05 0 0 0");
  const auto start = [&](const std::string& inside) {
    return problem([&] { SimulatedVehicle(load(inside), Scenario()); });
  };
  EXPECT_THAT(start(floor), IsEmpty());
  EXPECT_THAT(start("\n<frame name=\"start\"><pose>9 0 0 0 0 0</pose></frame>\n" + floor),
              HasProblem("start.no-floor", "w.sdf:5: start", "(9.00, 0.00, 0.00)"));
  EXPECT_THAT(start(floor + "<frame name=\"start\"><pose>1.8 0 0 0 0 0</pose></frame>\n" +
                    model("wall", "<box><size>0.1 4 2</size></box>", "2 0 1 0 0 0")),
              HasProblem("start.in-obstacle", "w.sdf:5: start", "`wall/l`"));
  EXPECT_THAT(start(floor + "<frame name=\"start\"><pose>1 0 0 0 0 0</pose></frame>\n" +
                    model("step", "<box><size>1 4 0.2</size></box>", "1.5 0 0.1 0 0 0")),
              HasProblem("start.on-an-edge"));
}

double reachableSpaceArea(const RayCaster& rays, const FreeSpaceQuery& query) {
  double cells = 0.0;
  reachableSpace(rays, query).forEachCell([&cells](common::CellIndex, std::uint8_t cell) { cells += cell; });
  return cells * query.resolution_m * query.resolution_m;
}

TEST(Worlds, TheShippedCaseHasItsPublishedFloorArea) {
  const WorldModel w = loadWorld(SWIFTLET_SOURCE_DIR "/worlds/unb_case1.sdf");
  EXPECT_THAT(w.warnings, IsEmpty());
  const RayCaster rays(w);
  // All area between the walls counts as floor, also below boxes and furniture.
  WorldModel empty = w;
  std::erase_if(empty.shapes, [](const Shape& shape) {
    return shape.model == "box_1" || shape.model == "box_2" || shape.model == "table" || shape.model == "platform" ||
           shape.model == "cabinet";
  });
  const RayCaster bare(empty);
  FreeSpaceQuery query;
  query.start_world_m = w.T_world_start->position_m.head<2>();
  query.hull_radius_m = 0.001;
  query.resolution_m = 0.05;
  EXPECT_NEAR(reachableSpaceArea(bare, query), 94.7, 1.0);

  const Eigen::Vector3d start = w.T_world_start->position_m + Eigen::Vector3d(0, 0, 1);
  const Eigen::Vector3d goal = start + Eigen::Vector3d(3.0, -1.5, 0);
  EXPECT_LT(rays.cast(start, (goal - start).normalized(), 30).distance_m, (goal - start).norm()) << "goal is hidden";
  for (const std::string name : {"box_1", "box_2"}) EXPECT_TRUE(w.hasModel(name));
}

}  // namespace
}  // namespace swiftlet::simulation

// Worlds as people have them: saved by other versions and tools, with models that lie elsewhere or nowhere.
#include "simulation/world_model.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <cstdlib>
#include <functional>
#include <optional>
#include <string>

#include "common/error.hpp"
#include "common/image.hpp"
#include "common/png_encoder.hpp"
#include "fixtures.hpp"
#include "sdf_texts.hpp"
#include "simulation/ray_caster.hpp"
#include "simulation/variation.hpp"
#include "tests/support/datasets.hpp"
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

std::string sdf(const std::string& inside, const std::string& version = "1.9") {
  return "<sdf version='" + version + "'>\n" + inside + "</sdf>\n";
}

std::string world(const std::string& inside) { return "<world name='w'>\n" + inside + "</world>\n"; }

/// The variables of the environment that name folders of models are unset, and HOME is empty, but for those given.
class Environment {
 public:
  void set(const char* name, const std::string& value) { ::setenv(name, value.c_str(), 1); }
  explicit Environment(const std::string& home) {
    for (const char* name : {"SDF_PATH", "GZ_SIM_RESOURCE_PATH", "IGN_GAZEBO_RESOURCE_PATH", "GAZEBO_MODEL_PATH",
                             "GAZEBO_RESOURCE_PATH", "GZ_FUEL_CACHE_PATH", "IGN_FUEL_CACHE_PATH"})
      ::unsetenv(name);
    set("HOME", home);
  }
};

class WorldFiles : public ::testing::Test {
 protected:
  WorldModel load(const std::string& text, IncompleteWorld incomplete = IncompleteWorld::kRefused) {
    return loadWorld(folder_.write("home/world.sdf", text), {}, incomplete);
  }
  std::vector<common::Problem> refusalOf(const std::string& text) {
    return problemsOf([&] { load(text); });
  }
  void putModel(const std::string& folder, const std::string& name, const std::string& inside = kBox) {
    folder_.write(folder + "/model.config", "<model><name>x</name><sdf version='1.9'>model.sdf</sdf></model>");
    folder_.write(folder + "/model.sdf", sdf(model(name, inside)));
  }
  std::string pathOf(const std::string& name) const { return (folder_.path() / name).string(); }

  TemporaryFolder folder_{"swiftlet_world_files"};
  Environment environment_{pathOf("home")};
};

Eigen::AlignedBox3f boxOf(const Shape& shape) {
  Eigen::AlignedBox3f box;
  for (const auto& vertex : shape.vertices_world_m) box.extend(vertex);
  return box;
}

TEST_F(WorldFiles, WhatLibsdformatReadsIsRead) {
  const std::string box = sdf(world(model("box", kBox)));
  for (const std::string& text :
       {"<!-- run it with --verbose -- and look -->" + box, "<?xml version='1.0' encoding='ASCII'?>\n" + box,
        "\n  <?xml version='1.0'?>\n" + box, "\xEF\xBB\xBF<?xml version='1.0'?>\n" + box,
        "<?xml version='1.0' encoding='iso-8859-1'?><!-- M\xFCller & S\xF6hne -->\n" + box,
        "<!-- a > b <c> -->" +
            sdf(world("<plugin name='p' filename='f'><a b='1 > 0'>x &amp; y</a></plugin>" + model("box", kBox)))})
    EXPECT_THAT(load(text).modelNames(), ElementsAre("box")) << text;
}

TEST_F(WorldFiles, Utf16IsRead) {
  const std::string box = "<?xml version=\"1.0\" encoding=\"UTF-16\"?>" + sdf(world(model("box", kBox)));
  std::string little = "\xFF\xFE", big = "\xFE\xFF";
  for (const char letter : box) {
    little += {letter, '\0'};
    big += {'\0', letter};
  }
  EXPECT_THAT(load(little).modelNames(), ElementsAre("box"));
  EXPECT_THAT(load(big).modelNames(), ElementsAre("box"));
}

TEST_F(WorldFiles, NewerVersionsAreReadByTheRulesOf19) {
  for (const std::string version : {"1.10", "1.11", "1.12"}) {
    const WorldModel w = load(sdf(world(model("cone", "<cone><radius>1</radius><length>2</length></cone>")), version));
    EXPECT_THAT(w.warnings, HasProblem("sdf.newer-version", "world.sdf:1", version));
    ASSERT_EQ(w.shapes.size(), 1U);
    EXPECT_LT((boxOf(w.shapes[0]).sizes() - Eigen::Vector3f(2, 2, 2)).norm(), 1e-5F);
  }
  folder_.write("home/models/new/model.config", "<model><sdf version='1.12'>model.sdf</sdf></model>");
  folder_.write("home/models/new/model.sdf", sdf(model("new", kBox), "1.12"));
  EXPECT_THAT(load(sdf(world("<include><uri>model://new</uri></include>"))).modelNames(), ElementsAre("new"));
}

TEST_F(WorldFiles, MismatchedTagsAreNamedWithTheirLines) {
  EXPECT_THAT(refusalOf("<sdf version='1.9'>\n<world name='w'>\n</sdf>\n"),
              HasProblem("xml.mismatched-tag", "world.sdf:3:1", "<world> of line 2"));
  EXPECT_THAT(refusalOf("<sdf version='1.9'>\n<world name='w'"), HasProblem("xml.tag-open", "world.sdf:2:1"));
  EXPECT_THAT(refusalOf("<sdf version='1.9'>\n<% 3.times do |i| %>\n<% end %>\n</sdf>"),
              HasProblem("sdf.erb-template", "world.sdf:2:1", "erb "));
}

TEST_F(WorldFiles, TemplatesOfXacroAreRefusedWhereTheyHoldThings) {
  const std::string box = model("box", kBox);
  EXPECT_THAT(refusalOf(sdf(world("<xacro:arg name='a'/><xacro:unless value='x'><plugin name='p' filename='f'/>"
                                  "</xacro:unless>" +
                                  box))),
              IsEmpty());
  EXPECT_THAT(refusalOf(sdf(world(box + "<xacro:if value='x'>" + model("b", kBox) + "</xacro:if>"))),
              HasProblem("sdf.xacro-template", "xacro:if", "xacro \""));
}

TEST_F(WorldFiles, SavedStatesWin) {
  const std::string nested =
      "<model name='outer'><pose>1 0 0 0 0 0</pose><link name='k'><collision name='c'><geometry>" + kBox +
      "</geometry></collision></link>" + model("inner", kBox, "5 0 0 0 0 0") + "</model>";
  const WorldModel w = load(sdf(
      world(model("moved", kBox, "1 1 0 0 0 0") + model("stays", kBox, "7 0 0 0 0 0") + model("gone", kBox) + nested +
            "<state world_name='w'><deletions><name>gone</name></deletions><model name='moved'><pose>4 2 0 0 0 "
            "1.5707963</pose>"
            "<scale>2 1 1</scale><link name='l'><pose>4 3 0 0 0 1.5707963</pose></link></model>"
            "<model name='outer'><pose>0 9 0 0 0 0</pose><model name='inner'><pose>0 20 0 0 0 0</pose></model></model>"
            "<light name='sun'><pose>0 0 10 0 0 0</pose></light></state>"
            "<state world_name='w'><model name='moved'><pose>50 0 0 0 0 0</pose></model></state>")));
  ASSERT_THAT(w.modelNames(), ElementsAre("moved", "stays", "outer"));
  EXPECT_LT((boxOf(w.shapes[0]).center() - Eigen::Vector3f(4, 3, 0)).norm(), 1e-4F) << "the link's pose, too";
  EXPECT_LT((boxOf(w.shapes[0]).sizes() - Eigen::Vector3f(2, 2, 3)).norm(), 1e-4F) << "twice as long, turned";
  EXPECT_LT((boxOf(w.shapes[1]).center() - Eigen::Vector3f(7, 0, 0)).norm(), 1e-4F);
  EXPECT_LT((boxOf(w.shapes[2]).center() - Eigen::Vector3f(0, 9, 0)).norm(), 1e-4F);
  EXPECT_LT((boxOf(w.shapes[3]).center() - Eigen::Vector3f(0, 20, 0)).norm(), 1e-4F);
  EXPECT_THAT(w.warnings, HasProblem("state.used", "state"));
}

const std::string kOak = "<include><uri>https://fuel.gazebosim.org/1.0/OpenRobotics/models/Oak Tree</uri></include>\n";

TEST_F(WorldFiles, ModelsOfFuelAreFoundInItsCaches) {
  EXPECT_THAT(refusalOf(sdf(world(kOak))), AllOf(HasProblem("sdf.not-found", "world.sdf:3", pathOf("home/.gz/fuel")),
                                                 HasProblem("sdf.not-found", "world.sdf:3", "gz fuel download")));
  const std::string inside = "/openrobotics/models/oak tree/";
  for (const std::string cache : {"home/.gz/fuel/fuel.gazebosim.org", "home/.ignition/fuel/fuel.ignitionrobotics.org",
                                  "given/fuel.gazebosim.org", "older/fuel.ignitionrobotics.org"}) {
    putModel(cache + inside + "2", "old");
    putModel(cache + inside + "10", "oak");
    environment_.set("GZ_FUEL_CACHE_PATH", pathOf("given"));
    environment_.set("IGN_FUEL_CACHE_PATH", pathOf("older"));
    EXPECT_THAT(load(sdf(world(kOak))).modelNames(), ElementsAre("oak")) << cache;
    for (const auto& [uri, found] :
         {std::pair{"https://fuel.ignitionrobotics.org/1.0/openrobotics/models/Oak%20Tree/2", "old"},
          {"https://app.gazebosim.org/OpenRobotics/fuel/models/Oak Tree/tip", "oak"}})
      EXPECT_THAT(load(sdf(world(std::string("<include><uri>\n ") + uri + "\n</uri></include>"))).modelNames(),
                  ElementsAre(found))
          << uri;
    std::filesystem::remove_all(folder_.path() / cache);
  }
}

TEST_F(WorldFiles, ModelsOfFuelAreFoundInNamedFolders) {
  putModel("library/Oak Tree", "oak", "<mesh><uri>model://oak_tree/meshes/t.obj</uri></mesh>");
  folder_.write("library/Oak Tree/meshes/t.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  for (const char* variable : {"SDF_PATH", "GZ_SIM_RESOURCE_PATH", "IGN_GAZEBO_RESOURCE_PATH", "GAZEBO_MODEL_PATH"}) {
    environment_.set(variable, pathOf("library"));
    EXPECT_THAT(load(sdf(world(kOak))).modelNames(), ElementsAre("oak")) << variable;
    ::unsetenv(variable);
  }
  EXPECT_THAT(loadWorld(folder_.write("w.sdf", sdf(world(kOak))), {pathOf("library")}).modelNames(),
              ElementsAre("oak"));
}

TEST_F(WorldFiles, ModelUrisAreFoundInTheCachesOfFuel) {
  const std::string uri = "<include><uri>model://Crate</uri></include>";
  const std::string server = "home/.gz/fuel/fuel.gazebosim.org/";
  putModel(server + "gerkey/models/crate/1", "old");
  putModel(server + "gerkey/models/crate/2", "crate", "<mesh><uri>model://Crate/meshes/t.obj</uri></mesh>");
  folder_.write(server + "gerkey/models/crate/2/meshes/t.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  EXPECT_THAT(load(sdf(world(uri))).modelNames(), ElementsAre("crate"));
  putModel(server + "other/models/crate/1", "another");  // Which of the two is meant is not known.
  EXPECT_THAT(refusalOf(sdf(world(uri))), HasProblem("sdf.not-found", "", "model://Crate"));
  environment_.set("SDF_PATH", pathOf(server + "other/models"));
  EXPECT_THAT(refusalOf(sdf(world(uri))), HasProblem("sdf.not-found", "", "`model://crate`"));
  EXPECT_THAT(load(sdf(world("<include><uri>model://crate</uri></include>"))).modelNames(), ElementsAre("another"));
}

TEST_F(WorldFiles, AModelMergedIntoTheWorldGivesItsNames) {
  folder_.write("home/models/set/model.sdf",
                sdf("<model name='set'><frame name='start'><pose>3 0 0 0 0 0</pose></frame>" +
                    model("inner", kBox, "5 0 0 0 0 0") + "</model>"));
  const std::string uri = "<uri>model://set</uri><pose>1 2 0 0 0 0</pose></include>\n";
  const std::string beside =
      "<model name='b'><static>1</static><pose relative_to='inner'>0 4 0 0 0 0</pose><link "
      "name='l'><collision name='c'><geometry>" +
      kBox + "</geometry></collision></link></model>";
  for (const std::string& include : {"<include merge='true'>" + uri, "<include merge=\"1\"><name>n</name>" + uri}) {
    const WorldModel w = load(sdf(world(include + beside)));
    EXPECT_THAT(boxOf(w.shapes.at(0)).center().head<2>(), Eigen::Vector2f(6.0F, 2.0F)) << include;
    EXPECT_THAT(boxOf(w.shapes.at(1)).center().head<2>(), Eigen::Vector2f(6.0F, 6.0F)) << include;
    EXPECT_THAT(w.warnings, IsEmpty()) << include;
    ASSERT_TRUE(w.T_world_start) << include;
    EXPECT_NEAR(w.T_world_start->position_m.x(), 4.0, 1e-9) << include;
  }
}

TEST_F(WorldFiles, IncompleteWorldsAreRefusedUnlessAllowed) {
  const std::string box = model("box", kBox);
  for (const std::string& text :
       {box + kOak,
        box + "<include><uri>model://park</uri></include>" +
            "<model name='b'><static>1</static><pose relative_to='park'/><link name='l'/></model>",
        box + model("m", "<mesh><uri>no.dae</uri></mesh>"), box + model("m", "<donut><size>1</size></donut>"),
        box + model("m", "<heightmap><uri>no.png</uri><size>1 1 1</size></heightmap>"),
        box + "<population name='p'><model_count>2</model_count><distribution><type>grid</type></distribution>" + box +
            "</population>"}) {
    EXPECT_THAT(refusalOf(sdf(world(text))), HasProblem(kAnyName, "", "--allow-incomplete-world")) << text;
    const WorldModel w = load(sdf(world(text)), IncompleteWorld::kAllowed);
    EXPECT_THAT(w.modelNames(), ElementsAre("box"));
    EXPECT_THAT(w.warnings, Not(IsEmpty()));
  }
}

TEST_F(WorldFiles, NamesThatDifferByCaseAreProposed) {
  folder_.write("home/meshes/Wall.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  EXPECT_THAT(refusalOf(sdf(world(model("m", "<mesh><uri>meshes/wall.OBJ</uri></mesh>")))),
              HasProblem("world.mesh-missing", "mesh", "`meshes/Wall.obj`"));
  EXPECT_THAT(refusalOf(sdf(world(model("m", "<mesh><uri>meshes/Wall.obj</uri></mesh>")))), IsEmpty());
  folder_.write("home/models/Oak Tree/Leaf.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  EXPECT_THAT(refusalOf(sdf(world(model("m", "<mesh><uri>model://oak%20tree/leaf.obj</uri></mesh>")))),
              HasProblem("world.mesh-missing", "mesh", "`model://Oak Tree/Leaf.obj`"));
}

TEST_F(WorldFiles, PointersOfGitLfsAreNamed) {
  const std::string pointer = "version https://git-lfs.github.com/spec/v1\noid sha256:0\nsize 1\n";
  folder_.write("home/brick.png", pointer);
  const std::string wall =
      "<model name='wall'><static>1</static><link name='l'><collision name='c'><geometry>" + kBox +
      "</geometry></collision><visual name='v'><geometry>" + kBox +
      "</geometry><material><pbr><metal><albedo_map>brick.png</albedo_map></metal></pbr></material></visual></link>"
      "</model>";
  const WorldModel w = load(sdf(world(wall + wall.substr(0, 13) + "2" + wall.substr(13))));
  EXPECT_THAT(w.warnings, ElementsAre(ProblemIs("file.pointer", "brick.png", "git lfs pull")));
  EXPECT_EQ(w.shapes.at(0).image, "");
  folder_.write("home/hill.png", pointer);
  const std::string hill = model("h", "<heightmap><uri>hill.png</uri><size>4 4 2</size></heightmap>");
  EXPECT_THAT(refusalOf(sdf(world(hill))), HasProblem("file.pointer", "world.sdf:3", "git lfs pull"));
  EXPECT_THAT(load(sdf(world(wall + hill)), IncompleteWorld::kAllowed).modelNames(), ElementsAre("wall"));
}

TEST_F(WorldFiles, PolylinesAreExtruded) {
  const std::string ring =
      "<polyline><point>0 0</point><point>4 0</point><point>4 4</point><point>0 4</point><height>2</height></polyline>"
      "<polyline><point>1 1</point><point>1 3</point><point>3 3</point><point>3 1</point><height>2</height></polyline>";
  const WorldModel w = load(sdf(world(model("ring", ring, "10 0 0.5 0 0 0"))));
  const RayCaster rays(w);
  EXPECT_NEAR(rays.cast({10.5, 0.5, 9}, {0, 0, -1}, 100).distance_m, 6.5, 1e-4) << "the top";
  EXPECT_FALSE(rays.cast({12, 2, 9}, {0, 0, -1}, 100)) << "the hole";
  EXPECT_NEAR(rays.cast({5, 2, 1}, {1, 0, 0}, 100).distance_m, 5.0, 1e-4) << "the outer side";
  EXPECT_NEAR(rays.cast({12, 2, 1}, {1, 0, 0}, 100).distance_m, 1.0, 1e-4) << "the inner side";
  EXPECT_THAT(
      refusalOf(sdf(world(model("a", "<polyline><point>0 0</point><point>1 0</point><height>1</height></polyline>")))),
      HasProblem("geometry.too-few-points", "world.sdf:3"));
}

// The triangles of 1500 points took 600 MB.
TEST_F(WorldFiles, PolylinesOfVeryManyPointsAreRefused) {
  std::string zigzag;
  for (int i = 0; i < 501; ++i) zigzag += "<point>" + std::to_string(i) + (i % 2 == 0 ? " 0" : " 9") + "</point>";
  const std::string line = "<polyline>" + zigzag + "<height>1</height></polyline>";
  EXPECT_THAT(refusalOf(sdf(world(model("a", line + line)))),
              HasProblem("geometry.too-many-points", "world.sdf:3", "1002"));
}

TEST_F(WorldFiles, TextsMayHaveCommentsAndCdata) {
  putModel("home/models/crate", "crate");
  for (const std::string uri : {"<![CDATA[model://crate]]>", "<!-- wood --> model://crate ",
                                "\n<!-- a --><!-- <b> -->\n<![CDATA[ model://crate ]]>"})
    EXPECT_THAT(load(sdf(world("<include><uri>" + uri + "</uri></include>"))).modelNames(), ElementsAre("crate"))
        << uri;
  const std::string uri = "<uri>model://crate</uri></include>";
  EXPECT_THAT(load(sdf(world("<include><name><!-- n -->box</name>" + uri))).modelNames(), ElementsAre("box"));
  EXPECT_THAT(load(sdf(world("<include><name><![CDATA[a<b]]></name>" + uri))).modelNames(), ElementsAre("a<b"));
  EXPECT_THAT(load(sdf(world("<include><name><!-- none --></name>" + uri))).modelNames(), ElementsAre("crate"));
}

TEST_F(WorldFiles, AFullFolderForCopiesIsNamed) {
  putModel("home/models/crate", "crate");
  const std::string text = sdf(world("<include><uri>model://crate</uri></include>"));
  const std::string file = folder_.write("home/world.sdf", text);
  const auto before = std::signal(SIGXFSZ, SIG_IGN);
  rlimit limit{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &limit), 0);
  const rlimit full{16, limit.rlim_max};
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &full), 0);
  const auto problems = problemsOf([&] { loadWorld(file); });
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &limit), 0);
  std::signal(SIGXFSZ, before);
  EXPECT_THAT(problems, HasProblem("sdf.no-copy", "", "TMPDIR"));
  environment_.set("TMPDIR", pathOf("nowhere"));
  EXPECT_THAT(refusalOf(text), HasProblem("sdf.no-folder", "", "TMPDIR"));
  ::unsetenv("TMPDIR");
}

TEST_F(WorldFiles, HeightmapsAreTerrain) {
  common::Image image{3, 3, std::vector<std::uint8_t>(27, 0)};
  for (std::size_t channel = 0; channel < 3; ++channel) image.rgb[channel] = 255;  // The corner at -x and +y.
  const auto bytes = common::encodePng(image);
  folder_.write("home/hill.png", std::string(bytes.begin(), bytes.end()));
  const WorldModel w =
      load(sdf(world(model("hill", "<heightmap><uri>hill.png</uri><size>4 4 2</size><pos>0 0 1</pos></heightmap>"))));
  const RayCaster rays(w);
  EXPECT_NEAR(rays.cast({-1.99, 1.99, 9}, {0, 0, -1}, 100).distance_m, 6.0, 0.05);
  EXPECT_NEAR(rays.cast({1, -1, 9}, {0, 0, -1}, 100).distance_m, 8.0, 1e-4);
  folder_.write("home/hill.tif", "II*");
  EXPECT_THAT(refusalOf(sdf(world(model("h", "<heightmap><uri>hill.tif</uri><size>4 4 2</size></heightmap>")))),
              HasProblem("image.no-png-or-jpeg", "h/l", "hill.tif"));
}

TEST_F(WorldFiles, AbsurdSizesAreNamedWithTheirLine) {
  for (const std::string geometry :
       {"<box><size>-1 1 1</size></box>", "<box><size>1 1e9 1</size></box>", "<sphere><radius>-0.5</radius></sphere>",
        "<sphere><radius>0</radius></sphere>", "<cylinder><radius>1</radius><length>1e300</length></cylinder>"})
    EXPECT_THAT(refusalOf(sdf(world("\n" + model("thing", geometry)))), HasProblem("geometry.size", "thing/l"))
        << geometry;
  EXPECT_THAT(refusalOf(sdf(world(model("far", kBox, "1e8 0 0 0 0 0")))), HasProblem("world.too-large", "far/l"));
}

TEST_F(WorldFiles, ABlockedStartNamesTheNearestFreePlace) {
  const WorldModel w = load(sdf(world(model("floor", "<box><size>20 20 0.1</size></box>", "0 0 -0.05 0 0 0") +
                                      model("crate", "<box><size>1 1 1</size></box>", "0 0 0.5 0 0 0"))));
  Scenario scenario;
  const auto problems = problemsOf([&] { realize(w, scenario); });
  ASSERT_THAT(problems, ElementsAre(ProblemIs("start.in-obstacle", "start", "--start \"")));
  const std::string& text = problems[0].hint;
  double x = 0.0, y = 0.0;
  ASSERT_EQ(std::sscanf(text.substr(text.find("--start")).c_str(), "--start \"%lf;%lf;", &x, &y), 2);
  EXPECT_LT(std::hypot(x, y), 1.5);
  scenario.start = {false, x, y, 0.0, 0.0};
  EXPECT_THAT(problemsOf([&] { realize(w, scenario); }), IsEmpty());
}

TEST_F(WorldFiles, OfSeveralWorldsTheFirstIsFlown) {
  const WorldModel w = load(sdf(world(model("a", kBox)) + "<world name='x'>" + model("b", kBox) + "</world>"));
  EXPECT_THAT(w.modelNames(), ElementsAre("a"));
  EXPECT_THAT(w.warnings, ElementsAre(ProblemIs("world.further")));
}

TEST_F(WorldFiles, ARealMazeStandsAsGazeboSavedIt) {
  const auto folder = test_support::dataSet("10-field-cases/world_state_ignored");
  if (!folder) return;
  const WorldModel saved = loadWorld((*folder / "maze_1.world").string());
  const WorldModel expected = loadWorld((*folder / "maze_1_as_gazebo.world").string());
  EXPECT_LT((saved.boundsOf_world_m("maze1").center() - expected.boundsOf_world_m("maze1").center()).norm(), 1e-4F);
}

}  // namespace
}  // namespace swiftlet::simulation

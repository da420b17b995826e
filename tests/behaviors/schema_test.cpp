// The schema and the palette are made from the registry. Stale ones fail here, and the schema accepts the same missions
// as the parser.
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include <gtest/gtest.h>

#include "behaviors/mission_check.hpp"
#include "behaviors/registry.hpp"
#include "behaviors/tree/drawing.hpp"
#include "behaviors/tree/parser.hpp"

namespace swiftlet::behaviors {
namespace {

namespace fs = std::filesystem;

const fs::path kMissions = fs::path(SWIFTLET_SOURCE_DIR) / "missions";

std::string textOf(const fs::path& path) {
  std::ifstream file(path);
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

void expectFresh(const fs::path& shipped, const std::string& made) {
  const fs::path fresh = fs::path(SWIFTLET_BINARY_DIR) / shipped.filename();
  std::ofstream(fresh) << made;
  EXPECT_TRUE(textOf(shipped) == made) << shipped << " is stale: cp " << fresh << " " << shipped;
}

TEST(Schema, IsUpToDate) { expectFresh(kMissions / "swiftlet.xsd", tree::writeSchema(missionRegistry())); }

TEST(NodeTable, IsUpToDate) {
  expectFresh(fs::path(SWIFTLET_SOURCE_DIR) / "docs" / "nodes.md", tree::writeNodeTable(missionRegistry()));
}

TEST(Pictures, OfTheShippedMissionsAreUpToDate) {
  std::string page = textOf(fs::path(SWIFTLET_SOURCE_DIR) / "docs" / "missions.md");
  int count = 0;
  const tree::Registry registry = missionRegistry();
  for (const auto& entry : fs::directory_iterator(kMissions)) {
    if (entry.path().extension() != ".xml") continue;
    const std::string picture = "mission_" + entry.path().stem().string() + ".svg";
    const tree::ParseResult parsed = tree::parseFile(entry.path().string(), registry);
    ASSERT_TRUE(parsed.tree.has_value()) << entry.path();
    expectFresh(fs::path(SWIFTLET_SOURCE_DIR) / "docs/images" / picture, tree::drawTree(*parsed.tree));
    EXPECT_NE(page.find("images/" + picture), std::string::npos) << picture << " is not on docs/missions.md";
    ++count;
  }
  EXPECT_GE(count, 12);
}

TEST(Pictures, ShowEveryNodeWithWhatItIsGiven) {
  const tree::Registry registry = missionRegistry();
  const tree::ParseResult parsed = tree::parseText(
      "<root BTCPP_format=\"4\" main_tree_to_execute=\"M\"><BehaviorTree ID=\"M\"><Sequence name=\"a &lt; b\"><TakeOff "
      "height_m=\"1.5\"/><SubTree ID=\"S\" name=\"home\"/></Sequence></BehaviorTree><BehaviorTree ID=\"S\"><Land "
      "_skipIf=\"1 > 2\"/></BehaviorTree></root>",
      "m.xml", registry);
  ASSERT_TRUE(parsed.tree.has_value());
  const std::string svg = tree::drawTree(*parsed.tree);
  for (const char* words :
       {">a &lt; b<", ">Sequence<", ">TakeOff<", "height_m=1.5", ">home<", "ID=S", ">Land<", "_skipIf=1 &gt; 2"})
    EXPECT_NE(svg.find(words), std::string::npos) << words << "\n" << svg;
}

TEST(Palette, IsUpToDate) {
  expectFresh(kMissions / "groot2/palette.xml", tree::writeTreeNodesModel(missionRegistry()));
}

TEST(Palette, IsValidInsideAMission) {
  const std::string palette = tree::writeTreeNodesModel(missionRegistry());
  const std::size_t begin = palette.find("  <TreeNodesModel>"), end = palette.find("</root>");
  const std::string mission =
      "<root BTCPP_format=\"4\"><BehaviorTree ID=\"M\"><Sequence><TakeOff/><Land/></Sequence></BehaviorTree>" +
      palette.substr(begin, end - begin) + "</root>";
  EXPECT_TRUE(judgeMissionText(mission, "m.xml").problems.empty());
}

/// 0: valid by the schema, anything else: not.
int xmllint(const std::string& text) {
  const fs::path file = fs::path(SWIFTLET_BINARY_DIR) / "schema_test.xml";
  std::ofstream(file) << text;
  return std::system(
      ("xmllint --noout --schema '" + (kMissions / "swiftlet.xsd").string() + "' '" + file.string() + "' 2>/dev/null")
          .c_str());
}

std::string mission(const std::string& inside) {
  return "<root BTCPP_format=\"4\"><BehaviorTree ID=\"M\">" + inside + "</BehaviorTree></root>";
}

TEST(Schema, AgreesWithTheParser) {
  if (std::system("xmllint --version 2>/dev/null") != 0)
    GTEST_SKIP() << "NO xmllint (apt: libxml2-utils): the schema was not tried";
  for (const auto& entry : fs::directory_iterator(kMissions)) {
    if (entry.path().extension() != ".xml") continue;
    EXPECT_EQ(xmllint(textOf(entry.path())), 0) << entry.path();
  }
  for (const char* good :
       {"<Sequence><TakeOff height_m='{h}'/><MoveToGoal goal='1;-2.5;3' clearance_m=' 0.1 '/><Land/></Sequence>",
        "<Timeout msec='1500'><Explore name='look round' bounds=' -2;-1.5; 4;5'/></Timeout>", "<Explore bounds='{b}'/>",
        "<Action ID='TakeOff' height_m='1'/>", "<SubTree ID='X' goal='{g}' _autoremap='true'/>",
        "<SetBlackboard value='1;2' output_key='{goal}'/>"})
    EXPECT_EQ(xmllint(mission(good)), 0) << good;
  for (const char* bad : {"<TakeOff hight_m='1'/>", "<TakeOff height_m='1 m'/>", "<TakeOff height_m='1000'/>",
                          "<MoveToGoal/>", "<MoveToGoal goal='1'/>", "<Explore bounds='1;2;3'/>", "<Sequence/>",
                          "<Inverter><Land/><Land/></Inverter>", "<Land><Land/></Land>", "<Tumble/>",
                          "<Repeat num_cycles='1.5'><Land/></Repeat>", "<SubTree/>", "<Land/><Land/>"}) {
    EXPECT_NE(xmllint(mission(bad)), 0) << bad;
    EXPECT_FALSE(judgeMissionText(mission(bad), "m.xml").problems.empty()) << bad;
  }
}

}  // namespace
}  // namespace swiftlet::behaviors

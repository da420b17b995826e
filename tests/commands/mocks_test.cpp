// swiftlet check --mock-leaves and swiftlet nodes as users meet them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/commands/missions.hpp"
#include "tests/support/program.hpp"
#include "tests/support/scratch.hpp"

namespace swiftlet::commands {
namespace {

using test_support::describe;
using test_support::ProgramEnd;
using test_support::runSwiftlet;
using testing::HasSubstr;

class MockLeaves : public test_support::Scratch {
 protected:
  std::string mockedMission(const std::string& leaves) const { return write("mission.xml", missionWith(leaves)); }
};

TEST_F(MockLeaves, SaysWhoseTheNodesAre) {
  const std::string path = mockedMission(
      "      <TakeOff height=\"2\"/>\n      <GoTo pose=\"5;5\"/>\n      <GoTo pose=\"0;0\"/>\n      <Land/>\n");
  const ProgramEnd strict = runSwiftlet({"check", path});
  EXPECT_EQ(strict.exit_code, 2) << describe(strict);
  const ProgramEnd mocked = runSwiftlet({"check", "--mock-leaves", path});
  EXPECT_EQ(mocked.exit_code, 0) << describe(mocked);
  EXPECT_EQ(mocked.out, path + ": 1 of the engine: Sequence\n" + path + ": 1 of Swiftlet: Land\n" + path +
                            ": 3 mocks: GoTo, TakeOff (Swiftlet's has no port `height`)\n1 mission is sound\n");
  const ProgramEnd json = runSwiftlet({"check", "--mock-leaves", "--json", path});
  EXPECT_EQ(nlohmann::json::parse(json.out)["nodes"][path].size(), 3U) << describe(json);
}

TEST_F(MockLeaves, JudgesAMissionWithoutMocksAsAlways) {
  const std::string path = mockedMission("      <Explore/>\n      <TakeOff/>\n");
  const ProgramEnd end = runSwiftlet({"check", "--mock-leaves", path});
  EXPECT_EQ(end.exit_code, 2) << describe(end);
  EXPECT_THAT(end.err, HasSubstr("expected a TakeOff before it"));
}

TEST_F(MockLeaves, ATreeOfTheEngineAloneIsNoMission) {
  const std::string path = mockedMission("      <Script code=\"x := 1\"/>\n      <Sleep msec=\"100\"/>\n");
  EXPECT_EQ(runSwiftlet({"check", path}).exit_code, 2) << "as a mission it never takes off";
  const ProgramEnd end = runSwiftlet({"check", "--mock-leaves", "--dry-run", write("d.script", "ticks: 5\n"), path});
  EXPECT_EQ(end.exit_code, 0) << describe(end);
  EXPECT_THAT(end.out, HasSubstr("ended with SUCCESS after 2 ticks"));
}

TEST_F(MockLeaves, OfSeveralFilesEachMayUseTheTreesOfAll) {
  const std::string a = write("a.xml",
                              "<root BTCPP_format=\"4\" main_tree_to_execute=\"A\"><BehaviorTree ID=\"A\"><Sequence>"
                              "<TakeOff/><SubTree ID=\"B\"/><Land/></Sequence></BehaviorTree></root>");
  const std::string b =
      write("b.xml", "<root BTCPP_format=\"4\"><BehaviorTree ID=\"B\"><Wiggle v=\"{speed}\"/></BehaviorTree></root>");
  const ProgramEnd alone = runSwiftlet({"check", "--mock-leaves", a});
  EXPECT_EQ(alone.exit_code, 2) << describe(alone);
  EXPECT_THAT(alone.err, HasSubstr("name the file that has it too: check --mock-leaves " + a));
  const ProgramEnd together = runSwiftlet({"check", "--mock-leaves", a, b});
  EXPECT_EQ(together.exit_code, 0) << describe(together);
  EXPECT_THAT(together.out, HasSubstr("2 missions are sound"));
  const ProgramEnd dry =
      runSwiftlet({"check", "--mock-leaves", "--dry-run", write("s", "Wiggle: RUNNING, SUCCESS"), a, b});
  EXPECT_EQ(dry.exit_code, 0) << describe(dry);
  EXPECT_THAT(dry.out, HasSubstr("A/Sequence/B/Wiggle: RUNNING -> SUCCESS"));
  const ProgramEnd missions = runSwiftlet({"check", a, b});
  EXPECT_EQ(missions.exit_code, 2) << describe(missions);
  EXPECT_THAT(missions.err, HasSubstr("write <include path=\"b.xml\"/> below <root>"));
}

TEST_F(MockLeaves, AFileThatAnotherOneUsesIsNoMissionOfItsOwn) {
  const std::string a =
      write("a.xml",
            "<root BTCPP_format=\"4\" main_tree_to_execute=\"A\"><BehaviorTree ID=\"A\"><Sequence><TakeOff/>"
            "<SetBlackboard value=\"3\" output_key=\"lim\"/><SubTree ID=\"B\" _autoremap=\"true\"/><Land/></Sequence>"
            "</BehaviorTree></root>");
  const std::string b = write("b.xml",
                              "<root BTCPP_format=\"4\"><BehaviorTree ID=\"B\"><Sequence><MoveToGoal goal=\"1;0\"/>"
                              "<ScriptCondition code=\"lim &gt; 1\"/></Sequence></BehaviorTree></root>");
  EXPECT_EQ(runSwiftlet({"check", "--mock-leaves", b}).exit_code, 2) << "alone it flies before a take-off";
  const ProgramEnd together = runSwiftlet({"check", "--mock-leaves", a, b});
  EXPECT_EQ(together.exit_code, 0) << describe(together);
  EXPECT_EQ(together.err, "");
  const std::string wrong = write("b.xml",
                                  "<root BTCPP_format=\"4\"><BehaviorTree ID=\"B\"><MoveToGoal goal=\"here\"/>"
                                  "</BehaviorTree></root>");
  EXPECT_EQ(runSwiftlet({"check", "--mock-leaves", a, wrong}).exit_code, 2) << "its XML is judged";
}

TEST_F(MockLeaves, WarnsOfTwoFilesWithATreeOfOneName) {
  const auto helper = [&](const char* file) {
    return write(file, "<root BTCPP_format=\"4\"><BehaviorTree ID=\"B\"><AlwaysSuccess/></BehaviorTree></root>");
  };
  const std::string b = helper("b.xml"), c = helper("c.xml");
  const std::string a = write("a.xml",
                              "<root BTCPP_format=\"4\"><BehaviorTree ID=\"A\"><Sequence><Wiggle/><SubTree ID=\"B\"/>"
                              "</Sequence></BehaviorTree></root>");
  EXPECT_THAT(runSwiftlet({"check", "--mock-leaves", a, b, c}).err,
              HasSubstr(c + ":1:24: warning: BehaviorTree: `B` is defined at " + b + ":1:24 too"));
  EXPECT_EQ(runSwiftlet({"check", "--mock-leaves", b, c}).err, "") << "nobody uses one of them";
}

TEST_F(MockLeaves, AForeignTreeMayHaveTheNameOfABehaviour) {
  const std::string path = write(
      "patrol.xml",
      "<root BTCPP_format=\"4\" main_tree_to_execute=\"Patrol\"><BehaviorTree ID=\"Patrol\"><Sequence><Drive/>"
      "<SubTree ID=\"Inspect\"/></Sequence></BehaviorTree><BehaviorTree ID=\"Inspect\"><Look/></BehaviorTree></root>");
  const ProgramEnd mocked = runSwiftlet({"check", "--mock-leaves", path});
  EXPECT_EQ(mocked.exit_code, 0) << describe(mocked);
  EXPECT_THAT(mocked.err, HasSubstr("warning: BehaviorTree: `Patrol` is the name of a node type too"));
  const ProgramEnd strict = runSwiftlet({"check", path});
  EXPECT_EQ(strict.exit_code, 2) << describe(strict);
  EXPECT_THAT(strict.err, HasSubstr("`Patrol` is the name of a node type, give the tree another ID, as `PatrolTree`"));
  const std::string leaf = write("leaf.xml",
                                 "<root BTCPP_format=\"4\" main_tree_to_execute=\"M\"><BehaviorTree ID=\"M\"><Inspect/>"
                                 "</BehaviorTree><BehaviorTree ID=\"Inspect\"><Look/></BehaviorTree></root>");
  EXPECT_THAT(runSwiftlet({"check", "--mock-leaves", leaf}).err,
              HasSubstr("a tree is used as <SubTree ID=\"Inspect\"/>"));
}

TEST_F(MockLeaves, AreNotFlown) {
  const ProgramEnd end = runSwiftlet({"fly", mockedMission(kHop), "--mock-leaves"});
  EXPECT_EQ(end.exit_code, 2) << describe(end);
  EXPECT_THAT(end.err, HasSubstr("--mock-leaves"));
}

TEST(Nodes, PrintsExactlyOneForm) {
  EXPECT_THAT(runSwiftlet({"nodes", "--xml"}).out, HasSubstr("<Action ID=\"TakeOff\">"));
  EXPECT_THAT(runSwiftlet({"nodes", "--xsd"}).out, HasSubstr("<xs:element name=\"TakeOff\">"));
  EXPECT_THAT(runSwiftlet({"nodes", "--markdown"}).out, HasSubstr("| `TakeOff` | Action |"));
  EXPECT_EQ(runSwiftlet({"nodes", "--xml", "--xsd"}).exit_code, 2);
  EXPECT_EQ(runSwiftlet({"nodes", "--xml", "TakeOff"}).exit_code, 2);
}

TEST(Nodes, PrintsAListAndThePortsOfThoseThatAreNamed) {
  EXPECT_THAT(runSwiftlet({"nodes"}).out, HasSubstr("\nTakeOff: Climbs from the floor to a height and hovers.\n"));
  EXPECT_EQ(runSwiftlet({"nodes", "TurnTo"}).out,
            "TurnTo: Turns on the spot.\n"
            "  Ends: SUCCESS when it looks there\n"
            "  yaw_deg: a number in degrees from -360 to 360, required\n"
            "      Heading in the map frame, counter-clockwise; 0 is that of the take-off, or the x axis of the given "
            "map.\n");
  EXPECT_THAT(runSwiftlet({"nodes", "SubTree"}).out, HasSubstr("SubTree: Runs another tree, with entries of its own;"));
  EXPECT_THAT(runSwiftlet({"nodes"}).out, HasSubstr("\nSubTree: Runs another tree"));
  EXPECT_THAT(runSwiftlet({"nodes", "MoveTo"}).err, HasSubstr("did you mean `MoveToGoal`?"));
  EXPECT_THAT(runSwiftlet({"nodes", "Subtree"}).err, HasSubstr("did you mean `SubTree`?"));
  const ProgramEnd end = runSwiftlet({"nodes", "TakeOff", "Photografh"});
  EXPECT_EQ(end.exit_code, 2) << describe(end);
  EXPECT_THAT(end.err, HasSubstr("nodes: unknown node `Photografh`, did you mean `Photograph`?"));
}

}  // namespace
}  // namespace swiftlet::commands

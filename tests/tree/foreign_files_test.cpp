// Files of other programs, read with mocks: what BehaviorTree.CPP takes in them is a warning. The same files are
// refused as missions.
#include <filesystem>
#include <fstream>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/tree/mocked_tree.hpp"
#include "tests/tree/story.hpp"

namespace swiftlet::tree {
namespace {

using testing::At;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using testing::MockedTree;

class ForeignFile : public ::testing::Test {
 protected:
  /// Writes it as this test's file.
  void write(const std::string& text) {
    path_ = (std::filesystem::path(::testing::TempDir()) /
             (std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()) + ".xml"))
                .string();
    std::ofstream(path_) << text;
  }
  void writeTree(const std::string& inside, const std::string& more = {}) { write(testing::file(inside, more)); }

  std::vector<Problem> problemsOfMission() const { return parseFile(path_, withEveryName()).problems; }
  std::string firstTick() const { return MockedTree(path_).tick().substr(0, 7); }

  /// The engine's nodes and the mocks, but the file is read as a mission is.
  Registry withEveryName() const { return withMocks(path_, Registry::standard()).registry; }

  std::string path_;
};

TEST_F(ForeignFile, HasRawCharactersInItsValues) {
  writeTree(
      "<Sequence><Script code=\"n := 3; s := 'a&b&#65;&lt;&nbsp;'\"/>\n"
      "<!-- \"&<\" --><Tést a='\"<'/> <ScriptCondition code=\"n < 4 && 2 < n\" name='<&'\n/>"
      "<ScriptCondition code=\"s == 'a&amp;bA&lt;&amp;nbsp;'\"/></Sequence>");
  EXPECT_THAT(problemsOfMission(), ElementsAre(At("3:42 <Sequence>", "tree.xml-malformed")));
  const MockedTree tree(path_);
  EXPECT_THAT(tree.problems(), IsEmpty());
  EXPECT_THAT(tree.warnings(),
              ElementsAre(At("3:40", "tree.value-unescaped", "&amp;"), At("4:24", "tree.value-unescaped", "&lt;"),
                          At("4:54", "tree.value-unescaped"), At("4:74", "tree.value-unescaped")));
  EXPECT_EQ(firstTick(), "SUCCESS");
}

TEST_F(ForeignFile, WithRawCharactersHasItsPlaces) {
  writeTree(
      "<Sequence><Script code=\"n := 1 && 2 < 3\"/><Repeat num_cycles=\"0 < 1\" num=\"<<&\" more=\"\">\n"
      "<Do a=\"&&&&\"/></Repeat> text<Inverter/></Sequence>");
  EXPECT_THAT(
      MockedTree(path_).problems(),
      ElementsAre(At("4:25 Sequence", "tree.stray-text"), At("3:51 Repeat.num_cycles", "tree.value-type", "`0 < 1`"),
                  At("3:70 Repeat", "tree.unknown-port", "`num`"), At("3:80 Repeat", "tree.unknown-port", "`more`"),
                  At("4:29 Inverter", "tree.children-count")));
  write("<root BTCPP_format=\"4\"><BehaviorTree ID=\"A < B && C\"><Do a=\"&&\"></Dont></BehaviorTree></root>");
  EXPECT_THAT(MockedTree(path_).problems(), ElementsAre(At("1:67 <Do>", "tree.xml-malformed")));
  write("<root BTCPP_format=\"4\"><BehaviorTree ID=\"A < B\"><Do a=\"&&/></BehaviorTree></root>");
  EXPECT_THAT(MockedTree(path_).problems(), ElementsAre(At("1:49 <BehaviorTree>", "tree.xml-malformed")));
}

TEST_F(ForeignFile, NamesConstantsOfItsProgram) {
  writeTree("<Sequence><Script code=\"A := THE_ANSWER; color := RED\"/><Script code=\"b := unknown\"/></Sequence>");
  EXPECT_THAT(problemsOfMission().size(), 3U);
  const MockedTree tree(path_);
  EXPECT_THAT(tree.problems(), IsEmpty());
  EXPECT_THAT(tree.warnings(), ElementsAre(At("3:19 Script.code", "tree.entry-unset", "{THE_ANSWER}", "constant"),
                                           At("3:19 Script.code", "tree.entry-unset", "{RED}", "constant"),
                                           At("3:65 Script.code", "tree.entry-unset", "{unknown}", "program")));
}

TEST_F(ForeignFile, ReadsEntriesThatItsProgramSets) {
  writeTree(
      "<ReactiveSequence><ScriptCondition code=\"battery_ok\"/><Timeout msec=\"{patience}\"><Wiggle speed=\"{v}\"/>"
      "</Timeout></ReactiveSequence>");
  EXPECT_THAT(problemsOfMission().size(), 2U) << "a port of a mock may also write its entry";
  const MockedTree tree(path_);
  EXPECT_THAT(tree.problems(), IsEmpty());
  EXPECT_THAT(tree.warnings(), ElementsAre(At("3:36 ScriptCondition.code", "tree.entry-unset", "{battery_ok}"),
                                           At("3:64 Timeout.msec", "tree.entry-unset", "{patience}")));
}

TEST_F(ForeignFile, OfOurOwnLeavesAloneHasNoOtherProgram) {
  Registry ours = Registry::standard();
  ours.add({.id = "Fly", .kind = NodeKind::kAction, .ports = {{.name = "to", .type = PortType::kPoint}}},
           ours.find("AlwaysSuccess")->build);
  writeTree("<Fly to=\"{place}\"/>");
  EXPECT_THAT(MockedTree(path_, ours).problems(), ElementsAre(At("3:6 Fly.to", "tree.entry-unset", "{place}")));
}

TEST_F(ForeignFile, HasCommentsWithDashes) {
  const std::string comments =
      "<!-- ////////// -->\n<!--------------------------------------->\n<!-- then -- grasp -->\n<!--- a --->"
      "<!----><!-- - -->";
  write("<!-- first -- -->" + testing::file("<Sequence>" + comments + "<Do text=\"<!-- a -- b -->\"/></Sequence>"));
  const MockedTree tree(path_);
  EXPECT_THAT(tree.problems(), IsEmpty());
  EXPECT_THAT(tree.warnings(),
              ElementsAre(At("1:12", "tree.comment-dashes", "4, 5 and 6"), At("6:40", "tree.value-unescaped", "`<`")));
  std::string many;
  for (int i = 0; i < 13; ++i) many += "<!-- a <!-- b -->\n";
  writeTree("<Sequence>" + many + "<AlwaysSuccess/></Sequence>");
  EXPECT_THAT(MockedTree(path_).warnings(),
              ElementsAre(At("3:20", "tree.comment-nested", "4, 5, 6, 7, 8, 9, 10, 11, 12, 13 and 2 more")));
  writeTree("<Sequence>" + comments + "<AlwaysSuccess/></Sequence>");
  EXPECT_THAT(problemsOfMission(), IsEmpty()) << "in a mission, too";
  writeTree("<Sequence>" + comments + "\n<Nobody/></Sequence>");
  EXPECT_THAT(parseFile(path_, Registry::standard()).problems, ElementsAre(At("7:1 Nobody", "tree.unknown-node")));
  writeTree("<Sequence><!-- a -- b</Sequence>");
  EXPECT_THAT(problemsOfMission(), ElementsAre(At("3:11 <Sequence>", "tree.xml-malformed")));
}

TEST_F(ForeignFile, HasAttributesThatNobodyReads) {
  write(
      "<root BTCPP_format=\"4\" _favorite=\"true\" version=\"2\"><BehaviorTree ID=\"M\" _favorite=\"true\" _x=\"d\">"
      "<Do _y=\"2\"/></BehaviorTree></root>");
  EXPECT_THAT(problemsOfMission(), ElementsAre(At("1:24 root", "tree.unknown-attribute", "`_favorite`"),
                                               At("1:41 root", "tree.unknown-attribute", "`version`"),
                                               At("1:102 Do", "tree.unknown-attribute", "`_y`")));
  const MockedTree tree(path_);
  EXPECT_THAT(tree.problems(), IsEmpty());
  EXPECT_THAT(tree.warnings().size(), 3U);
}

TEST_F(ForeignFile, CallsAConditionAnAction) {
  writeTree("<Action ID=\"ScriptCondition\" code=\"true\"/>");
  EXPECT_THAT(problemsOfMission(),
              ElementsAre(At("3:1 Action", "tree.wrong-kind", "<Condition ID=\"ScriptCondition\">")));
  EXPECT_THAT(MockedTree(path_).problems(), IsEmpty());
  EXPECT_EQ(firstTick(), "SUCCESS");
}

TEST_F(ForeignFile, GivesATreeMoreThanItUses) {
  writeTree("<SubTree ID=\"Used\" more=\"1\"/>", "<BehaviorTree ID=\"Used\"><Do/></BehaviorTree>");
  EXPECT_THAT(problemsOfMission(), ElementsAre(At("3:20 SubTree", "tree.unknown-entry", "`Used`", "{more}")));
  const MockedTree tree(path_);
  EXPECT_THAT(tree.problems(), IsEmpty());
  EXPECT_THAT(tree.warnings(), ElementsAre(At("3:20 SubTree", "tree.unknown-entry", "`Used`", "{more}")));
}

TEST_F(ForeignFile, WithoutAMainTreeIsReadByTheOneThatNoOtherUses) {
  write(
      "<root BTCPP_format=\"4\"><BehaviorTree ID=\"A\"><Do/></BehaviorTree><BehaviorTree ID=\"Z\"><SubTree ID=\"A\"/>"
      "</BehaviorTree></root>");
  const MockedTree tree(path_);
  EXPECT_THAT(tree.warnings(), ElementsAre(At("1:1 root", "tree.main-missing", "main_tree_to_execute=\"Z\"")));
  EXPECT_EQ(MockedTree(path_).tick(), "SUCCESS: A SUCCESS, Do SUCCESS");
}

TEST_F(ForeignFile, HasTreesThatAreNotUsed) {
  writeTree("<SubTree ID=\"Used\"/>",
            "<BehaviorTree ID=\"Used\"><Do/></BehaviorTree>\n<BehaviorTree ID=\"Unused\"><Repeat/></BehaviorTree>\n"
            "<BehaviorTree ID=\"Itself\"><SubTree ID=\"Itself\"/></BehaviorTree>\n");
  EXPECT_THAT(problemsOfMission().size(), 3U);
  const MockedTree tree(path_);
  EXPECT_THAT(tree.problems(), IsEmpty());
  EXPECT_THAT(tree.warnings(),
              ElementsAre(At("6:27 Repeat", "tree.port-missing", "`num_cycles`"),
                          At("6:27 Repeat", "tree.children-count"), At("7:27 SubTree", "tree.contains-itself")));
  writeTree("<SubTree ID=\"Used\"/>", "<BehaviorTree ID=\"Used\"><Repeat/></BehaviorTree>\n");
  EXPECT_THAT(MockedTree(path_).problems().size(), 2U);
}

TEST_F(ForeignFile, HasElementsAndAttributesOfItsEditor) {
  writeTree(
      "<Sequence><Do _collapsed=\"true\"/><Script code=\"n := 1\" _x=\"7\"/>"
      "<SubTree ID=\"Used\" _collapsed=\"true\"/></Sequence>",
      "<BehaviorTree ID=\"Used\"><Do/></BehaviorTree>\n<Layout zoom=\"2\"/>\n");
  EXPECT_THAT(problemsOfMission().size(), 4U);
  const MockedTree tree(path_);
  EXPECT_THAT(tree.problems(), IsEmpty());
  EXPECT_THAT(tree.warnings(), ElementsAre(At("6:1 Layout", "tree.unknown-element"),
                                           At("3:15 Do", "tree.unknown-attribute", "`_collapsed`"),
                                           At("3:56 Script", "tree.unknown-attribute", "`_x`"),
                                           At("3:83 SubTree", "tree.unknown-attribute", "`_collapsed`")));
}

}  // namespace
}  // namespace swiftlet::tree

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

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::linesOf;
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

  /// Each with its place, without the name of the file.
  std::vector<std::string> shortLines(const std::vector<Problem>& problems) const {
    std::vector<std::string> lines = linesOf(problems);
    for (std::string& line : lines) line.erase(0, path_.size() + 1);
    return lines;
  }
  std::vector<std::string> problemsOfMission() const { return shortLines(parseFile(path_, withEveryName()).problems); }
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
  EXPECT_THAT(problemsOfMission(), ElementsAre(HasSubstr("malformed XML")));
  const MockedTree tree(path_);
  EXPECT_THAT(shortLines(tree.problems()), IsEmpty());
  EXPECT_THAT(shortLines(tree.warnings()),
              ElementsAre("3:40: `&` stands for itself in a value, which XML does not allow, write &amp;",
                          "4:24: `<` stands for itself in a value, which XML does not allow, write &lt;",
                          "4:54: `<` stands for itself in a value, which XML does not allow, write &lt;",
                          "4:74: `<` stands for itself in a value, which XML does not allow, write &lt;"));
  EXPECT_EQ(firstTick(), "SUCCESS");
}

TEST_F(ForeignFile, WithRawCharactersHasItsPlaces) {
  writeTree(
      "<Sequence><Script code=\"n := 1 && 2 < 3\"/><Repeat num_cycles=\"0 < 1\" num=\"<<&\" more=\"\">\n"
      "<Do a=\"&&&&\"/></Repeat> text<Inverter/></Sequence>");
  EXPECT_THAT(shortLines(MockedTree(path_).problems()),
              ElementsAre(HasSubstr("4:25: Sequence: text is not expected here"),
                          HasSubstr("3:51: Repeat.num_cycles: `0 < 1` is not a whole number"),
                          HasSubstr("3:70: Repeat: unknown port `num`"), HasSubstr("3:80: Repeat: unknown port `more`"),
                          HasSubstr("4:29: Inverter: has 0 children")));
  write("<root BTCPP_format=\"4\"><BehaviorTree ID=\"A < B && C\"><Do a=\"&&\"></Dont></BehaviorTree></root>");
  EXPECT_THAT(shortLines(MockedTree(path_).problems()), ElementsAre(HasSubstr("1:67: <Do>: malformed XML")));
  write("<root BTCPP_format=\"4\"><BehaviorTree ID=\"A < B\"><Do a=\"&&/></BehaviorTree></root>");
  EXPECT_THAT(shortLines(MockedTree(path_).problems()), ElementsAre(HasSubstr("malformed XML")));
}

TEST_F(ForeignFile, NamesConstantsOfItsProgram) {
  writeTree("<Sequence><Script code=\"A := THE_ANSWER; color := RED\"/><Script code=\"b := unknown\"/></Sequence>");
  EXPECT_THAT(problemsOfMission().size(), 3U);
  const MockedTree tree(path_);
  EXPECT_THAT(shortLines(tree.problems()), IsEmpty());
  EXPECT_THAT(shortLines(tree.warnings()),
              ElementsAre(HasSubstr("nothing sets the entry {THE_ANSWER}, unless it is a constant"),
                          HasSubstr("nothing sets the entry {RED}"),
                          HasSubstr("nothing sets the entry {unknown}, unless the program that ticks the tree does")));
}

TEST_F(ForeignFile, ReadsEntriesThatItsProgramSets) {
  writeTree(
      "<ReactiveSequence><ScriptCondition code=\"battery_ok\"/><Timeout msec=\"{patience}\"><Wiggle speed=\"{v}\"/>"
      "</Timeout></ReactiveSequence>");
  EXPECT_THAT(problemsOfMission().size(), 2U) << "a port of a mock may also write its entry";
  const MockedTree tree(path_);
  EXPECT_THAT(shortLines(tree.problems()), IsEmpty());
  EXPECT_THAT(shortLines(tree.warnings()),
              ElementsAre(HasSubstr("{battery_ok}, unless the program"), HasSubstr("{patience}, unless the program")));
}

TEST_F(ForeignFile, OfOurOwnLeavesAloneHasNoOtherProgram) {
  Registry ours = Registry::standard();
  ours.add({.id = "Fly", .kind = NodeKind::kAction, .ports = {{.name = "to", .type = PortType::kPoint}}},
           ours.find("AlwaysSuccess")->build);
  writeTree("<Fly to=\"{place}\"/>");
  EXPECT_THAT(shortLines(MockedTree(path_, ours).problems()), ElementsAre(HasSubstr("nothing sets the entry {place}")));
}

TEST_F(ForeignFile, HasCommentsWithDashes) {
  const std::string comments =
      "<!-- ////////// -->\n<!--------------------------------------->\n<!-- then -- grasp -->\n<!--- a --->"
      "<!----><!-- - -->";
  write("<!-- first -- -->" + testing::file("<Sequence>" + comments + "<Do text=\"<!-- a -- b -->\"/></Sequence>"));
  const MockedTree tree(path_);
  EXPECT_THAT(shortLines(tree.problems()), IsEmpty());
  EXPECT_THAT(shortLines(tree.warnings()),
              ElementsAre("1:12: `--` stands in a comment, which XML does not allow; also in line 4, 5 and 6, write "
                          "<!-- == text == -->",
                          HasSubstr("6:40: `<` stands for itself")));
  std::string many;
  for (int i = 0; i < 13; ++i) many += "<!-- a <!-- b -->\n";
  writeTree("<Sequence>" + many + "<AlwaysSuccess/></Sequence>");
  EXPECT_THAT(
      shortLines(MockedTree(path_).warnings()),
      ElementsAre(HasSubstr("; also in line 4, 5, 6, 7, 8, 9, 10, 11, 12, 13 and 2 more, take the inner <!--")));
  writeTree("<Sequence>" + comments + "<AlwaysSuccess/></Sequence>");
  EXPECT_THAT(problemsOfMission(), IsEmpty()) << "in a mission, too";
  writeTree("<Sequence>" + comments + "\n<Nobody/></Sequence>");
  EXPECT_THAT(shortLines(parseFile(path_, Registry::standard()).problems), ElementsAre(HasSubstr("7:1: Nobody")));
  writeTree("<Sequence><!-- a -- b</Sequence>");
  EXPECT_THAT(problemsOfMission(), ElementsAre(HasSubstr("3:11: <Sequence>: malformed XML: unclosed token")));
}

TEST_F(ForeignFile, HasAttributesThatNobodyReads) {
  write(
      "<root BTCPP_format=\"4\" _favorite=\"true\" version=\"2\"><BehaviorTree ID=\"M\" _favorite=\"true\" _x=\"d\">"
      "<Do _y=\"2\"/></BehaviorTree></root>");
  EXPECT_THAT(problemsOfMission(),
              ElementsAre(HasSubstr("root: unknown attribute `_favorite`"), HasSubstr("unknown attribute `version`"),
                          HasSubstr("Do: unknown attribute `_y`")));
  const MockedTree tree(path_);
  EXPECT_THAT(shortLines(tree.problems()), IsEmpty());
  EXPECT_THAT(tree.warnings().size(), 3U);
}

TEST_F(ForeignFile, CallsAConditionAnAction) {
  writeTree("<Action ID=\"ScriptCondition\" code=\"true\"/>");
  EXPECT_THAT(problemsOfMission(), ElementsAre(HasSubstr("write <Condition ID=\"ScriptCondition\">")));
  EXPECT_THAT(shortLines(MockedTree(path_).problems()), IsEmpty());
  EXPECT_EQ(firstTick(), "SUCCESS");
}

TEST_F(ForeignFile, GivesATreeMoreThanItUses) {
  writeTree("<SubTree ID=\"Used\" more=\"1\"/>", "<BehaviorTree ID=\"Used\"><Do/></BehaviorTree>");
  EXPECT_THAT(problemsOfMission(), ElementsAre(HasSubstr("the tree `Used` has no entry {more}")));
  const MockedTree tree(path_);
  EXPECT_THAT(shortLines(tree.problems()), IsEmpty());
  EXPECT_THAT(shortLines(tree.warnings()), ElementsAre(HasSubstr("the tree `Used` has no entry {more}")));
}

TEST_F(ForeignFile, WithoutAMainTreeIsReadByTheOneThatNoOtherUses) {
  write(
      "<root BTCPP_format=\"4\"><BehaviorTree ID=\"A\"><Do/></BehaviorTree><BehaviorTree ID=\"Z\"><SubTree ID=\"A\"/>"
      "</BehaviorTree></root>");
  const MockedTree tree(path_);
  EXPECT_THAT(shortLines(tree.warnings()), ElementsAre(HasSubstr("write main_tree_to_execute=\"Z\"")));
  EXPECT_EQ(MockedTree(path_).tick(), "SUCCESS: A SUCCESS, Do SUCCESS");
}

TEST_F(ForeignFile, HasTreesThatAreNotUsed) {
  writeTree("<SubTree ID=\"Used\"/>",
            "<BehaviorTree ID=\"Used\"><Do/></BehaviorTree>\n<BehaviorTree ID=\"Unused\"><Repeat/></BehaviorTree>\n"
            "<BehaviorTree ID=\"Itself\"><SubTree ID=\"Itself\"/></BehaviorTree>\n");
  EXPECT_THAT(problemsOfMission().size(), 3U);
  const MockedTree tree(path_);
  EXPECT_THAT(shortLines(tree.problems()), IsEmpty());
  EXPECT_THAT(shortLines(tree.warnings()),
              ElementsAre(HasSubstr("Repeat: port `num_cycles` is missing"), HasSubstr("Repeat: has 0 children"),
                          HasSubstr("the tree contains itself")));
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
  EXPECT_THAT(shortLines(tree.problems()), IsEmpty());
  EXPECT_THAT(
      shortLines(tree.warnings()),
      ElementsAre(HasSubstr("6:1: Layout: unknown element"), HasSubstr("Do: unknown attribute `_collapsed`"),
                  HasSubstr("Script: unknown attribute `_x`"), HasSubstr("SubTree: unknown attribute `_collapsed`")));
}

}  // namespace
}  // namespace swiftlet::tree

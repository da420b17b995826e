// Files without BTCPP_format, files of version 3, and what becomes of them.
#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "behaviors/tree/migrate.hpp"
#include "behaviors/tree/mocks.hpp"
#include "tests/support/datasets.hpp"
#include "tests/support/scratch.hpp"
#include "tests/tree/story.hpp"

namespace swiftlet::tree::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

ParseResult treeOf(const std::string& text) {
  static const Registry kRegistry = Registry::standard();
  return parseText(text, "f.xml", kRegistry);
}

std::string migrated(const std::string& text) {
  const Migration migration = migrateToVersion4(text, "f.xml");
  EXPECT_THAT(migration.problems, IsEmpty());
  return migration.text;
}

TEST(WithoutFormat, AFileOfVersion4IsReadWithAWarning) {
  const ParseResult result = treeOf(
      "<root>\n<BehaviorTree ID=\"M\"><SequenceWithMemory><AlwaysSuccess "
      "_skipIf=\"false\"/></SequenceWithMemory></BehaviorTree></root>");
  EXPECT_TRUE(result.tree.has_value()) << toString(result.problems);
  EXPECT_THAT(result.warnings, ElementsAre(At("1:1 root", "tree.format-assumed")));
}

TEST(WithoutFormat, AFileThatBothVersionsReadAlikeIsReadWithAWarning) {
  const ParseResult result =
      treeOf("<root><BehaviorTree ID=\"M\"><Sequence><AlwaysSuccess/></Sequence></BehaviorTree></root>");
  EXPECT_TRUE(result.tree.has_value()) << toString(result.problems);
  EXPECT_THAT(result.warnings, ElementsAre(At("1:1 root", "tree.format-assumed", "3")));
}

TEST(WithoutFormat, AFileOfVersion4WithTheFormatHasNoWarning) {
  EXPECT_THAT(treeOf(file("<AlwaysSuccess/>")).warnings, IsEmpty());
}

TEST(WithoutFormat, AFileOfVersion3SaysWhatToChange) {
  const ParseResult result = treeOf(
      "<root>\n<BehaviorTree ID=\"M\">\n<SequenceStar>\n<Parallel threshold=\"1\"><AlwaysSuccess/></Parallel>\n"
      "</SequenceStar></BehaviorTree></root>");
  EXPECT_FALSE(result.tree.has_value());
  EXPECT_THAT(result.problems, ElementsAre(At("1:1 root", "tree.format-missing", "`swiftlet migrate f.xml`"),
                                           At("3:1 SequenceStar", "tree.version-3", "`SequenceWithMemory`"),
                                           At("4:11 Parallel", "tree.version-3", "`threshold`", "`success_count`")));
}

TEST(WithoutFormat, AnAttributeThatTheVersionsReadDifferentlyIsNotGuessed) {
  const std::string sub = "<BehaviorTree ID=\"S\"><AlwaysSuccess/></BehaviorTree>";
  const std::string use = "<root main_tree_to_execute=\"M\"><BehaviorTree ID=\"M\"><SubTree ID=\"S\" at=\"door\"/>";
  const ParseResult unclear = treeOf(use + "</BehaviorTree>" + sub + "</root>");
  EXPECT_FALSE(unclear.tree.has_value());
  EXPECT_THAT(unclear.problems, ElementsAre(At("1:1 root", "tree.format-missing"),
                                            At("1:69 SubTree", "tree.version-3-entry", "{door}", "`door`")));
  // A node of version 4 beside it decides.
  const std::string decided =
      "<root main_tree_to_execute=\"M\"><BehaviorTree ID=\"M\"><Sequence><SubTree ID=\"S\" "
      "at=\"1;2\"/><Script code=\"a := 1\"/></Sequence></BehaviorTree>"
      "<BehaviorTree ID=\"S\"><SetBlackboard value=\"{at}\" output_key=\"x\"/></BehaviorTree>"
      "</root>";
  EXPECT_TRUE(treeOf(decided).tree.has_value()) << toString(treeOf(decided).problems);
}

TEST(Migrate, KeepsCommentsAndLayout) {
  EXPECT_EQ(migrated("<?xml version=\"1.0\"?>\n<!-- by hand -->\n<root main_tree_to_execute = 'M'>\n"
                     "  <BehaviorTree ID=\"M\">\n    <SequenceStar   name=\"s\" > <!-- SequenceStar -->\n"
                     "      <RetryUntilSuccesful num_attempts='2'\n          ><AlwaysSuccess/></RetryUntilSuccesful>\n"
                     "    </SequenceStar >\n  </BehaviorTree>\n</root>\n"),
            "<?xml version=\"1.0\"?>\n<!-- by hand -->\n<root BTCPP_format=\"4\" main_tree_to_execute = 'M'>\n"
            "  <BehaviorTree ID=\"M\">\n    <SequenceWithMemory   name=\"s\" > <!-- SequenceStar -->\n"
            "      <RetryUntilSuccessful num_attempts='2'\n          ><AlwaysSuccess/></RetryUntilSuccessful>\n"
            "    </SequenceWithMemory >\n  </BehaviorTree>\n</root>\n");
}

TEST(Migrate, RewritesSubTrees) {
  const auto inside = [](const std::string& text) {
    const std::string whole = migrated("<root BTCPP_format=\"3\">" + text + "</root>");
    const std::size_t head = std::string("<root BTCPP_format=\"4\">").size();
    return whole.substr(head, whole.size() - head - std::string("</root>").size());
  };
  const std::string open = "<BehaviorTree ID=\"M\">", tail = "</BehaviorTree>";
  EXPECT_EQ(inside(open + "<SubTree ID=\"S\" name=\"n\" at=\"door\" to='{x}'/>" + tail),
            open + "<SubTree ID=\"S\" name=\"n\" at=\"{door}\" to='{x}'/>" + tail);
  EXPECT_EQ(inside(open + "<SubTree ID=\"S\" __shared_blackboard=\"true\"/>" + tail),
            open + "<SubTree ID=\"S\" _autoremap=\"true\"/>" + tail);
  EXPECT_EQ(inside(open + "<SubTreePlus ID=\"S\" at=\"1;2\" __autoremap='1'></SubTreePlus>" + tail),
            open + "<SubTree ID=\"S\" at=\"1;2\" _autoremap='1'></SubTree>" + tail);
  EXPECT_EQ(inside(open + "<SubTree ID=\"S\">\n <remap internal=\"at\" external=\"door\"/>\n</SubTree>" + tail),
            open + "<SubTree at=\"{door}\" ID=\"S\">\n</SubTree>" + tail);
  EXPECT_EQ(inside(open + "<SubTree ID=\"S\"><remap internal=\"a\" external=\"b\"/></SubTree>" + tail),
            open + "<SubTree a=\"{b}\" ID=\"S\"></SubTree>" + tail)
      << "the closing tag right behind the last child is not that of the child";
}

TEST(Migrate, TurnsChecksOfEntriesIntoPreconditions) {
  const std::string text = migrated(
      "<root><BehaviorTree ID=\"M\"><Sequence>"
      "<BlackboardCheckInt value_A=\"{n}\" value_B=\"3\" return_on_mismatch=\"SUCCESS\"><AlwaysSuccess/>"
      "</BlackboardCheckInt><Decorator ID=\"BlackboardCheckString\" return_on_mismatch=\"\" value_B=\"a\" "
      "value_A=\"{w}\"><AlwaysSuccess/></Decorator></Sequence></BehaviorTree></root>");
  EXPECT_THAT(text, HasSubstr("<Precondition if=\"n == 3\" else=\"SUCCESS\"><AlwaysSuccess/></Precondition>"));
  EXPECT_THAT(text, HasSubstr("<Decorator ID=\"Precondition\" if=\"w == &apos;a&apos;\"><AlwaysSuccess/>"));
}

TEST(Migrate, TheResultIsReadAndActsAsVersion3Did) {
  // A SubTree of version 3 is given the entry `door` by its name.
  const std::string old =
      "<root main_tree_to_execute=\"M\"><BehaviorTree ID=\"M\"><SequenceStar>"
      "<SetBlackboard value=\"5\" output_key=\"door\"/><SubTree ID=\"S\" at=\"door\"/></SequenceStar></BehaviorTree>"
      "<BehaviorTree ID=\"S\"><BlackboardCheckInt value_A=\"{at}\" value_B=\"5\" "
      "return_on_mismatch=\"FAILURE\"><AlwaysSuccess/></BlackboardCheckInt></BehaviorTree></root>";
  ParseResult result = treeOf(migrated(old));
  ASSERT_TRUE(result.tree.has_value()) << toString(result.problems);
  EXPECT_THAT(result.warnings, IsEmpty());
  TickContext context;
  EXPECT_EQ(result.tree->tick(context), Status::kRunning) << "no two children of the sequence start in one tick";
  EXPECT_EQ(result.tree->tick(context), Status::kSuccess);
}

TEST(Migrate, AFileOfVersion4StaysAsItIs) {
  const std::string text = "<root BTCPP_format=\"4\"><BehaviorTree ID=\"SequenceStar\"/></root>";
  const Migration migration = migrateToVersion4(text, "f.xml");
  EXPECT_EQ(migration.text, text);
  EXPECT_THAT(migration.changes, IsEmpty());
}

TEST(Migrate, RefusesWhatIsNoTreeOrOfAnotherVersion) {
  const auto problemsOf = [](const char* text) { return migrateToVersion4(text, "f.xml").problems; };
  EXPECT_THAT(problemsOf("<root>"), ElementsAre(At("1:7 <root>", "tree.xml-malformed")));
  EXPECT_THAT(problemsOf("<tree/>"), ElementsAre(At("1:1 tree", "tree.outermost-element")));
  EXPECT_THAT(problemsOf("<root BTCPP_format=\"5\"/>"),
              ElementsAre(At("1:7 root", "tree.other-format", "\"5\"", "\"3\"")));
}

std::string checkOf(const std::string& kind, const std::string& a, const std::string& b) {
  return "<root><BehaviorTree ID=\"M\"><BlackboardCheck" + kind + " value_A=\"" + a + "\" value_B=\"" + b +
         "\" return_on_mismatch=\"FAILURE\"><AlwaysSuccess/></BlackboardCheck" + kind + "></BehaviorTree></root>";
}

TEST(Migrate, ATextWithAnApostropheStaysOne) {
  const std::string check = checkOf("String", "{w}", "it's &quot;so&quot;");
  std::string text = migrated(check);
  text.replace(text.find("<AlwaysSuccess/>"), 16, "<Script code=\"seen := true\"/>");
  text.insert(text.find("<Precondition"), "<Sequence><SetBlackboard output_key=\"w\" value=\"it's &quot;so&quot;\"/>");
  text.insert(text.find("</BehaviorTree>"), "</Sequence>");
  ParseResult result = treeOf(text);
  ASSERT_TRUE(result.tree.has_value()) << text << toString(result.problems);
  TickContext context;
  EXPECT_EQ(result.tree->tick(context), Status::kSuccess);
}

TEST(Migrate, RefusesWhatNoScriptCanHold) {
  const auto problemsOf = [](const std::string& text) { return migrateToVersion4(text, "f.xml").problems; };
  EXPECT_THAT(problemsOf(checkOf("Int", "{my-count}", "3")),
              ElementsAre(At("1:28 BlackboardCheckInt", "tree.version-3")));
  EXPECT_THAT(problemsOf(checkOf("Double", "{x}", "three")),
              ElementsAre(At("1:28 BlackboardCheckDouble", "tree.version-3")));
  EXPECT_THAT(problemsOf(checkOf("Bool", "{x}", "true")), IsEmpty());
}

TEST(Migrate, RefusesNamesThatCannotBeAttributes) {
  for (const char* inside : {"<SubTree ID=\"S\"><remap internal=\"*\" external=\"b\"/></SubTree>",
                             "<SubTree ID=\"S\" a=\"x\"><remap internal=\"a\" external=\"b\"/></SubTree>",
                             "<Parallel threshold=\"1\" success_threshold=\"1\"><AlwaysSuccess/></Parallel>"}) {
    const Migration migration =
        migrateToVersion4("<root><BehaviorTree ID=\"M\">" + std::string(inside) + "</BehaviorTree></root>", "f.xml");
    EXPECT_EQ(migration.text, "") << inside;
    EXPECT_THAT(migration.problems, ElementsAre(At("1:1 root", "tree.rewritten-malformed"))) << inside;
  }
}

class MigratedFiles : public test_support::Scratch {};

TEST_F(MigratedFiles, OfOtherProjectsAreReadWithMocks) {
  const auto folder = test_support::dataSet("08-behavior-trees");
  if (!folder) return;
  int count = 0;
  for (const char* name : {"groot/simple_without_model.xml", "groot/show_all.xml", "aerostack2/basic_mission.xml",
                           "groot/crossdoor_with_subtree.xml", "groot/Simple.xml"}) {
    const std::string before = test_support::readText(*folder / name);
    const Migration migration = migrateToVersion4(before, name);
    ASSERT_THAT(migration.problems, IsEmpty());
    EXPECT_GE(migration.changes.size(), 1U) << name;
    const std::string path = write("mission.xml", migration.text);
    const MockedRegistry mocked = withMocks(path, Registry::standard());
    ParseResult result = parseFile(path, mocked.registry);
    // Groot's showcase leaves the key of a SetBlackboard empty.
    if (std::string(name) == "groot/show_all.xml") {
      for (const Problem& problem : result.problems)
        EXPECT_EQ(problem.message.text(), "port `output_key` is empty, expected an entry") << name;
      continue;
    }
    ASSERT_TRUE(result.tree.has_value()) << name << "\n" << toString(result.problems);
    EXPECT_THAT(result.warnings, IsEmpty());
    TickContext context;
    EXPECT_NE(result.tree->tick(context), Status::kSkipped) << name;
    ++count;
  }
  EXPECT_EQ(count, 4);
}

}  // namespace
}  // namespace swiftlet::tree::testing

// Files that belong together though none includes another, as those of a program that registers all of a folder.
#include <map>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "behaviors/tree/documents.hpp"
#include "behaviors/tree/parser.hpp"
#include "tests/support/scratch.hpp"
#include "tests/tree/story.hpp"

namespace swiftlet::tree::testing {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::string oneTree(const std::string& id, const std::string& inside, const std::string& root = {}) {
  return "<root BTCPP_format=\"4\" " + root + "><BehaviorTree ID=\"" + id + "\">" + inside + "</BehaviorTree></root>";
}
std::string uses(const std::string& id) { return "<SubTree ID=\"" + id + "\"/>"; }

class Elsewhere : public ::testing::Test {
 protected:
  ParseResult read(const std::string& main, bool lenient = true) {
    ParseOptions options;
    options.lenient = lenient;
    options.trees_elsewhere = trees_;
    options.read_file = [this](const std::string& path) -> std::optional<std::string> {
      const auto found = files_.find(path);
      return found == files_.end() ? std::nullopt : std::optional(found->second);
    };
    return parseFile(main, Registry::standard(), options);
  }
  void add(const std::string& file, const std::string& id, const std::string& text) {
    files_[file] = text;
    trees_.trees[id].push_back(file);
  }

  std::map<std::string, std::string> files_;
  TreeFiles trees_;
};

TEST_F(Elsewhere, TreesAreFoundThatAreUsedDirectlyOrNot) {
  add("d/a.xml", "A", oneTree("A", uses("B")));
  add("d/b.xml", "B", oneTree("B", uses("C")));
  add("d/c.xml", "C", oneTree("C", "<AlwaysSuccess/>"));
  add("d/broken.xml", "D", "<root>");
  const ParseResult result = read("d/a.xml");
  EXPECT_THAT(result.problems, IsEmpty());
  EXPECT_THAT(result.warnings, IsEmpty());
  ASSERT_TRUE(result.tree);
  EXPECT_EQ(result.tree->nodes().size(), 3U);
}

TEST_F(Elsewhere, TheMainTreeMayBe) {
  add("a.xml", "A", oneTree("A", "<AlwaysFailure/>", "main_tree_to_execute=\"B\""));
  add("b.xml", "B", oneTree("B", "<AlwaysSuccess/>"));
  const ParseResult result = read("a.xml");
  ASSERT_TRUE(result.tree) << toString(result.problems);
  EXPECT_EQ(result.tree->name(), "B");
}

TEST_F(Elsewhere, TheTreeOfTheOwnFolderComesFirst) {
  add("far/b.xml", "B", oneTree("B", "<AlwaysFailure/>"));
  add("near/b.xml", "B", oneTree("B", "<AlwaysSuccess/>"));
  add("near/a.xml", "A", oneTree("A", uses("B")));
  ParseResult result = read("near/a.xml");
  ASSERT_TRUE(result.tree) << toString(result.problems);
  TickContext context;
  EXPECT_EQ(result.tree->tick(context), Status::kSuccess);
}

TEST_F(Elsewhere, OnlyWhatIsUsedIsJudged) {
  files_["b.xml"] =
      "<root BTCPP_format=\"4\"><BehaviorTree ID=\"B\"><AlwaysSuccess/></BehaviorTree>"
      "<BehaviorTree ID=\"A\"><Nobody/></BehaviorTree><BehaviorTree ID=\"Other\"><Nobody/></BehaviorTree></root>";
  trees_.trees["B"] = {"b.xml"};
  add("a.xml", "A", oneTree("A", uses("B")));
  const ParseResult result = read("a.xml");
  EXPECT_THAT(result.problems, IsEmpty());
  EXPECT_THAT(result.warnings, IsEmpty());
}

TEST_F(Elsewhere, TreesThatContainEachOtherAreTold) {
  add("a.xml", "A", oneTree("A", uses("B")));
  add("b.xml", "B", oneTree("B", uses("A")));
  EXPECT_THAT(read("a.xml").problems, ElementsAre(At("1:46 SubTree", "tree.contains-itself", "A -> B -> A")));
}

TEST_F(Elsewhere, AMissionIsToldWhatToInclude) {
  add("d/a.xml", "A", oneTree("A", uses("B")));
  add("d/sub/b.xml", "B", oneTree("B", "<AlwaysSuccess/>"));
  const auto missing = [](const char* remedy) {
    return ElementsAre(At("d/a.xml:1:55 SubTree", "tree.unknown-tree", "\"B\"", remedy));
  };
  EXPECT_THAT(read("d/a.xml", false).problems, missing("<include path=\"sub/b.xml\"/>"));
  trees_.trees.clear();
  EXPECT_THAT(read("d/a.xml", false).problems, missing("<include path=\"OTHER.xml\"/>"));
  EXPECT_THAT(read("d/a.xml").problems, missing("check --mock-leaves d/a.xml OTHER.xml"));
}

TEST(MainTree, IsTheOneThatNoOtherUses) {
  const auto treeWith = [](const std::string& id, const std::string& used) {
    return "<BehaviorTree ID=\"" + id + "\">" + (used.empty() ? "<AlwaysSuccess/>" : "<SubTree ID=\"" + used + "\"/>") +
           "</BehaviorTree>";
  };
  const auto hintFor = [](const std::string& root, const std::string& trees) {
    const std::string text = "<root BTCPP_format=\"4\" " + root + ">" + trees +
                             "<TreeNodesModel><SubTree ID=\"Tour\"/></TreeNodesModel></root>";
    return parseText(text, "f.xml", Registry::standard()).problems.at(0).hint;
  };
  const std::string trees = treeWith("Alpha", "") + treeWith("Beta", "Alpha") + treeWith("Tour", "Beta");
  for (const char* root : {"", "main_tree_to_execute=\"\"", "main_tree_to_execute=\"Elsewhere\""})
    EXPECT_THAT(hintFor(root, trees), HasSubstr("main_tree_to_execute=\"Tour\""));
  EXPECT_THAT(hintFor("", treeWith("Z", "Y") + treeWith("X", "Y") + treeWith("Y", "")),
              AllOf(HasSubstr("main_tree_to_execute=\"Z\""), HasSubstr("`X`")))
      << "in the order of the file";
}

class TreeFilesOfDisk : public test_support::Scratch {};

TEST_F(TreeFilesOfDisk, TellWhichFileHelpsAnother) {
  const std::string a = write("a.xml", oneTree("A", uses("B"), "main_tree_to_execute=\"A\""));
  const std::string b = write("b.xml", oneTree("B", uses("C")));
  const std::string c = write("c.xml", oneTree("C", "<AlwaysSuccess/>", "main_tree_to_execute=\"C\""));
  const std::string d = write("d.xml", oneTree("D", uses("D")));
  const TreeFiles together = treeFiles({a, b, c, d, a});
  EXPECT_THAT(together.helpers, ElementsAre(b, c));
  EXPECT_THAT(together.warnings, IsEmpty());
}

}  // namespace
}  // namespace swiftlet::tree::testing

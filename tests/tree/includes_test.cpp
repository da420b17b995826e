// Files that include files.
#include <filesystem>
#include <fstream>
#include <map>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "behaviors/tree/parser.hpp"
#include "tests/tree/problem_matcher.hpp"

namespace swiftlet::tree {
namespace {

using testing::At;
using ::testing::ElementsAre;

using Files = std::map<std::string, std::string>;

ParseResult parseWith(const Files& files, const std::string& main, const Registry& registry) {
  ParseOptions options;
  options.read_file = [&files](const std::string& path) -> std::optional<std::string> {
    const auto found = files.find(path);
    return found == files.end() ? std::nullopt : std::optional(found->second);
  };
  return parseFile(main, registry, options);
}

std::vector<Problem> problemsOf(const Files& files, const std::string& main = "dir/main.xml") {
  const Registry registry = Registry::standard();
  return parseWith(files, main, registry).problems;
}

std::string tree(const std::string& id, const std::string& inside, const std::string& include = {}) {
  return "<root BTCPP_format=\"4\" main_tree_to_execute=\"" + id + "\">\n" +
         (include.empty() ? std::string() : "<include path=\"" + include + "\"/>\n") + "<BehaviorTree ID=\"" + id +
         "\">" + inside + "</BehaviorTree></root>";
}

TEST(Includes, AreFoundBesideTheFileThatIncludesThem) {
  const Files files = {{"dir/main.xml", tree("Main", "<SubTree ID=\"Sub\"/>", "sub/a.xml")},
                       {"dir/sub/a.xml", tree("Sub", "<SubTree ID=\"Deep\"/>", "../b.xml")},
                       {"dir/b.xml", tree("Deep", "<AlwaysSuccess/>")}};
  const Registry registry = Registry::standard();
  ParseResult result = parseWith(files, "dir/main.xml", registry);
  ASSERT_TRUE(result.tree) << toString(result.problems);
  EXPECT_EQ(result.tree->name(), "Main");
  TickContext context;
  EXPECT_EQ(result.tree->tick(context), Status::kSuccess);
}

TEST(Includes, ReadTheSameFileOnce) {
  EXPECT_THAT(problemsOf({{"dir/main.xml",
                           "<root BTCPP_format=\"4\" main_tree_to_execute=\"M\"><include path=\"a.xml\"/><include "
                           "path=\"./a.xml\"/><BehaviorTree ID=\"M\"><SubTree ID=\"A\"/></BehaviorTree></root>"},
                          {"dir/a.xml", tree("A", "<AlwaysSuccess/>")}}),
              ElementsAre());
}

TEST(Includes, OfEachOtherAreRefused) {
  EXPECT_THAT(
      problemsOf({{"dir/main.xml", tree("Main", "<AlwaysSuccess/>", "a.xml")},
                  {"dir/a.xml", tree("A", "<AlwaysSuccess/>", "../dir/main.xml")}}),
      ElementsAre(At("dir/a.xml:2:1 include", "tree.include-cycle", "dir/main.xml -> dir/a.xml -> dir/main.xml")));
}

TEST(Includes, OfMissingFilesAreRefused) {
  EXPECT_THAT(problemsOf({{"dir/main.xml", tree("Main", "<AlwaysSuccess/>", "nope.xml")}}),
              ElementsAre(At("dir/main.xml:2:10 include", "tree.include-unreadable", "`dir/nope.xml`")));
  EXPECT_THAT(problemsOf({}), ElementsAre(At("dir/main.xml", "tree.file-unreadable")));
}

TEST(Includes, NameTheFileOfEachProblem) {
  EXPECT_THAT(
      problemsOf({{"dir/main.xml", tree("Main", "<SubTree ID=\"A\"/>", "a.xml")}, {"dir/a.xml", tree("A", "<Nope/>")}}),
      ElementsAre(At("dir/a.xml:2:22 Nope", "tree.unknown-node")));
}

TEST(Includes, WithTheSameTreeIdAreRefused) {
  EXPECT_THAT(problemsOf({{"dir/main.xml", tree("A", "<AlwaysSuccess/>", "a.xml")},
                          {"dir/a.xml", tree("A", "<AlwaysSuccess/>")}}),
              ElementsAre(At("dir/main.xml:3:1 BehaviorTree", "tree.defined-twice", "dir/a.xml:2:1")));
}

TEST(Includes, OfTooManyFilesAreRefused) {
  Files files;
  for (int i = 0; i < 100; ++i)
    files["dir/" + std::to_string(i) + ".xml"] =
        tree("T" + std::to_string(i), "<AlwaysSuccess/>", std::to_string(i + 1) + ".xml");
  EXPECT_THAT(problemsOf(files, "dir/0.xml"), ElementsAre(At("2:1 include", "tree.files-many", "64")));
}

TEST(Files, ThatAreNotRegularFilesCannotBeRead) {
  const Registry registry = Registry::standard();
  for (const char* path : {"/", "/dev/zero", "/nonexistent.xml"})
    EXPECT_THAT(parseFile(path, registry).problems, ElementsAre(At(path, "tree.file-unreadable")));
}

}  // namespace
}  // namespace swiftlet::tree

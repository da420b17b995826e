// Files that include files.
#include <filesystem>
#include <fstream>
#include <map>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "behaviors/tree/parser.hpp"

namespace swiftlet::tree {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

using Files = std::map<std::string, std::string>;

ParseResult parseWith(const Files& files, const std::string& main, const Registry& registry) {
  ParseOptions options;
  options.read_file = [&files](const std::string& path) -> std::optional<std::string> {
    const auto found = files.find(path);
    return found == files.end() ? std::nullopt : std::optional(found->second);
  };
  return parseFile(main, registry, options);
}

std::vector<std::string> problemsOf(const Files& files, const std::string& main = "dir/main.xml") {
  const Registry registry = Registry::standard();
  std::vector<std::string> lines;
  for (const Problem& problem : parseWith(files, main, registry).problems) lines.push_back(toString(problem));
  return lines;
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
      ElementsAre("dir/a.xml:2:1: include: files include each other: dir/main.xml -> dir/a.xml -> dir/main.xml, take "
                  "this one out"));
}

TEST(Includes, OfMissingFilesAreRefused) {
  EXPECT_THAT(problemsOf({{"dir/main.xml", tree("Main", "<AlwaysSuccess/>", "nope.xml")}}),
              ElementsAre("dir/main.xml:2:10: include: `dir/nope.xml` cannot be read, a path begins at the folder "
                          "of the file that includes"));
  EXPECT_THAT(problemsOf({}), ElementsAre("dir/main.xml: cannot be read"));
}

TEST(Includes, NameTheFileOfEachProblem) {
  EXPECT_THAT(
      problemsOf({{"dir/main.xml", tree("Main", "<SubTree ID=\"A\"/>", "a.xml")}, {"dir/a.xml", tree("A", "<Nope/>")}}),
      ElementsAre(HasSubstr("dir/a.xml:2:22: Nope: unknown node")));
}

TEST(Includes, WithTheSameTreeIdAreRefused) {
  EXPECT_THAT(problemsOf({{"dir/main.xml", tree("A", "<AlwaysSuccess/>", "a.xml")},
                          {"dir/a.xml", tree("A", "<AlwaysSuccess/>")}}),
              ElementsAre("dir/main.xml:3:1: BehaviorTree: `A` is defined twice, first at dir/a.xml:2:1, give "
                          "one of them another ID"));
}

TEST(Includes, OfTooManyFilesAreRefused) {
  Files files;
  for (int i = 0; i < 100; ++i)
    files["dir/" + std::to_string(i) + ".xml"] =
        tree("T" + std::to_string(i), "<AlwaysSuccess/>", std::to_string(i + 1) + ".xml");
  EXPECT_THAT(problemsOf(files, "dir/0.xml"), ElementsAre(HasSubstr("more than 64 files")));
}

TEST(Files, ThatAreNotRegularFilesCannotBeRead) {
  const Registry registry = Registry::standard();
  for (const char* path : {"/", "/dev/zero", "/nonexistent.xml"})
    EXPECT_EQ(toString(parseFile(path, registry).problems), std::string(path) + ": cannot be read\n");
}

}  // namespace
}  // namespace swiftlet::tree

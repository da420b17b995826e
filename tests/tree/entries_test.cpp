// What is known of entries before the first tick: who sets them, and to which texts.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/tree/story.hpp"

namespace swiftlet::tree::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

Registry goalRegistry() {
  Registry registry = Registry::standard();
  registry.add({.id = "Fly", .kind = NodeKind::kAction, .ports = {{.name = "goal", .type = PortType::kPoint}}},
               registry.find("AlwaysSuccess")->build);
  return registry;
}

ParseResult withEntries(const std::string& inside) {
  static const Registry kRegistry = goalRegistry();
  return parseText(file(inside), "f.xml", kRegistry);
}
std::vector<Problem> entryProblems(const std::string& inside) { return withEntries(inside).problems; }

TEST(Entries, ThatAreOnlyUnsetAreNotSet) {
  EXPECT_THAT(entryProblems("<Sequence><UnsetBlackboard key=\"k\"/><Script code=\"x := k\"/></Sequence>"),
              ElementsAre(At("3:45 Script.code", "tree.entry-unset", "{k}")));
  EXPECT_THAT(entryProblems("<Sequence><Script code=\"k := 1\"/><UnsetBlackboard key=\"k\"/><Script code=\"x := k\"/>"
                            "</Sequence>"),
              IsEmpty());
}

TEST(Entries, ThatAreOnlyChangedAreMadeByAColon) {
  const auto problem = [](const std::string& code) { return entryProblems("<Script code=\"" + code + "\"/>"); };
  const auto made = [](const char* by) { return ElementsAre(At("3:9 Script.code", "tree.entry-unset", "{x}", by)); };
  EXPECT_THAT(problem("x = 1"), made("x := 1"));
  EXPECT_THAT(problem("x = true"), made("x := true"));
  EXPECT_THAT(problem("x = 'open'"), made("x := 'open'"));
  EXPECT_THAT(problem("x += 1"), made("x := ..."));
  EXPECT_THAT(problem("x := 1; x = 2"), IsEmpty());
  EXPECT_EQ(problem("y := x").at(0).hint, "");
}

TEST(Entries, ThatAreUnsetHaveNoValueThatIsKnown) {
  const auto knows = [](const std::string& more) {
    const ParseResult result = withEntries("<Sequence><SetBlackboard value=\"0\" output_key=\"n\"/>" + more +
                                           "<Repeat num_cycles=\"{n}\"><AlwaysSuccess/></Repeat></Sequence>");
    const int repeat = static_cast<int>(result.tree->nodes().size()) - 2;
    EXPECT_EQ(result.tree->knownValues(repeat, "num_cycles").size(), 1U);
    return result.tree->knowsEveryValue(repeat, "num_cycles");
  };
  EXPECT_TRUE(knows(""));
  EXPECT_TRUE(knows("<SetBlackboard value=\"0\" output_key=\"n\"/>"));
  EXPECT_FALSE(knows("<UnsetBlackboard key=\"n\"/>"));
}

TEST(Entries, AreUnsetOnlyInTheTreeThatHasThem) {
  const auto after = [](const std::string& attributes, const std::string& key) {
    return Story("<Sequence><Script code=\"k := 1\"/><SubTree ID=\"S\"" + attributes +
                     "/><ScriptCondition code=\"k == 1\"/></Sequence>",
                 "<BehaviorTree ID=\"S\"><Sequence><UnsetBlackboard key=\"" + key + "\"/><ScriptCondition code=\"" +
                     key + " == 1\"/></Sequence></BehaviorTree>")
        .tick();
  };
  EXPECT_EQ(after(" n=\"{k}\"", "n"), "SUCCESS") << "a mapped name";
  EXPECT_EQ(after(" _autoremap=\"true\"", "k"), "SUCCESS");
  EXPECT_EQ(after("", "@k"), "SUCCESS");
  EXPECT_EQ(after(" n=\"1\"", "n"), "FAILURE") << "a text is the tree's own";
  Story main(
      "<Sequence><Script code=\"k := 1\"/><UnsetBlackboard key=\"{@k}\"/><ScriptCondition code=\"k == 1\"/>"
      "</Sequence>");
  EXPECT_EQ(main.tick(), "SUCCESS") << "no entry has a name with @";
}

TEST(Entries, MayHaveBlanksInTheirNames) {
  EXPECT_THAT(entryProblems("<Sequence><SetBlackboard value=\"1;2\" output_key=\"the door\"/>"
                            "<Fly goal=\"{ the door }\"/></Sequence>"),
              IsEmpty());
  EXPECT_THAT(entryProblems("<Fly goal=\"{the door}\"/>"),
              ElementsAre(At("3:6 Fly.goal", "tree.entry-unset", "{the door}")));
  EXPECT_THAT(entryProblems("<Sequence><SetBlackboard value=\"{}\" output_key=\"x\"/><Script code=\"y := x\"/>"
                            "</Sequence>"),
              IsEmpty());
}

TEST(Entries, OfALoopAreTheElementsOfItsQueue) {
  const auto loop = [](const std::string& type, const std::string& queue, const std::string& child) {
    return "<" + type + " queue=\"" + queue + "\" value=\"{g}\">" + child + "</" + type + ">";
  };
  const std::string fly = "<Fly goal=\"{g}\"/>", repeat = "<Repeat num_cycles=\"{g}\"><AlwaysSuccess/></Repeat>";
  EXPECT_THAT(entryProblems(loop("LoopString", "1;1 | 2;2", fly)),
              ElementsAre(At("3:13 queue", "tree.value-type", "`1`", "{g}"),
                          At("3:13 queue", "tree.value-type", "`1 | 2`"), At("3:13 queue", "tree.value-type", "`2`")));
  EXPECT_THAT(entryProblems(loop("LoopInt", "1;2;1", fly)).size(), 2U);
  EXPECT_THAT(entryProblems(loop("LoopDouble", "2.0;3", repeat)), IsEmpty());
  EXPECT_THAT(entryProblems(loop("LoopDouble", "2.5", repeat)),
              ElementsAre(At("3:13 queue", "tree.value-type", "`2.5`")));
  EXPECT_THAT(entryProblems("<Sequence><SetBlackboard value=\"2;3\" output_key=\"q\"/>" + loop("LoopInt", "{q}", fly) +
                            "</Sequence>"),
              ElementsAre(At("3:92 Fly.goal", "tree.entry-type", "{g}")));
}

TEST(Entries, ATextThatIsCopiedTwiceIsJudgedOnce) {
  EXPECT_THAT(
      entryProblems("<Sequence><SetBlackboard value=\"here\" output_key=\"a\"/><Script code=\"b := a; c := a\"/>"
                    "<Fly goal=\"{b}\"/><Fly goal=\"{c}\"/></Sequence>"),
      ElementsAre(At("3:26 value", "tree.value-type", "`here`")));
}

}  // namespace
}  // namespace swiftlet::tree::testing

// Texts that look like numbers are compared and joined as texts: reading the file warns of it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/tree/story.hpp"

namespace swiftlet::tree::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

std::vector<Problem> warningsOf(const std::string& inside, const std::string& more = {}) {
  const Registry registry = Registry::standard();
  const ParseResult result = parseText(file("<Sequence>" + inside + "</Sequence>", more), "f.xml", registry);
  EXPECT_THAT(result.problems, IsEmpty()) << inside;
  return result.warnings;
}

std::string set(const std::string& name, const std::string& value) {
  return "<SetBlackboard value=\"" + value + "\" output_key=\"" + name + "\"/>";
}

std::string asks(const std::string& code) { return "\n<ScriptCondition code=\"" + code + "\"/>"; }

TEST(NumberTexts, AreWarnedOfWhereTheyAreCompared) {
  EXPECT_THAT(warningsOf(set("low", "20") + set("now", "100") + asks("now > low")),
              ElementsAre(At("4:18 ScriptCondition.code", "tree.texts-compared", "`now > low`", "`100`", "`20`",
                             "now := 100")));
  EXPECT_THAT(warningsOf(set("a", "9") + set("b", "10") + asks("a + b == 19")),
              ElementsAre(At("4:18 ScriptCondition.code", "tree.texts-joined", "`a + b`", "`9`", "`10`", "`910`")));
  EXPECT_THAT(warningsOf(set("x", "2") + set("y", "3") + "<Script code=\"x += y\"/>"),
              ElementsAre(At("3:101 Script.code", "tree.texts-joined", "`x + y`")));
  EXPECT_THAT(warningsOf(set("x", "2") + asks("1 &lt; x &lt; '10'")),
              ElementsAre(At("4:18 ScriptCondition.code", "tree.texts-compared", "`x < '10'`")));
  EXPECT_THAT(warningsOf(set("x", "2") + "<AlwaysSuccess _skipIf=\"x >= '10'\"/>"),
              ElementsAre(At("3:67 AlwaysSuccess._skipIf", "tree.texts-compared", "`x >= '10'`")));
}

TEST(NumberTexts, MayBeHexadecimal) {
  EXPECT_THAT(
      warningsOf(set("a", "0x10") + set("b", "9") + asks("a > b")),
      ElementsAre(At("4:18 ScriptCondition.code", "tree.texts-compared", "`a > b`", "`0x10`", "`9`", "a := 0x10")));
  EXPECT_THAT(warningsOf(set("a", "0x10") + asks("a == '16'")),
              ElementsAre(At("4:18 ScriptCondition.code", "tree.texts-compared", "`0x10`", "`16`")));
  EXPECT_THAT(warningsOf(set("a", "0x") + set("b", "0xdoor") + set("c", "9") + asks("a > c") + asks("b > c")),
              IsEmpty());
}

TEST(NumberTexts, AreFollowedThroughCopies) {
  EXPECT_THAT(warningsOf(set("a", "9") + set("b", "{a}") + set("c", "10") + asks("c > b")),
              ElementsAre(At("4:18 ScriptCondition.code", "tree.texts-compared", "`c > b`")));
  EXPECT_THAT(warningsOf("<Script code=\"a := '9'; b := a; c := '10'\"/>" + asks("c > b")),
              ElementsAre(At("4:18 ScriptCondition.code", "tree.texts-compared", "`c > b`")));
  EXPECT_THAT(warningsOf(set("a", "9") + "<SubTree ID=\"S\" n=\"{a}\" m=\"{a}\"/>",
                         "<BehaviorTree ID=\"S\">" + asks("n > m") + "</BehaviorTree>"),
              ElementsAre(At("6:18 ScriptCondition.code", "tree.texts-compared", "`n > m`")));
  EXPECT_THAT(warningsOf("<LoopString queue=\"5;10\" value=\"{n}\"><ScriptCondition code=\"n > '7'\"/></LoopString>"),
              ElementsAre(At("3:65 ScriptCondition.code", "tree.texts-compared", "`n > '7'`")));
}

TEST(NumberTexts, AreNotWarnedOfWhereANumberIsBesideThem) {
  EXPECT_THAT(warningsOf(set("now", "100") + asks("now > 20") + asks("now + 1 == 101")), IsEmpty());
  EXPECT_THAT(warningsOf(set("now", "100") + "<Script code=\"low := 20\"/>" + asks("now > low")), IsEmpty());
  EXPECT_THAT(warningsOf(set("now", "100") + set("name", "door") + asks("now > name")), IsEmpty());
  EXPECT_THAT(warningsOf(set("a", "100") + set("b", "20") + asks("a - b == 80")), IsEmpty()) << "only numbers subtract";
  EXPECT_THAT(warningsOf("<SubTree ID=\"S\" n=\"9\" m=\"10\"/>",
                         "<BehaviorTree ID=\"S\">" + asks("n &lt; m") + "</BehaviorTree>"),
              IsEmpty())
      << "what a SubTree gives is a number for scripts";
  EXPECT_THAT(warningsOf("<LoopInt queue=\"5;10\" value=\"{n}\"><ScriptCondition code=\"n > '7'\"/></LoopInt>"),
              IsEmpty());
}

TEST(NumberTexts, ThatAreEqualAsTheyStandAreNotWarnedOf) {
  EXPECT_THAT(warningsOf(set("mode", "2") + asks("mode == '2'") + asks("mode != '3'")), IsEmpty());
  EXPECT_THAT(warningsOf(set("mode", "2") + asks("mode == '2.0'")),
              ElementsAre(At("4:18 ScriptCondition.code", "tree.texts-compared", "`mode == '2.0'`")));
}

}  // namespace
}  // namespace swiftlet::tree::testing

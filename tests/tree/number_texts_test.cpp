// Texts that look like numbers are compared and joined as texts: reading the file warns of it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/tree/story.hpp"

namespace swiftlet::tree::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::vector<std::string> warningsOf(const std::string& inside, const std::string& more = {}) {
  const Registry registry = Registry::standard();
  const ParseResult result = parseText(file("<Sequence>" + inside + "</Sequence>", more), "f.xml", registry);
  EXPECT_THAT(linesOf(result.problems), IsEmpty()) << inside;
  return linesOf(result.warnings);
}

std::string set(const std::string& name, const std::string& value) {
  return "<SetBlackboard value=\"" + value + "\" output_key=\"" + name + "\"/>";
}

std::string asks(const std::string& code) { return "\n<ScriptCondition code=\"" + code + "\"/>"; }

TEST(NumberTexts, AreWarnedOfWhereTheyAreCompared) {
  EXPECT_THAT(warningsOf(set("low", "20") + set("now", "100") + asks("now > low")),
              ElementsAre("f.xml:4:18: ScriptCondition.code: `now > low` compares `100` and `20` as texts, not as "
                          "numbers, <Script code=\"now := 100\"/> makes it a number"));
  EXPECT_THAT(warningsOf(set("a", "9") + set("b", "10") + asks("a + b == 19")),
              ElementsAre(HasSubstr("`a + b` joins texts, `9` and `10` give `910`")));
  EXPECT_THAT(warningsOf(set("x", "2") + set("y", "3") + "<Script code=\"x += y\"/>"),
              ElementsAre(HasSubstr("`x + y`")));
  EXPECT_THAT(warningsOf(set("x", "2") + asks("1 &lt; x &lt; '10'")), ElementsAre(HasSubstr("`x < '10'`")));
  EXPECT_THAT(warningsOf(set("x", "2") + "<AlwaysSuccess _skipIf=\"x >= '10'\"/>"),
              ElementsAre(HasSubstr("AlwaysSuccess._skipIf: `x >= '10'`")));
}

TEST(NumberTexts, MayBeHexadecimal) {
  EXPECT_THAT(
      warningsOf(set("a", "0x10") + set("b", "9") + asks("a > b")),
      ElementsAre(HasSubstr("`a > b` compares `0x10` and `9` as texts, not as numbers, <Script code=\"a := 0x10")));
  EXPECT_THAT(warningsOf(set("a", "0x10") + asks("a == '16'")), ElementsAre(HasSubstr("`0x10` and `16`")));
  EXPECT_THAT(warningsOf(set("a", "0x") + set("b", "0xdoor") + set("c", "9") + asks("a > c") + asks("b > c")),
              IsEmpty());
}

TEST(NumberTexts, AreFollowedThroughCopies) {
  EXPECT_THAT(warningsOf(set("a", "9") + set("b", "{a}") + set("c", "10") + asks("c > b")),
              ElementsAre(HasSubstr("`c > b`")));
  EXPECT_THAT(warningsOf("<Script code=\"a := '9'; b := a; c := '10'\"/>" + asks("c > b")),
              ElementsAre(HasSubstr("`c > b`")));
  EXPECT_THAT(warningsOf(set("a", "9") + "<SubTree ID=\"S\" n=\"{a}\" m=\"{a}\"/>",
                         "<BehaviorTree ID=\"S\">" + asks("n > m") + "</BehaviorTree>"),
              ElementsAre(HasSubstr("`n > m`")));
  EXPECT_THAT(warningsOf("<LoopString queue=\"5;10\" value=\"{n}\"><ScriptCondition code=\"n > '7'\"/></LoopString>"),
              ElementsAre(HasSubstr("`n > '7'`")));
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
  EXPECT_THAT(warningsOf(set("mode", "2") + asks("mode == '2.0'")), ElementsAre(HasSubstr("`mode == '2.0'`")));
}

}  // namespace
}  // namespace swiftlet::tree::testing

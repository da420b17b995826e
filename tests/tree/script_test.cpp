// The script language: values, precedence, entries, and what is wrong with a text.
#include <cstdint>
#include <deque>
#include <map>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "behaviors/tree/script/script.hpp"

namespace swiftlet::tree {
namespace {

using testing::HasSubstr;

/// Entries by name, and scripts that are run on them.
class Board {
 public:
  Board& set(const std::string& name, Value value) {
    slot(name).write(std::move(value));
    return *this;
  }
  /// The value as text, or "! " and the problem.
  std::string run(std::string_view text) {
    Scripts scripts(constants);
    const auto [script, problem] = scripts.add(text);
    if (problem) return "! " + problem->text();
    for (std::size_t i = 0; i < script->entries().size(); ++i)
      script->bind(i, &slot(std::string(script->entries()[i].name)));
    const auto value = script->run();
    return value ? toString(valueOf(*value)) : "! " + script->problem();
  }
  std::string at(const std::string& name) {
    return slot(name).value ? toString(*slot(name).value) : std::string("nothing");
  }
  Slot& slot(const std::string& name) {
    const auto known = names_.find(name);
    if (known != names_.end()) return *known->second;
    Slot& slot = slots_.emplace_back();
    slot.name = name;
    names_[name] = &slot;
    return slot;
  }

  Constants constants{{"RED", 1}, {"GREEN", 2}};

 private:
  std::deque<Slot> slots_;
  std::map<std::string, Slot*> names_;
};

std::string valueOfText(std::string_view text) { return Board().run(text); }

/// What is wrong with a text that is no script.
Message problemOf(std::string_view text) {
  const Board board;
  return Scripts(board.constants).add(text).problem.value();
}

MATCHER_P2(Says, name, held, "") { return arg.name() == name && arg.text().find(held) != std::string::npos; }

TEST(Script, HasOnlyFiniteNumbers) {
  EXPECT_EQ(valueOfText("1e308 * 10"), "! the result is not a finite number");
  EXPECT_EQ(valueOfText("-1e308 - 1e308"), "! the result is not a finite number");
  EXPECT_EQ(valueOfText("1e308 / 0.1"), "! the result is not a finite number");
  EXPECT_EQ(valueOfText("1e307 * 10"), "1e+308");
  EXPECT_THAT(problemOf("x := 1e400"), Says("tree.script-syntax", "`1e400`"));
  EXPECT_THAT(problemOf("0xFFFFFFFFFFFFFFFFFF"), Says("tree.script-syntax", "63 bits"));
}

TEST(Script, ShowsAWholeCharacterThatItDoesNotKnow) {
  EXPECT_THAT(problemOf("x \u2260 3"), Says("tree.script-syntax", "`\u2260`, which is U+2260"));
}

TEST(Script, ComputesWithTheRulesOfPrecedence) {
  EXPECT_EQ(valueOfText("1 + 2 * 3"), "7");
  EXPECT_EQ(valueOfText("(1 + 2) * 3"), "9");
  EXPECT_EQ(valueOfText("7 - 2 - 1"), "4") << "from the left";
  EXPECT_EQ(valueOfText("-2 * -3"), "6");
  EXPECT_EQ(valueOfText("1 + 2 == 3 && 4 > 3"), "true");
  EXPECT_EQ(valueOfText("1 | 6 & 3"), "3");
  EXPECT_EQ(valueOfText("6 ^ 3"), "5");
  EXPECT_EQ(valueOfText("~0"), "-1");
  EXPECT_EQ(valueOfText("false || true && false"), "false");
  EXPECT_EQ(valueOfText("!true || true"), "true");
  EXPECT_EQ(valueOfText("1 < 2 ? 'a' : 'b'"), "a");
  EXPECT_EQ(valueOfText("false ? 1 : true ? 2 : 3"), "2");
}

TEST(Script, KnowsNumbersTextsAndConstants) {
  EXPECT_EQ(valueOfText("0x2A"), "42");
  EXPECT_EQ(valueOfText("1.5e-1"), "0.15");
  EXPECT_EQ(valueOfText("5 / 2"), "2.5") << "a quotient is no whole number";
  EXPECT_EQ(valueOfText("9223372036854775807 + 1"), "9223372036854775808") << "too large for a whole number";
  EXPECT_EQ(valueOfText("'a' .. \"b\" .. 3"), "ab3");
  EXPECT_EQ(valueOfText("1 .. 2"), "12");
  EXPECT_EQ(valueOfText("GREEN - RED"), "1");
  EXPECT_EQ(valueOfText("true == 1"), "true");
  EXPECT_EQ(valueOfText("'2.0' == 2"), "true") << "text that is a number";
  EXPECT_EQ(valueOfText("'a' < 'b'"), "true");
  EXPECT_EQ(valueOfText("'a' == 1"), "false");
}

TEST(Script, ChainsComparisons) {
  EXPECT_EQ(valueOfText("1 < 2 < 3"), "true");
  EXPECT_EQ(valueOfText("1 < 3 < 2"), "false");
  EXPECT_EQ(valueOfText("0 <= 0 <= 1 != 2"), "true");
}

TEST(Script, EvaluatesEachOperandOfAChainOnce) {
  // Twice at each of 45 levels would take for ever.
  std::string nested = "1";
  for (int i = 0; i < 45; ++i) nested = "(0 < " + nested + " <= 1)";
  EXPECT_EQ(valueOfText(nested), "true");
  Board board;
  EXPECT_EQ(board.run("n := 0; 0 < (n += 1) < 2"), "true");
  EXPECT_EQ(board.at("n"), "1");
  EXPECT_EQ(board.run("n := 0; 2 < 1 < (n += 1)"), "false");
  EXPECT_EQ(board.at("n"), "0") << "what comes after a comparison that is false is not evaluated";
  EXPECT_EQ(valueOfText("(3 > 2) < 2"), "true") << "in parentheses it is a truth value";
}

TEST(Script, WordsForTruthAreTruthValues) {
  Board board;
  board.set("flag", std::string("true")).set("off", std::string("FALSE"));
  EXPECT_EQ(board.run("flag == true"), "true");
  EXPECT_EQ(board.run("true == flag && flag != false && flag == 1"), "true");
  EXPECT_EQ(board.run("off == false && !off"), "true");
  EXPECT_EQ(board.run("flag == 'true'"), "true");
  EXPECT_EQ(board.run("off == 'false'"), "false") << "two texts are compared as text";
}

TEST(Script, NumbersAreEqualWithinTheSpacingOfFloats) {
  EXPECT_EQ(valueOfText("0.1 + 0.2 == 0.3"), "true");
  EXPECT_EQ(valueOfText("0.1 + 0.2 != 0.3"), "false");
  EXPECT_EQ(valueOfText("1 == 1.000001"), "false");
  EXPECT_EQ(valueOfText("0.1 + 0.2 > 0.3"), "true") << "an order is exact";
}

TEST(Script, JoinsTextsOnTheLevelOfSums) {
  EXPECT_EQ(valueOfText("'a' + 'b'"), "ab");
  EXPECT_EQ(valueOfText("'1' + '2'"), "12") << "two texts are joined as text";
  EXPECT_EQ(valueOfText("'1' + 2"), "3");
  EXPECT_EQ(valueOfText("1 + 2 .. 'x'"), "3x");
  EXPECT_EQ(valueOfText("'x' .. 1 + '2'"), "x12") << "from the left";
  EXPECT_EQ(valueOfText("1 | 2 ^ 3"), "0") << "`|` and `^` from the left";
  Board board;
  EXPECT_EQ(board.run("x := 'a'; x += 'b'; x"), "ab");
}

TEST(Script, AnAssignmentHasTheValueThatItAssigns) {
  Board board;
  EXPECT_EQ(board.run("x := y := 1"), "1");
  EXPECT_EQ(board.at("x") + board.at("y"), "11");
  EXPECT_EQ(board.run("false ? (x := 2) : (y := 3)"), "3");
  EXPECT_EQ(board.run("true ? x := 4 : 0"), "4");
  EXPECT_EQ(board.at("x") + board.at("y"), "43");
  EXPECT_EQ(board.run("(x := 2) + x"), "4");
  EXPECT_THAT(problemOf("(1 := 2)"), Says("tree.script-syntax", "`)` at `:=`"));
  std::string chain = "1";
  for (int i = 0; i < 200; ++i) chain = "x := " + chain;
  EXPECT_THAT(problemOf(chain), Says("tree.script-syntax", "100 levels"));
}

TEST(Script, KeepsAnOperandThatTheNextOneOverwrites) {
  Board board;
  const std::string a(40, 'a'), b(60, 'b');
  board.set("x", a).set("b", b);
  EXPECT_EQ(board.run("x .. (x := b)"), a + b);
  board.set("x", a);
  EXPECT_EQ(board.run("x < (x := b) != (b := 'c')"), "true");
  EXPECT_EQ(board.run("b"), "c");
}

TEST(Script, AChoiceTakesAnyTextAsTrue) {
  EXPECT_EQ(valueOfText("'a' ? 1 : 2"), "1");
  EXPECT_EQ(valueOfText("'false' ? 1 : 2"), "2");
  EXPECT_EQ(valueOfText("'' ? 1 : 2"), "! text is neither true nor false");
}

TEST(Script, ATextBesideANumberMayBeAConstant) {
  EXPECT_EQ(valueOfText("'RED' == RED"), "true");
  EXPECT_EQ(valueOfText("GREEN == 'RED'"), "false");
  EXPECT_EQ(valueOfText("'RED' < 2"), "true");
}

TEST(Script, AssignsToEntries) {
  Board board;
  EXPECT_EQ(board.run("x := 3; y := x * 2; x += y; x"), "9");
  EXPECT_EQ(board.at("y"), "6");
  EXPECT_EQ(board.run("x -= 1; x *= 3; x /= 4"), "6");
  EXPECT_EQ(board.run("text := 'hello'; text = text .. ' ' .. x"), "hello 6");
  EXPECT_EQ(board.run("z = 1"), "! the entry {z} is not set; `:=` makes it");
  EXPECT_EQ(board.run("@flag := RED == 1"), "true");
  EXPECT_EQ(board.at("@flag"), "true");
  EXPECT_EQ(board.run("u"), "! the entry {u} is not set");
}

TEST(Script, CopiesAndComparesOtherValues) {
  Board board;
  board.set("door", Point{1.0, 2.0, {}})
      .set("same", Point{1.0, 2.0, {}})
      .set("other", Point{3.0, 2.0, {}})
      .set("limit", Duration{2'000'000'000});
  EXPECT_EQ(board.run("goal := door; goal == same"), "true");
  EXPECT_EQ(board.at("goal"), "1;2");
  EXPECT_EQ(board.run("door == limit"), "false");
  EXPECT_THAT(board.run("door < other"), HasSubstr("a point and a point have no order"));
  EXPECT_THAT(board.run("door + 1"), HasSubstr("a point is not a number"));
}

TEST(Script, EvaluatesTheRightSideOnlyIfItDecides) {
  Board board;
  EXPECT_EQ(board.run("false && nothing"), "false");
  EXPECT_EQ(board.run("true || nothing"), "true");
  EXPECT_EQ(board.run("true ? 1 : nothing"), "1");
  EXPECT_EQ(board.run("true && nothing"), "! the entry {nothing} is not set");
}

TEST(Script, SaysWhatCannotBeEvaluated) {
  EXPECT_EQ(valueOfText("1 / (1 - 1)"), "! division by zero");
  EXPECT_EQ(valueOfText("'a' + 1"), "! text is not a number");
  EXPECT_EQ(valueOfText("'a' < 1"), "! text and a number have no order");
  EXPECT_EQ(valueOfText("1.5 & 1"), "! `&`, `|` and `^` need whole numbers");
  EXPECT_EQ(valueOfText("!'maybe'"), "! text is neither true nor false");
  Board board;
  board.run("x := 'aaaaaaaaaaaaaaaa'");
  std::string last;
  for (int i = 0; i < 20; ++i) last = board.run("x = x .. x");
  EXPECT_EQ(last, "! a text grew longer than 65536 characters");
}

TEST(Script, SaysWhatIsWrongWithAText) {
  EXPECT_THAT(problemOf(""), Says("tree.script-empty", ""));
  EXPECT_THAT(problemOf(" ; "), Says("tree.script-empty", ""));
  for (const auto& [text, held] : {std::pair{"1 +", "at the end of `1 +`"},
                                   {"1 2", "at `2`"},
                                   {"(1", "`)` at the end of `(1`"},
                                   {"a ? b", "`:` at the end of `a ? b`"},
                                   {"x := 'open", "at `'open`"},
                                   {"x # y", "at `#`"},
                                   {"RED := 3", "at `RED`"}})
    EXPECT_THAT(problemOf(text), Says("tree.script-syntax", held));
  for (const char sign : {'(', '-'})
    EXPECT_THAT(problemOf(std::string(200, sign) + "1"), Says("tree.script-syntax", "100 levels"));
  std::string longer = "1";
  for (int i = 0; i < 5000; ++i) longer += "+1";
  EXPECT_THAT(problemOf(longer), Says("tree.script-long", "2000"));
}

TEST(Script, TellsHowOperatorsOfOtherLanguagesAreWritten) {
  for (const auto& [text, held] : {std::pair{"x > 1 and y", "at `and`; write && (in XML &amp;&amp;)"},
                                   {"(x and y)", "`)` at `and`; write &&"},
                                   {"x or y", "at `or`; write ||"},
                                   {"not x", "at `x`; write ! for `not`"},
                                   {"not (x > 1)", "at `(`; write !"}})
    EXPECT_THAT(problemOf(text), Says("tree.script-syntax", held));
  EXPECT_EQ(valueOfText("and := 1; and + 1"), "2") << "as names they are allowed";
  EXPECT_EQ(problemOf("x nor y").text().find("write"), std::string::npos);
}

TEST(Script, TellsWhichEntriesItReadsAndSets) {
  const Constants no_constants;
  Scripts scripts(no_constants);
  scripts.add("other := 'y'");
  const Script* script = scripts.add("a := b + 1; c = a; d := 'x'; e := b").script;
  ASSERT_TRUE(script);
  std::string text;
  for (const ScriptEntry& entry : script->entries())
    text += std::string(entry.name) + (entry.read ? " read" : "") + (entry.set ? " set" : "") + ", ";
  EXPECT_EQ(text, "b read, a set, c read set, d set, e set, ");
  const auto writes = script->writes();
  ASSERT_EQ(writes.size(), 4u);
  EXPECT_EQ(toString(script->constant(writes[2].constant.value())), "x");
  EXPECT_EQ(script->entries()[writes[3].copied.value()].name, "b");
}

RC_GTEST_PROP(Script, SumsAreThoseOfWholeNumbers, (std::int16_t a, std::int16_t b, std::int16_t c)) {
  const auto text = [](std::int16_t n) { return "(" + std::to_string(n) + ")"; };
  RC_ASSERT(valueOfText(text(a) + "+" + text(b) + "*" + text(c)) ==
            std::to_string(std::int64_t{a} + std::int64_t{b} * c));
  RC_ASSERT(valueOfText(text(a) + "<" + text(b)) == (a < b ? "true" : "false"));
}

RC_GTEST_PROP(Script, AnyTextEndsWithAValueOrAProblem, ()) {
  const auto word = rc::gen::element<std::string>("x", "y", "1", "0", "'t'", "+", "-", "*", "/", "(", ")", ":=", "=",
                                                  "?", ":", "&&", "||", "!", "..", "<", "==", ";", "~", "|", "true");
  const auto words = *rc::gen::container<std::vector<std::string>>(word);
  std::string text;
  for (const std::string& w : words) text += w + " ";
  RC_ASSERT(!Board().run(text).empty() || text.find("''") == std::string::npos);
}

}  // namespace
}  // namespace swiftlet::tree

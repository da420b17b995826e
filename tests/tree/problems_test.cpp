// Errors in a file are reported with line, column, the offending text and what was expected; all of them at once.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/tree/story.hpp"

namespace swiftlet::tree::testing {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// A leaf with a port of each type, for the messages.
Registry withPorts() {
  Registry registry = Registry::standard();
  NodeManifest manifest{.id = "Fly",
                        .kind = NodeKind::kAction,
                        .ports = {{.name = "goal", .type = PortType::kPoint, .required = true},
                                  {.name = "clearance_m", .type = PortType::kDouble, .minimum = 0.0, .maximum = 5.0},
                                  {.name = "speed_m_s", .type = PortType::kDouble, .minimum = 0.1},
                                  {.name = "tries", .type = PortType::kInt},
                                  {.name = "careful", .type = PortType::kBool},
                                  {.name = "patience_s", .type = PortType::kDuration},
                                  {.name = "flown_m", .type = PortType::kDouble, .direction = Direction::kOutput}},
                        .description = "Flies."};
  registry.add(manifest, registry.find("AlwaysSuccess")->build);
  NodeManifest condition{.id = "IsDoorOpen", .kind = NodeKind::kCondition, .ports = {}, .description = "Asks."};
  registry.add(condition, registry.find("AlwaysSuccess")->build);
  return registry;
}

std::vector<std::string> problemsOf(const std::string& text, const ParseOptions& options = {}) {
  const Registry registry = withPorts();
  const ParseResult result = parseText(text, "f.xml", registry, options);
  EXPECT_EQ(result.tree.has_value(), result.problems.empty());
  std::vector<std::string> lines;
  for (const Problem& problem : result.problems) lines.push_back(toString(problem));
  return lines;
}

/// `inside` starts at line 3, column 1.
std::vector<std::string> problemsIn(const std::string& inside, const std::string& more = {}) {
  return problemsOf(file(inside, more));
}

TEST(Problems, OfAPointerOfGitAnnexNameIt) {
  for (const std::string text : {"/annex/objects/SHA256E-s9--83d7.xml\n", "../.git/annex/objects/Zx/9q/K/K.xml"})
    EXPECT_THAT(problemsOf(text),
                ElementsAre("f.xml: this is a pointer of git-annex, not the file, run `git annex get` "
                            "for it in its repository"));
}

TEST(Problems, OfAPointerOfGitLfsNameIt) {
  for (const std::string mark : {"", "\xEF\xBB\xBF"})
    EXPECT_THAT(problemsOf(mark + "version https://git-lfs.github.com/spec/v1\noid sha256:83d7\nsize 9\n"),
                ElementsAre("f.xml: this is a pointer of Git LFS, not the file, run `git lfs pull` in its repository"));
}

TEST(Problems, OfAPackedFileSayHowToUnpackIt) {
  EXPECT_THAT(problemsOf("\x1f\x8b\x08 and"), ElementsAre(HasSubstr("is packed by gzip, a text was expected, unpack")));
  EXPECT_THAT(problemsOf("PK\x03\x04 and"), ElementsAre(HasSubstr("a text was expected, unpack it by `unzip`")));
}

TEST(Problems, AValidFileHasNone) {
  EXPECT_THAT(problemsIn(R"(<Sequence name="all of it" _description="x">
      <Fly goal="1;-2.5;3" clearance_m=" 0.1 " speed_m_s="1e0" tries="-3" careful="true" patience_s="1.5"/>
      <Action ID="Fly" goal="1;2" name="explicit"/> <Condition ID="IsDoorOpen"/> <IsDoorOpen/>
      <Decorator ID="Inverter"><AlwaysFailure/></Decorator> <Control ID="Sequence"><AlwaysSuccess/></Control>
    </Sequence>)"),
              ElementsAre());
}

TEST(Problems, MalformedXmlIsReported) {
  EXPECT_THAT(
      problemsOf("<root BTCPP_format=\"4\">\n  <BehaviorTree ID=\"A\">\n    <Sequence>\n  </BehaviorTree>\n</root>"),
      ElementsAre("f.xml:4:5: <Sequence>: malformed XML: mismatched tag, <Sequence> was opened at line 3, and "
                  "</Sequence> closes it"));
  EXPECT_THAT(
      problemsOf("<root BTCPP_format=\"4\">\n"),
      ElementsAre(HasSubstr(
          "f.xml:2:1: <root>: malformed XML: no element found, <root> was opened at line 1, and </root> closes it")));
  EXPECT_THAT(problemsOf(""),
              ElementsAre("f.xml:1:1: malformed XML: no element found, a file begins with <root BTCPP_format=\"4\">"));
  EXPECT_THAT(problemsOf("<root BTCPP_format=\"4\" BTCPP_format=\"4\"/>"),
              ElementsAre(HasSubstr("duplicate attribute, give it once")));
}

TEST(Problems, AHintIsAboutWhatIsMalformed) {
  const auto hintOf = [](const std::string& text) {
    const ParseResult result = parseText(text, "f.xml", Registry::standard());
    return result.problems.empty() ? "" : result.problems.front().hint;
  };
  const std::string begins = "a file begins with <root BTCPP_format=\"4\">";
  EXPECT_EQ(hintOf("hello<root BTCPP_format=\"4\"/>"), begins);
  EXPECT_EQ(hintOf("hello"), begins);
  EXPECT_THAT(hintOf(file("<Script code=\"a&nbsp;b\"/>")), HasSubstr("write any other character itself"));
  EXPECT_EQ(hintOf(file("<Script code=\"&#27;\"/>")), "XML does not allow this character, take it out");
  EXPECT_EQ(hintOf(file(std::string("<Script \0/>", 11))), "XML does not allow this control character, take it out");
  EXPECT_EQ(hintOf("<root BTCPP_format=\"4\"><BehaviorTree"), "what begins here has no end");
  EXPECT_EQ(hintOf(file("<AlwaysSuccess/>") + "more"), "only comments may follow </root>");
  EXPECT_EQ(hintOf("\n<?xml version=\"1.0\"?>" + file("<AlwaysSuccess/>")),
            "<?xml ...?> stands at the very beginning, or not at all");
}

TEST(Problems, AnUnknownNodeIsReported) {
  EXPECT_THAT(problemsIn("<Sequence>\n  <Flly goal=\"1;2\"/>\n  <sequence><AlwaysSuccess/></sequence>\n</Sequence>"),
              ElementsAre("f.xml:4:3: Flly: unknown node `Flly`, did you mean `Fly`?",
                          "f.xml:5:3: sequence: unknown node `sequence`, did you mean `Sequence`?"));
  EXPECT_THAT(problemsIn("<Zzzzzz/>"), ElementsAre("f.xml:3:1: Zzzzzz: unknown node `Zzzzzz`"));
  EXPECT_THAT(problemsIn("<SequenceStar/>"),
              ElementsAre("f.xml:3:1: SequenceStar: `SequenceStar` is a node of BehaviorTree.CPP that this engine does "
                          "not have, use SequenceWithMemory"));
  EXPECT_THAT(problemsIn("<Action ID=\"Flyy\"/>"),
              ElementsAre("f.xml:3:9: Action: unknown node `Flyy`, did you mean `Fly`?"));
  EXPECT_THAT(problemsIn("<Action/>"), ElementsAre("f.xml:3:1: Action: the attribute `ID` is missing"));
  EXPECT_THAT(problemsIn("<Sub/>", "<BehaviorTree ID=\"Sub\"><AlwaysSuccess/></BehaviorTree>"),
              ElementsAre("f.xml:3:1: Sub: unknown node `Sub`, a tree is used as <SubTree ID=\"Sub\"/>"));
}

TEST(Problems, AnExplicitFormOfTheWrongKindIsReported) {
  EXPECT_THAT(problemsIn("<Condition ID=\"Fly\" goal=\"1;2\"/>"),
              ElementsAre("f.xml:3:1: Condition: `Fly` is not of this kind, write <Action ID=\"Fly\">"));
}

TEST(Problems, AnUnknownPortAndAWrongUnitAreReported) {
  EXPECT_THAT(
      problemsIn("<Fly goal=\"1;2\"\n     clearance_cm=\"10\"/>"),
      ElementsAre("f.xml:4:6: Fly: port `clearance_cm` is in centimetres, expected `clearance_m` in metres, did you "
                  "mean `clearance_m`?"));
  EXPECT_THAT(
      problemsIn("<Fly goal=\"1;2\" clearance=\"10\"/>"),
      ElementsAre(HasSubstr("3:17: Fly: port `clearance` is without a unit, expected `clearance_m` in metres")));
  EXPECT_THAT(problemsIn("<Fly gaol=\"1;2\" goal=\"1;2\"/>"),
              ElementsAre(HasSubstr("3:6: Fly: unknown port `gaol`, expected `goal`, "
                                    "`clearance_m`")));
  EXPECT_THAT(problemsIn("<Fly gaol=\"1;2\" goal=\"1;2\"/>"), ElementsAre(HasSubstr("did you mean `goal`?")));
  EXPECT_THAT(problemsIn("<AlwaysSuccess x=\"1\"/>"),
              ElementsAre("f.xml:3:16: AlwaysSuccess: unknown port `x`, expected no ports"));
}

TEST(Problems, AMissingPortIsReported) {
  EXPECT_THAT(problemsIn("<Fly/>"),
              ElementsAre("f.xml:3:1: Fly: port `goal` is missing, expected a point `x;y` or `x;y;z` in metres"));
}

TEST(Problems, AWrongTypeOrRangeIsReported) {
  EXPECT_THAT(
      problemsIn(R"(<Fly goal="1,2" clearance_m="10cm" speed_m_s="nan" tries="1.5" careful="yes" patience_s="soon"/>)"),
      ElementsAre("f.xml:3:6: Fly.goal: `1,2` is not a point `x;y` or `x;y;z` in metres",
                  "f.xml:3:17: Fly.clearance_m: `10cm` is not a number in metres from 0 to 5",
                  "f.xml:3:36: Fly.speed_m_s: `nan` is not a number in metres per second not below 0.1",
                  "f.xml:3:52: Fly.tries: `1.5` is not a whole number",
                  "f.xml:3:64: Fly.careful: `yes` is not true or false",
                  "f.xml:3:78: Fly.patience_s: `soon` is not a time in seconds"));
  EXPECT_THAT(
      problemsIn(R"(<Fly goal="1;2" clearance_m="5.1"/>)"),
      ElementsAre("f.xml:3:17: Fly.clearance_m: `5.1` is out of range, expected a number in metres from 0 to 5"));
  EXPECT_THAT(
      problemsIn(R"(<Timeout msec="-1"><AlwaysSuccess/></Timeout>)"),
      ElementsAre("f.xml:3:10: Timeout.msec: `-1` is out of range, expected a time in milliseconds not below 0"));
  EXPECT_THAT(
      problemsIn(R"(<Timeout msec="1e300"><AlwaysSuccess/></Timeout>)"),
      ElementsAre("f.xml:3:10: Timeout.msec: `1e300` is out of range, expected a time in milliseconds from 0 to "
                  "9e+12"));
  for (const char* goal : {"", "1", "1;", "1;2;3;4", "1;inf", "1;2;", ";;", "1 2", "0x1;2", "1;2m", "--1;2", "+1;2"})
    EXPECT_EQ(problemsIn("<Fly goal=\"" + std::string(goal) + "\"/>").size(), 1U) << goal;
}

TEST(Problems, AnOutputWithoutAnEntryIsReported) {
  EXPECT_THAT(problemsIn(R"(<SetBlackboard value="3"/>)"),
              ElementsAre("f.xml:3:1: SetBlackboard: port `output_key` is missing, expected an entry"));
  EXPECT_THAT(problemsIn(R"(<Fly goal="1;2" flown_m="3"/>)"),
              ElementsAre("f.xml:3:17: Fly.flown_m: `3` is not an entry, expected `{name}`"));
  EXPECT_THAT(problemsIn(R"(<Fly goal="{}"/>)"),
              ElementsAre("f.xml:3:6: Fly.goal: `{}` is not a point `x;y` or `x;y;z` in metres"));
  EXPECT_THAT(problemsIn(R"(<Fly goal="{ }"/>)"),
              ElementsAre("f.xml:3:6: Fly.goal: `{ }` does not name an entry, expected `{name}`"));
  EXPECT_THAT(problemsIn(R"(<Fly goal="{{a}}"/>)"), ElementsAre(HasSubstr("does not name an entry")));
}

TEST(Problems, AWrongNumberOfChildrenIsReported) {
  EXPECT_THAT(problemsIn("<Sequence/>"), ElementsAre("f.xml:3:1: Sequence: has 0 children, expected at least 1"));
  EXPECT_THAT(problemsIn("<Inverter><AlwaysSuccess/><AlwaysSuccess/></Inverter>"),
              ElementsAre("f.xml:3:1: Inverter: has 2 children, expected exactly 1, put them into a <Sequence>"));
  EXPECT_THAT(problemsIn("<AlwaysSuccess><AlwaysSuccess/></AlwaysSuccess>"),
              ElementsAre("f.xml:3:1: AlwaysSuccess: has 1 child, expected none"));
  EXPECT_THAT(problemsIn(""), ElementsAre("f.xml:2:1: BehaviorTree: `Main` has 0 children, expected 1"));
  EXPECT_THAT(problemsIn("<AlwaysSuccess/><AlwaysSuccess/>"),
              ElementsAre(HasSubstr("`Main` has 2 children, expected 1, put them into a <Sequence>")));
  EXPECT_THAT(problemsIn("<Parallel success_count=\"3\"><AlwaysSuccess/></Parallel>"),
              ElementsAre("f.xml:3:11: Parallel: success_count is 3, but it has only 1 child"));
}

TEST(Problems, UnexpectedTextIsReported) {
  EXPECT_THAT(problemsIn("<Sequence>\n go! <AlwaysSuccess/></Sequence>"),
              ElementsAre("f.xml:4:2: Sequence: text is not expected here, a comment is written as <!-- text -->"));
}

TEST(Problems, MistakesInSubTreesAreReported) {
  EXPECT_THAT(problemsIn("<SubTree ID=\"Sbu\"/>", "<BehaviorTree ID=\"Sub\"><AlwaysSuccess/></BehaviorTree>"),
              ElementsAre("f.xml:3:10: SubTree: there is no <BehaviorTree ID=\"Sbu\">, did you mean `Sub`?"));
  EXPECT_THAT(problemsIn("<SubTree/>"), ElementsAre("f.xml:3:1: SubTree: the attribute `ID` is missing"));
  EXPECT_THAT(
      problemsIn("<SubTree ID=\"Main\"/>"),
      ElementsAre(
          "f.xml:3:1: SubTree: the tree contains itself: Main -> Main, a <Repeat> around it runs a tree again"));
  EXPECT_THAT(
      problemsIn("<SubTree ID=\"B\"/>",
                 "<BehaviorTree ID=\"B\"><SubTree ID=\"C\"/></BehaviorTree>\n"
                 "<BehaviorTree ID=\"C\"><Inverter><SubTree ID=\"B\"/></Inverter></BehaviorTree>\n"),
      ElementsAre(
          "f.xml:6:32: SubTree: the tree contains itself: B -> C -> B, a <Repeat> around it runs a tree again"));
  EXPECT_THAT(
      problemsIn("<SubTree ID=\"Sub\" clearance_cm=\"5\"/>",
                 "<BehaviorTree ID=\"Sub\"><Fly goal=\"1;2\" clearance_m=\"{clearance_m}\"/></BehaviorTree>"),
      ElementsAre(HasSubstr("3:19: SubTree: the tree `Sub` has no entry {clearance_cm}, did you mean `clearance_m`?"),
                  HasSubstr("nothing sets the entry {clearance_m}")));
  EXPECT_THAT(problemsIn("<SubTree ID=\"Sub\" _autoremap=\"maybe\"/>",
                         "<BehaviorTree ID=\"Sub\"><AlwaysSuccess/></BehaviorTree>"),
              ElementsAre("f.xml:3:19: SubTree._autoremap: `maybe` is not true or false"));
}

TEST(Problems, MistakesInEntriesAreReported) {
  EXPECT_THAT(problemsIn("<Fly goal=\"{target}\"/>"),
              ElementsAre("f.xml:3:6: Fly.goal: nothing sets the entry {target}"));
  EXPECT_THAT(
      problemsIn("<Sequence><SetBlackboard value=\"1;2\" output_key=\"traget\"/><Fly goal=\"{target}\"/></Sequence>"),
      ElementsAre(HasSubstr("nothing sets the entry {target}, did you mean `traget`?")));
  EXPECT_THAT(
      problemsIn(
          "<Sequence>\n<SetBlackboard value=\"here\" output_key=\"target\"/><Fly goal=\"{target}\"/></Sequence>"),
      ElementsAre(
          "f.xml:4:16: value: `here` is not a point `x;y` or `x;y;z` in metres (read by Fly.goal from {target})"));
  EXPECT_THAT(
      problemsIn(
          "<Sequence><SetBlackboard value=\"9\" output_key=\"a\"/><SetBlackboard value=\"{a}\" output_key=\"b\"/>"
          "<Fly goal=\"1;2\" clearance_m=\"{b}\"/></Sequence>"),
      ElementsAre(HasSubstr("value: `9` is out of range")));
  EXPECT_THAT(problemsIn("<Sequence><Fly goal=\"1;2\" flown_m=\"{d}\"/><Fly goal=\"{d}\"/></Sequence>"),
              ElementsAre(HasSubstr("Fly.goal: the entry {d} is written as number, expected a point")));
}

TEST(Problems, MistakesInRootAndTreesAreReported) {
  EXPECT_THAT(problemsOf("<rot BTCPP_format=\"4\"/>"),
              ElementsAre("f.xml:1:1: rot: the outermost element must be <root BTCPP_format=\"4\">"));
  EXPECT_THAT(problemsOf("<root main_tree_to_execute=\"A\"/>"),
              ElementsAre("f.xml:1:7: root: there is no <BehaviorTree ID=\"A\">"));
  EXPECT_THAT(problemsOf("<root BTCPP_format=\"3\"/>"),
              ElementsAre("f.xml:1:7: root: BTCPP_format=\"3\", expected \"4\", `swiftlet migrate f.xml` rewrites it"));
  EXPECT_THAT(problemsOf("<root BTCPP_format=\"5\"/>"),
              ElementsAre("f.xml:1:7: root: BTCPP_format=\"5\", expected \"4\""));
  EXPECT_THAT(problemsOf("<root BTCPP_format=\"4\"/>"), ElementsAre("f.xml:1:1: root: there is no <BehaviorTree>"));
  const std::string two =
      "<BehaviorTree ID=\"A\"><AlwaysSuccess/></BehaviorTree>\n<BehaviorTree "
      "ID=\"B\"><AlwaysSuccess/></BehaviorTree></root>";
  EXPECT_THAT(problemsOf("<root BTCPP_format=\"4\">" + two),
              ElementsAre(HasSubstr("main_tree_to_execute is missing, expected where there are several trees, write "
                                    "main_tree_to_execute=\"A\", or another that no tree uses: `B`")));
  EXPECT_THAT(problemsOf("<root BTCPP_format=\"4\" main_tree_to_execute=\"Flight\">" + two),
              ElementsAre(HasSubstr("there is no <BehaviorTree ID=\"Flight\">, write main_tree_to_execute=\"A\"")));
  EXPECT_THAT(problemsOf("<root BTCPP_format=\"4\" main_tree_to_execute=\"a\">" + two),
              ElementsAre("f.xml:1:24: root: there is no <BehaviorTree ID=\"a\">, did you mean `A`?"));
  EXPECT_THAT(
      problemsOf("<root BTCPP_format=\"4\" main_tree_to_exectue=\"A\">\n" + two),
      ElementsAre("f.xml:1:24: root: unknown attribute `main_tree_to_exectue`, did you mean `main_tree_to_execute`?",
                  HasSubstr("main_tree_to_execute is missing")));
  EXPECT_THAT(
      problemsOf("<root BTCPP_format=\"4\" main_tree_to_execute=\"A\">" + two.substr(0, two.size() - 7) +
                 "<BehaviorTree ID=\"A\"><AlwaysSuccess/></BehaviorTree><BehaviourTree/></root>"),
      ElementsAre(
          HasSubstr("`A` is defined twice, first at f.xml:1:49"),
          HasSubstr("BehaviourTree: unknown element, expected <BehaviorTree>, <include> or <TreeNodesModel>, did you "
                    "mean `BehaviorTree`?")));
  EXPECT_THAT(
      problemsOf("<root BTCPP_format=\"4\">\n<BehaviorTree ID=\"A\" main_tree_to_execute=\"A\" _favorite=\"true\" "
                 "id=\"a\"><AlwaysSuccess/></BehaviorTree></root>"),
      ElementsAre("f.xml:2:22: BehaviorTree: unknown attribute `main_tree_to_execute`, write it in <root>",
                  HasSubstr("BehaviorTree: unknown attribute `id`, did you mean `ID`?")));
  EXPECT_THAT(problemsIn("<AlwaysSuccess/>", "<BehaviorTree><AlwaysSuccess/></BehaviorTree>"),
              ElementsAre(HasSubstr("BehaviorTree: the attribute `ID` is missing")));
  EXPECT_THAT(problemsIn("<AlwaysSuccess/>", "<BehaviorTree ID=\"Fly\"><AlwaysSuccess/></BehaviorTree>"),
              ElementsAre(HasSubstr("`Fly` is the name of a node type")));
}

TEST(Problems, UnsupportedFeaturesAreReportedAndNotIgnored) {
  EXPECT_THAT(problemsIn("<AlwaysSuccess _skipif=\"x==1\"/>"),
              ElementsAre(HasSubstr("unknown attribute `_skipif`, did you mean `_skipIf`?")));
  EXPECT_THAT(problemsIn("<AlwaysSuccess _onsucess=\"x:=1\"/>"), ElementsAre(HasSubstr("did you mean `_onSuccess`?")));
  EXPECT_THAT(
      problemsIn("<SubTree ID=\"S\" _autoremaps=\"1\"/>", "<BehaviorTree ID=\"S\"><Fly goal=\"1;1\"/></BehaviorTree>"),
      ElementsAre(HasSubstr("did you mean `_autoremap`?")));
  EXPECT_THAT(
      problemsOf("<!DOCTYPE root [<!ENTITY a \"b\">]><root BTCPP_format=\"4\"/>"),
      ElementsAre("f.xml:1:16: <!DOCTYPE>: a DOCTYPE is not supported, take it out, and write its entities as the text "
                  "they stand for"));
  EXPECT_THAT(problemsIn("<AlwaysSuccess/>", "<include ros_pkg=\"p\" path=\"x.xml\"/>"),
              ElementsAre(HasSubstr("ros_pkg is not supported")));
}

TEST(Problems, AllAreReportedTogether) {
  EXPECT_THAT(problemsIn("<Sequence>\n<Flly/>\n<Fly/>\n<Inverter/>\n<SubTree ID=\"no\"/></Sequence>"),
              ElementsAre(HasSubstr(":4:1: Flly"), HasSubstr(":5:1: Fly"), HasSubstr(":6:1: Inverter"),
                          HasSubstr(":7:10: SubTree")));
}

TEST(Problems, WhatThePortsOfTheEngineNeedIsReportedWithAllElse) {
  EXPECT_THAT(
      problemsIn("<Sequence>\n<Precondition if=\"true\" else=\"running\"><AlwaysSuccess/></Precondition>\n"
                 "<LoopInt queue=\"1\" if_empty=\"1\"><AlwaysSuccess/></LoopInt>\n<Switch2><AlwaysSuccess/></Switch2>\n"
                 "<TryCatch><AlwaysSuccess/></TryCatch>\n<WhileDoElse><AlwaysSuccess/></WhileDoElse>\n"
                 "<ParallelAll max_failures=\"2\"><AlwaysSuccess/></ParallelAll>\n<TestNode return_status=\"IDLE\"/>\n"
                 "<Nope/></Sequence>"),
      ElementsAre(HasSubstr("4:25: Precondition.else: `running` is not SUCCESS or FAILURE or RUNNING or SKIPPED, did "
                            "you mean `RUNNING`?"),
                  HasSubstr("5:20: LoopInt.if_empty: `1` is not SUCCESS"),
                  HasSubstr("6:1: Switch2: has 1 child, expected exactly 3, one for each case, and one for all else"),
                  HasSubstr("7:1: TryCatch: has 1 child, expected at least 2"),
                  HasSubstr("8:1: WhileDoElse: has 1 child, expected 2 or 3"),
                  HasSubstr("9:14: ParallelAll: max_failures is 2, but it has only 1 child"),
                  HasSubstr("10:11: TestNode.return_status: `IDLE` is not"), HasSubstr("11:1: Nope")));
}

TEST(Problems, ACountThatNeedsNoChildIsAWarning) {
  const auto warningsOf = [](const std::string& node) {
    const ParseResult result =
        parseText(file(node + "<AlwaysSuccess/><AlwaysSuccess/></" + node.substr(1, node.find(' ') - 1) + ">"), "f.xml",
                  Registry::standard());
    EXPECT_TRUE(result.tree.has_value()) << toString(result.problems);
    return linesOf(result.warnings);
  };
  EXPECT_THAT(warningsOf("<Parallel failure_count=\"0\">"),
              ElementsAre("f.xml:3:11: Parallel: failure_count is 0, which is reached before any child has ended"));
  EXPECT_THAT(warningsOf("<Parallel success_count=\"0\" failure_count=\"-3\">"),
              ElementsAre(HasSubstr("success_count is 0"), HasSubstr("failure_count is -3, which is reached")));
  EXPECT_EQ(warningsOf("<ParallelAll max_failures=\"0\">").size(), 1U);
  EXPECT_THAT(warningsOf("<Parallel success_count=\"-2\" failure_count=\"2\">"), ElementsAre());
}

TEST(Problems, AListThatNamesNoTreeIsNotMissedTwice) {
  const std::string tree = "<BehaviorTree><AlwaysSuccess/></BehaviorTree>";
  const std::string missing = "the attribute `ID` is missing";
  EXPECT_THAT(problemsOf("<root BTCPP_format=\"4\">" + tree + tree + "</root>"),
              ElementsAre(HasSubstr(missing), HasSubstr(missing)));
  EXPECT_EQ(problemsOf("<root BTCPP_format=\"4\" main_tree_to_execute=\"A\">" + tree + tree + "</root>").size(), 2U);
  EXPECT_THAT(problemsOf("<root BTCPP_format=\"4\"><BehaviorTree ID=\"\"><AlwaysSuccess/></BehaviorTree></root>"),
              ElementsAre(HasSubstr("the ID is empty")));
  EXPECT_THAT(problemsOf("<root BTCPP_format=\"4\"><include path=\"none.xml\"/></root>"),
              ElementsAre(HasSubstr("cannot be read")));
}

TEST(Problems, ALongListIsShortened) {
  std::string inside = "<Sequence>";
  for (int i = 0; i < 1000; ++i) inside += "<Nope/>";
  const auto problems = problemsIn(inside + "</Sequence>");
  EXPECT_EQ(problems.size(), 101U);
  EXPECT_EQ(problems.back(), "there are more problems");
}

TEST(Problems, ColumnsCountCharacters) {
  EXPECT_THAT(problemsIn("<Sequence name=\"größer\"><Flly/></Sequence>"), ElementsAre(HasSubstr("f.xml:3:25: Flly")));
  EXPECT_THAT(problemsOf("\xEF\xBB\xBF<rot/>"), ElementsAre(HasSubstr("f.xml:1:1: rot")));
}

TEST(Limits, TheDepthOfATreeIsLimited) {
  const auto nested = [](int depth) {
    std::string text;
    for (int i = 0; i < depth; ++i) text += "<Inverter>";
    text += "<AlwaysSuccess/>";
    for (int i = 0; i < depth; ++i) text += "</Inverter>";
    return text;
  };
  EXPECT_THAT(problemsIn(nested(199)), ElementsAre());
  EXPECT_THAT(problemsIn(nested(200)), ElementsAre(HasSubstr("elements are nested deeper than 200")));
  EXPECT_THAT(problemsIn(nested(100'000)), ElementsAre(HasSubstr("elements are nested deeper than 200")));
  std::string more = "<BehaviorTree ID=\"T0\"><AlwaysSuccess/></BehaviorTree>\n";
  for (int i = 1; i < 300; ++i)
    more += "<BehaviorTree ID=\"T" + std::to_string(i) + "\"><SubTree ID=\"T" + std::to_string(i - 1) +
            "\"/></BehaviorTree>\n";
  EXPECT_THAT(problemsIn("<SubTree ID=\"T299\"/>", more), ElementsAre(HasSubstr("nodes are nested deeper than 200")));
}

TEST(Limits, ExpandedSubTreesAreLimited) {
  std::string more = "<BehaviorTree ID=\"T0\"><AlwaysSuccess/></BehaviorTree>\n";
  for (int i = 1; i < 40; ++i) {
    const std::string use = "<SubTree ID=\"T" + std::to_string(i - 1) + "\"/>";
    more +=
        "<BehaviorTree ID=\"T" + std::to_string(i) + "\"><Sequence>" + use + use + use + "</Sequence></BehaviorTree>\n";
  }
  EXPECT_THAT(problemsIn("<SubTree ID=\"T39\"/>", more),
              ElementsAre(HasSubstr("more than 100000 nodes, subtrees included")));
}

TEST(Limits, TheSizeOfAFileIsLimited) {
  EXPECT_THAT(problemsOf(std::string((std::size_t{8} << 20) + 1, ' ')),
              ElementsAre("f.xml: `f.xml` is larger than 8388608 bytes"));
}

}  // namespace
}  // namespace swiftlet::tree::testing

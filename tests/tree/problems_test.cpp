// Errors in a file are reported with line, column and the offending text; all of them at once.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/tree/story.hpp"

namespace swiftlet::tree::testing {
namespace {

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

std::vector<Problem> problemsOf(const std::string& text, const ParseOptions& options = {}) {
  const Registry registry = withPorts();
  const ParseResult result = parseText(text, "f.xml", registry, options);
  EXPECT_EQ(result.tree.has_value(), result.problems.empty());
  return result.problems;
}

/// `inside` starts at line 3, column 1.
std::vector<Problem> problemsIn(const std::string& inside, const std::string& more = {}) {
  return problemsOf(file(inside, more));
}

TEST(Problems, OfAPointerOfGitAnnexNameIt) {
  for (const std::string text : {"/annex/objects/SHA256E-s9--83d7.xml\n", "../.git/annex/objects/Zx/9q/K/K.xml"})
    EXPECT_THAT(problemsOf(text), ElementsAre(At("f.xml", "tree.file-pointer", "`git annex get`")));
}

TEST(Problems, OfAPointerOfGitLfsNameIt) {
  for (const std::string mark : {"", "\xEF\xBB\xBF"})
    EXPECT_THAT(problemsOf(mark + "version https://git-lfs.github.com/spec/v1\noid sha256:83d7\nsize 9\n"),
                ElementsAre(At("f.xml", "tree.file-pointer", "`git lfs pull`")));
}

TEST(Problems, OfAPackedFileSayHowToUnpackIt) {
  EXPECT_THAT(problemsOf("\x1f\x8b\x08 and"), ElementsAre(At("f.xml", "tree.file-packed", "gzip", "`gunzip`")));
  EXPECT_THAT(problemsOf("PK\x03\x04 and"), ElementsAre(At("f.xml", "tree.file-packed", "zip", "`unzip`")));
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
      ElementsAre(At("4:5 <Sequence>", "tree.xml-malformed")));
  EXPECT_THAT(problemsOf("<root BTCPP_format=\"4\">\n"), ElementsAre(At("2:1 <root>", "tree.xml-malformed")));
  EXPECT_THAT(problemsOf(""), ElementsAre(At("1:1", "tree.xml-malformed")));
  EXPECT_THAT(problemsOf("<root BTCPP_format=\"4\" BTCPP_format=\"4\"/>"),
              ElementsAre(At("1:24", "tree.xml-malformed")));
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
              ElementsAre(At("4:3 Flly", "tree.unknown-node", "`Fly`?"),
                          At("5:3 sequence", "tree.unknown-node", "`Sequence`?")));
  EXPECT_THAT(problemsIn("<Zzzzzz/>"), ElementsAre(At("3:1 Zzzzzz", "tree.unknown-node")));
  EXPECT_THAT(problemsIn("<SequenceStar/>"),
              ElementsAre(At("3:1 SequenceStar", "tree.foreign-node", "SequenceWithMemory")));
  EXPECT_THAT(problemsIn("<Action ID=\"Flyy\"/>"),
              ElementsAre(At("3:9 Action", "tree.unknown-node", "`Flyy`", "`Fly`?")));
  EXPECT_THAT(problemsIn("<Action/>"), ElementsAre(At("3:1 Action", "tree.attribute-missing", "`ID`")));
  EXPECT_THAT(problemsIn("<Sub/>", "<BehaviorTree ID=\"Sub\"><AlwaysSuccess/></BehaviorTree>"),
              ElementsAre(At("3:1 Sub", "tree.unknown-node", "<SubTree ID=\"Sub\"/>")));
}

TEST(Problems, AnExplicitFormOfTheWrongKindIsReported) {
  EXPECT_THAT(problemsIn("<Condition ID=\"Fly\" goal=\"1;2\"/>"),
              ElementsAre(At("3:1 Condition", "tree.wrong-kind", "<Action ID=\"Fly\">")));
}

TEST(Problems, AnUnknownPortAndAWrongUnitAreReported) {
  EXPECT_THAT(problemsIn("<Fly goal=\"1;2\"\n     clearance_cm=\"10\"/>"),
              ElementsAre(At("4:6 Fly", "tree.port-unit", "`clearance_cm`", "`clearance_m`?")));
  EXPECT_THAT(problemsIn("<Fly goal=\"1;2\" clearance=\"10\"/>"),
              ElementsAre(At("3:17 Fly", "tree.port-unit", "`clearance`", "`clearance_m`")));
  EXPECT_THAT(problemsIn("<Fly gaol=\"1;2\" goal=\"1;2\"/>"),
              ElementsAre(At("3:6 Fly", "tree.unknown-port", "`gaol`", "`goal`, `clearance_m`", "`goal`?")));
  EXPECT_THAT(problemsIn("<AlwaysSuccess x=\"1\"/>"),
              ElementsAre(At("3:16 AlwaysSuccess", "tree.unknown-port", "`x`")));
}

TEST(Problems, AMissingPortIsReported) {
  EXPECT_THAT(problemsIn("<Fly/>"), ElementsAre(At("3:1 Fly", "tree.port-missing", "`goal`")));
}

TEST(Problems, AWrongTypeOrRangeIsReported) {
  EXPECT_THAT(
      problemsIn(R"(<Fly goal="1,2" clearance_m="10cm" speed_m_s="nan" tries="1.5" careful="yes" patience_s="soon"/>)"),
      ElementsAre(
          At("3:6 Fly.goal", "tree.value-type", "`1,2`"), At("3:17 Fly.clearance_m", "tree.value-type", "`10cm`"),
          At("3:36 Fly.speed_m_s", "tree.value-type", "`nan`"), At("3:52 Fly.tries", "tree.value-type", "`1.5`"),
          At("3:64 Fly.careful", "tree.value-type", "`yes`"), At("3:78 Fly.patience_s", "tree.value-type", "`soon`")));
  EXPECT_THAT(problemsIn(R"(<Fly goal="1;2" clearance_m="5.1"/>)"),
              ElementsAre(At("3:17 Fly.clearance_m", "tree.value-range", "`5.1`")));
  EXPECT_THAT(problemsIn(R"(<Timeout msec="-1"><AlwaysSuccess/></Timeout>)"),
              ElementsAre(At("3:10 Timeout.msec", "tree.value-range", "`-1`")));
  EXPECT_THAT(problemsIn(R"(<Timeout msec="1e300"><AlwaysSuccess/></Timeout>)"),
              ElementsAre(At("3:10 Timeout.msec", "tree.value-range", "`1e300`")));
  for (const char* goal : {"", "1", "1;", "1;2;3;4", "1;inf", "1;2;", ";;", "1 2", "0x1;2", "1;2m", "--1;2", "+1;2"})
    EXPECT_EQ(problemsIn("<Fly goal=\"" + std::string(goal) + "\"/>").size(), 1U) << goal;
}

TEST(Problems, AnOutputWithoutAnEntryIsReported) {
  EXPECT_THAT(problemsIn(R"(<SetBlackboard value="3"/>)"),
              ElementsAre(At("3:1 SetBlackboard", "tree.port-missing", "`output_key`")));
  EXPECT_THAT(problemsIn(R"(<Fly goal="1;2" flown_m="3"/>)"),
              ElementsAre(At("3:17 Fly.flown_m", "tree.not-an-entry", "`3`")));
  EXPECT_THAT(problemsIn(R"(<Fly goal="{}"/>)"), ElementsAre(At("3:6 Fly.goal", "tree.value-type", "`{}`")));
  EXPECT_THAT(problemsIn(R"(<Fly goal="{ }"/>)"), ElementsAre(At("3:6 Fly.goal", "tree.not-an-entry", "`{ }`")));
  EXPECT_THAT(problemsIn(R"(<Fly goal="{{a}}"/>)"), ElementsAre(At("3:6 Fly.goal", "tree.not-an-entry", "`{{a}}`")));
}

TEST(Problems, AWrongNumberOfChildrenIsReported) {
  EXPECT_THAT(problemsIn("<Sequence/>"), ElementsAre(At("3:1 Sequence", "tree.children-count", "at least 1")));
  EXPECT_THAT(problemsIn("<Inverter><AlwaysSuccess/><AlwaysSuccess/></Inverter>"),
              ElementsAre(At("3:1 Inverter", "tree.children-count", "exactly 1", "<Sequence>")));
  EXPECT_THAT(problemsIn("<AlwaysSuccess><AlwaysSuccess/></AlwaysSuccess>"),
              ElementsAre(At("3:1 AlwaysSuccess", "tree.children-count", "none")));
  EXPECT_THAT(problemsIn(""), ElementsAre(At("2:1 BehaviorTree", "tree.root-count", "`Main`")));
  EXPECT_THAT(problemsIn("<AlwaysSuccess/><AlwaysSuccess/>"),
              ElementsAre(At("2:1 BehaviorTree", "tree.root-count", "<Sequence>")));
  EXPECT_THAT(problemsIn("<Parallel success_count=\"3\"><AlwaysSuccess/></Parallel>"),
              ElementsAre(At("3:11 Parallel", "tree.count-unreachable", "success_count")));
}

TEST(Problems, UnexpectedTextIsReported) {
  EXPECT_THAT(problemsIn("<Sequence>\n go! <AlwaysSuccess/></Sequence>"),
              ElementsAre(At("4:2 Sequence", "tree.stray-text")));
}

TEST(Problems, MistakesInSubTreesAreReported) {
  EXPECT_THAT(problemsIn("<SubTree ID=\"Sbu\"/>", "<BehaviorTree ID=\"Sub\"><AlwaysSuccess/></BehaviorTree>"),
              ElementsAre(At("3:10 SubTree", "tree.unknown-tree", "`Sub`?")));
  EXPECT_THAT(problemsIn("<SubTree/>"), ElementsAre(At("3:1 SubTree", "tree.attribute-missing", "`ID`")));
  EXPECT_THAT(problemsIn("<SubTree ID=\"Main\"/>"),
              ElementsAre(At("3:1 SubTree", "tree.contains-itself", "Main -> Main")));
  EXPECT_THAT(problemsIn("<SubTree ID=\"B\"/>",
                         "<BehaviorTree ID=\"B\"><SubTree ID=\"C\"/></BehaviorTree>\n"
                         "<BehaviorTree ID=\"C\"><Inverter><SubTree ID=\"B\"/></Inverter></BehaviorTree>\n"),
              ElementsAre(At("6:32 SubTree", "tree.contains-itself", "B -> C -> B")));
  EXPECT_THAT(problemsIn("<SubTree ID=\"Sub\" clearance_cm=\"5\"/>",
                         "<BehaviorTree ID=\"Sub\"><Fly goal=\"1;2\" clearance_m=\"{clearance_m}\"/></BehaviorTree>"),
              ElementsAre(At("3:19 SubTree", "tree.unknown-entry", "`Sub`", "{clearance_cm}", "`clearance_m`?"),
                          At("5:40 Fly.clearance_m", "tree.entry-unset", "{clearance_m}")));
  EXPECT_THAT(problemsIn("<SubTree ID=\"Sub\" _autoremap=\"maybe\"/>",
                         "<BehaviorTree ID=\"Sub\"><AlwaysSuccess/></BehaviorTree>"),
              ElementsAre(At("3:19 SubTree._autoremap", "tree.value-type", "`maybe`")));
}

TEST(Problems, MistakesInEntriesAreReported) {
  EXPECT_THAT(problemsIn("<Fly goal=\"{target}\"/>"), ElementsAre(At("3:6 Fly.goal", "tree.entry-unset", "{target}")));
  EXPECT_THAT(
      problemsIn("<Sequence><SetBlackboard value=\"1;2\" output_key=\"traget\"/><Fly goal=\"{target}\"/></Sequence>"),
      ElementsAre(At("3:64 Fly.goal", "tree.entry-unset", "{target}", "`traget`?")));
  EXPECT_THAT(
      problemsIn(
          "<Sequence>\n<SetBlackboard value=\"here\" output_key=\"target\"/><Fly goal=\"{target}\"/></Sequence>"),
      ElementsAre(At("4:16 value", "tree.value-type", "`here`", "{target}")));
  EXPECT_THAT(
      problemsIn(
          "<Sequence><SetBlackboard value=\"9\" output_key=\"a\"/><SetBlackboard value=\"{a}\" output_key=\"b\"/>"
          "<Fly goal=\"1;2\" clearance_m=\"{b}\"/></Sequence>"),
      ElementsAre(At("3:26 value", "tree.value-range", "`9`")));
  EXPECT_THAT(problemsIn("<Sequence><Fly goal=\"1;2\" flown_m=\"{d}\"/><Fly goal=\"{d}\"/></Sequence>"),
              ElementsAre(At("3:47 Fly.goal", "tree.entry-type", "{d}")));
}

TEST(Problems, MistakesInRootAndTreesAreReported) {
  EXPECT_THAT(problemsOf("<rot BTCPP_format=\"4\"/>"), ElementsAre(At("1:1 rot", "tree.outermost-element")));
  EXPECT_THAT(problemsOf("<root main_tree_to_execute=\"A\"/>"), ElementsAre(At("1:7 root", "tree.unknown-tree")));
  EXPECT_THAT(problemsOf("<root BTCPP_format=\"3\"/>"),
              ElementsAre(At("1:7 root", "tree.other-format", "`swiftlet migrate f.xml`")));
  EXPECT_THAT(problemsOf("<root BTCPP_format=\"5\"/>"), ElementsAre(At("1:7 root", "tree.other-format")));
  EXPECT_THAT(problemsOf("<root BTCPP_format=\"4\"/>"), ElementsAre(At("1:1 root", "tree.no-tree")));
  const std::string two =
      "<BehaviorTree ID=\"A\"><AlwaysSuccess/></BehaviorTree>\n<BehaviorTree "
      "ID=\"B\"><AlwaysSuccess/></BehaviorTree></root>";
  EXPECT_THAT(problemsOf("<root BTCPP_format=\"4\">" + two),
              ElementsAre(At("1:1 root", "tree.main-missing", "main_tree_to_execute=\"A\"", "`B`")));
  EXPECT_THAT(problemsOf("<root BTCPP_format=\"4\" main_tree_to_execute=\"Flight\">" + two),
              ElementsAre(At("1:24 root", "tree.unknown-tree", "main_tree_to_execute=\"A\"")));
  EXPECT_THAT(problemsOf("<root BTCPP_format=\"4\" main_tree_to_execute=\"a\">" + two),
              ElementsAre(At("1:24 root", "tree.unknown-tree", "`A`?")));
  EXPECT_THAT(
      problemsOf("<root BTCPP_format=\"4\" main_tree_to_exectue=\"A\">\n" + two),
      ElementsAre(At("1:24 root", "tree.unknown-attribute", "`main_tree_to_exectue`", "`main_tree_to_execute`?"),
                  At("1:1 root", "tree.main-missing")));
  EXPECT_THAT(problemsOf("<root BTCPP_format=\"4\" main_tree_to_execute=\"A\">" + two.substr(0, two.size() - 7) +
                         "<BehaviorTree ID=\"A\"><AlwaysSuccess/></BehaviorTree><BehaviourTree/></root>"),
              ElementsAre(At("2:53 BehaviorTree", "tree.defined-twice", "f.xml:1:49"),
                          At("2:105 BehaviourTree", "tree.unknown-element", "`BehaviorTree`?")));
  EXPECT_THAT(
      problemsOf("<root BTCPP_format=\"4\">\n<BehaviorTree ID=\"A\" main_tree_to_execute=\"A\" _favorite=\"true\" "
                 "id=\"a\"><AlwaysSuccess/></BehaviorTree></root>"),
      ElementsAre(At("2:22 BehaviorTree", "tree.unknown-attribute", "`main_tree_to_execute`"),
                  At("2:64 BehaviorTree", "tree.unknown-attribute", "`id`", "`ID`?")));
  EXPECT_THAT(problemsIn("<AlwaysSuccess/>", "<BehaviorTree><AlwaysSuccess/></BehaviorTree>"),
              ElementsAre(At("5:1 BehaviorTree", "tree.attribute-missing", "`ID`")));
  EXPECT_THAT(problemsIn("<AlwaysSuccess/>", "<BehaviorTree ID=\"Fly\"><AlwaysSuccess/></BehaviorTree>"),
              ElementsAre(At("5:15 BehaviorTree", "tree.id-is-type", "`Fly`")));
}

TEST(Problems, UnsupportedFeaturesAreReportedAndNotIgnored) {
  EXPECT_THAT(problemsIn("<AlwaysSuccess _skipif=\"x==1\"/>"),
              ElementsAre(At("3:16 AlwaysSuccess", "tree.unknown-attribute", "`_skipif`", "`_skipIf`?")));
  EXPECT_THAT(problemsIn("<AlwaysSuccess _onsucess=\"x:=1\"/>"),
              ElementsAre(At("3:16 AlwaysSuccess", "tree.unknown-attribute", "`_onSuccess`?")));
  EXPECT_THAT(
      problemsIn("<SubTree ID=\"S\" _autoremaps=\"1\"/>", "<BehaviorTree ID=\"S\"><Fly goal=\"1;1\"/></BehaviorTree>"),
      ElementsAre(At("3:17 SubTree", "tree.unknown-attribute", "`_autoremap`?")));
  EXPECT_THAT(problemsOf("<!DOCTYPE root [<!ENTITY a \"b\">]><root BTCPP_format=\"4\"/>"),
              ElementsAre(At("1:16 <!DOCTYPE>", "tree.xml-doctype")));
  EXPECT_THAT(problemsIn("<AlwaysSuccess/>", "<include ros_pkg=\"p\" path=\"x.xml\"/>"),
              ElementsAre(At("5:10 include", "tree.ros-package")));
}

TEST(Problems, AllAreReportedTogether) {
  EXPECT_THAT(problemsIn("<Sequence>\n<Flly/>\n<Fly/>\n<Inverter/>\n<SubTree ID=\"no\"/></Sequence>"),
              ElementsAre(At("4:1 Flly", "tree.unknown-node"), At("5:1 Fly", "tree.port-missing"),
                          At("6:1 Inverter", "tree.children-count"), At("7:10 SubTree", "tree.unknown-tree")));
}

TEST(Problems, WhatThePortsOfTheEngineNeedIsReportedWithAllElse) {
  EXPECT_THAT(
      problemsIn("<Sequence>\n<Precondition if=\"true\" else=\"running\"><AlwaysSuccess/></Precondition>\n"
                 "<LoopInt queue=\"1\" if_empty=\"1\"><AlwaysSuccess/></LoopInt>\n<Switch2><AlwaysSuccess/></Switch2>\n"
                 "<TryCatch><AlwaysSuccess/></TryCatch>\n<WhileDoElse><AlwaysSuccess/></WhileDoElse>\n"
                 "<ParallelAll max_failures=\"2\"><AlwaysSuccess/></ParallelAll>\n<TestNode return_status=\"IDLE\"/>\n"
                 "<Nope/></Sequence>"),
      ElementsAre(
          At("4:25 Precondition.else", "tree.value-type", "`running`", "`RUNNING`?"),
          At("5:20 LoopInt.if_empty", "tree.value-type", "`1`"), At("6:1 Switch2", "tree.children-count", "exactly 3"),
          At("7:1 TryCatch", "tree.children-count", "at least 2"),
          At("8:1 WhileDoElse", "tree.children-count", "2 or 3"), At("9:14 ParallelAll", "tree.count-unreachable"),
          At("10:11 TestNode.return_status", "tree.value-type", "`IDLE`"), At("11:1 Nope", "tree.unknown-node")));
}

TEST(Problems, ACountThatNeedsNoChildIsAWarning) {
  const auto warningsOf = [](const std::string& node) {
    const ParseResult result =
        parseText(file(node + "<AlwaysSuccess/><AlwaysSuccess/></" + node.substr(1, node.find(' ') - 1) + ">"), "f.xml",
                  Registry::standard());
    EXPECT_TRUE(result.tree.has_value()) << toString(result.problems);
    return result.warnings;
  };
  EXPECT_THAT(warningsOf("<Parallel failure_count=\"0\">"),
              ElementsAre(At("3:11 Parallel", "tree.count-at-once", "failure_count")));
  EXPECT_THAT(warningsOf("<Parallel success_count=\"0\" failure_count=\"-3\">"),
              ElementsAre(At("3:11 Parallel", "tree.count-at-once"), At("3:29 Parallel", "tree.count-at-once")));
  EXPECT_EQ(warningsOf("<ParallelAll max_failures=\"0\">").size(), 1U);
  EXPECT_THAT(warningsOf("<Parallel success_count=\"-2\" failure_count=\"2\">"), ElementsAre());
}

TEST(Problems, AListThatNamesNoTreeIsNotMissedTwice) {
  const std::string tree = "<BehaviorTree><AlwaysSuccess/></BehaviorTree>";
  EXPECT_THAT(problemsOf("<root BTCPP_format=\"4\">" + tree + tree + "</root>"),
              ElementsAre(At("1:24 BehaviorTree", "tree.attribute-missing"),
                          At("1:69 BehaviorTree", "tree.attribute-missing")));
  EXPECT_EQ(problemsOf("<root BTCPP_format=\"4\" main_tree_to_execute=\"A\">" + tree + tree + "</root>").size(), 2U);
  EXPECT_THAT(problemsOf("<root BTCPP_format=\"4\"><BehaviorTree ID=\"\"><AlwaysSuccess/></BehaviorTree></root>"),
              ElementsAre(At("1:38 BehaviorTree", "tree.id-empty")));
  EXPECT_THAT(problemsOf("<root BTCPP_format=\"4\"><include path=\"none.xml\"/></root>"),
              ElementsAre(At("1:33 include", "tree.include-unreadable", "`none.xml`")));
}

TEST(Problems, ALongListIsShortened) {
  std::string inside = "<Sequence>";
  for (int i = 0; i < 1000; ++i) inside += "<Nope/>";
  const auto problems = problemsIn(inside + "</Sequence>");
  EXPECT_EQ(problems.size(), 101U);
  EXPECT_EQ(problems.back().message.name(), "tree.more-problems");
}

TEST(Problems, ColumnsCountCharacters) {
  EXPECT_THAT(problemsIn("<Sequence name=\"größer\"><Flly/></Sequence>"),
              ElementsAre(At("3:25 Flly", "tree.unknown-node")));
  EXPECT_THAT(problemsOf("\xEF\xBB\xBF<rot/>"), ElementsAre(At("1:1 rot", "tree.outermost-element")));
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
  EXPECT_THAT(problemsIn(nested(200)), ElementsAre(At("3:2001 AlwaysSuccess", "tree.elements-deep")));
  EXPECT_THAT(problemsIn(nested(100'000)), ElementsAre(At("3:2001 Inverter", "tree.elements-deep")));
  std::string more = "<BehaviorTree ID=\"T0\"><AlwaysSuccess/></BehaviorTree>\n";
  for (int i = 1; i < 300; ++i)
    more += "<BehaviorTree ID=\"T" + std::to_string(i) + "\"><SubTree ID=\"T" + std::to_string(i - 1) +
            "\"/></BehaviorTree>\n";
  EXPECT_THAT(problemsIn("<SubTree ID=\"T299\"/>", more), ElementsAre(At("105:25 SubTree", "tree.nodes-deep")));
}

TEST(Limits, ExpandedSubTreesAreLimited) {
  std::string more = "<BehaviorTree ID=\"T0\"><AlwaysSuccess/></BehaviorTree>\n";
  for (int i = 1; i < 40; ++i) {
    const std::string use = "<SubTree ID=\"T" + std::to_string(i - 1) + "\"/>";
    more +=
        "<BehaviorTree ID=\"T" + std::to_string(i) + "\"><Sequence>" + use + use + use + "</Sequence></BehaviorTree>\n";
  }
  EXPECT_THAT(problemsIn("<SubTree ID=\"T39\"/>", more), ElementsAre(At("6:51 SubTree", "tree.nodes-many")));
}

TEST(Limits, TheSizeOfAFileIsLimited) {
  EXPECT_THAT(problemsOf(std::string((std::size_t{8} << 20) + 1, ' ')),
              ElementsAre(At("f.xml", "tree.file-large", "8388608")));
}

}  // namespace
}  // namespace swiftlet::tree::testing

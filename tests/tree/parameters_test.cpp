// The values of a file that are changed from flight to flight: listed, and written back without touching the rest.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "behaviors/tree/parameters.hpp"
#include "tests/tree/story.hpp"

namespace swiftlet::tree::testing {
namespace {

using ::testing::ElementsAre;

Registry goingRegistry() {
  Registry registry = Registry::standard();
  const auto build = registry.find("AlwaysSuccess")->build;
  registry.add(
      {.id = "Go",
       .kind = NodeKind::kAction,
       .ports =
           {{.name = "goal", .type = PortType::kPoint, .required = true},
            {.name = "height_m", .type = PortType::kDouble, .default_value = "1.0", .minimum = 0.3, .maximum = 5.0},
            {.name = "flown_m", .type = PortType::kDouble, .direction = Direction::kOutput},
            {.name = "code", .type = PortType::kScript}}},
      build);
  return registry;
}

const std::string kFile =
    "<root BTCPP_format=\"4\" main_tree_to_execute=\"M\">\n  <!-- two places -->\n  <BehaviorTree ID=\"M\">\n    "
    "<Sequence>\n      <Go goal=\"1;2\"  height_m='0.8'/>\n      <Go goal=\"3;4\" code=\"a := 1\"/>\n      "
    "<Action ID=\"Go\" name=\"far\" goal=\"{place}\"/>\n      <Sleep msec=\"5\"/>\n    </Sequence>\n  "
    "</BehaviorTree>\n</root>\n";

std::vector<std::string> listed() {
  std::vector<std::string> lines;
  for (const Parameter& parameter : parametersOf(kFile, "f.xml", goingRegistry()))
    lines.push_back(parameter.key + " = " + parameter.value);
  return lines;
}

Changed change(const std::map<std::string, std::string>& values) {
  return withParameters(kFile, "f.xml", goingRegistry(), values);
}
std::string changed(const std::map<std::string, std::string>& values) { return change(values).text; }

/// kFile with one text in place of another.
std::string with(const std::string& old, const std::string& now) {
  std::string text = kFile;
  return text.replace(text.find(old), old.size(), now);
}

TEST(Parameters, AreTheInputsOfTheLeavesThatAreNotOfTheEngine) {
  EXPECT_THAT(listed(), ElementsAre("M/Sequence/Go[1].goal = 1;2", "M/Sequence/Go[1].height_m = 0.8",
                                    "M/Sequence/Go[2].goal = 3;4", "M/Sequence/Go[2].height_m = 1.0",
                                    "M/Sequence/far.height_m = 1.0"));
  EXPECT_TRUE(parametersOf("<root", "f.xml", goingRegistry()).empty());
}

TEST(Parameters, HaveTheNamesOfPaths) {
  const Registry registry = goingRegistry();
  ParseOptions options;
  options.host_entries = {"place"};
  const ParseResult parsed = parseText(kFile, "f.xml", registry, options);
  ASSERT_TRUE(parsed.tree.has_value()) << toString(parsed.problems);
  EXPECT_EQ(parsed.tree->pathOf(2), "M/Sequence/Go[2]");
}

TEST(Parameters, AreWrittenInPlace) {
  EXPECT_EQ(changed({}), kFile);
  EXPECT_EQ(changed({{"M/Sequence/Go[2].goal", "-1;0.5"}}), with("3;4", "-1;0.5"));
  EXPECT_EQ(changed({{"M/Sequence/Go[1].height_m", "2"}}), with("0.8", "2"));
  EXPECT_EQ(changed({{"M/Sequence/Go[2].height_m", "1.5"}}),
            with("<Go goal=\"3;4\"", "<Go height_m=\"1.5\" goal=\"3;4\""));
  EXPECT_EQ(changed({{"M/Sequence/far.height_m", "1.5"}}), with("<Action ID", "<Action height_m=\"1.5\" ID"));
  EXPECT_EQ(changed({{"M/Sequence/Go[1].height_m", ""}}), with("  height_m='0.8'", "  ")) << "taken away";
  EXPECT_EQ(changed({{"M/Sequence/Go[2].height_m", "1.0"}}), kFile) << "the default is not written out";
}

TEST(Parameters, ThatDoNotFitAreRefused) {
  const auto refusal = [](const std::string& key, const std::string& value) { return change({{key, value}}).problems; };
  EXPECT_THAT(refusal("M/Sequence/Go[1].height_m", "9"),
              ElementsAre(At("5:23 M/Sequence/Go[1].height_m", "tree.value-range", "`9`")));
  EXPECT_THAT(refusal("M/Sequence/Go[1].goal", ""),
              ElementsAre(At("5:11 M/Sequence/Go[1].goal", "tree.parameter-required")));
  EXPECT_THAT(refusal("M/Sequence/Go[2].gaol", "1;2"),
              ElementsAre(At("f.xml M/Sequence/Go[2].gaol", "tree.unknown-parameter", "`M/Sequence/Go[2].goal`?")));
  EXPECT_THAT(refusal("M/Sequence/Go[1].goal", "1;2\" x=\"3"),
              ElementsAre(At("5:11 M/Sequence/Go[1].goal", "tree.value-type")));
  EXPECT_THAT(refusal("M/Sequence/Sleep.msec", "7"),
              ElementsAre(At("f.xml M/Sequence/Sleep.msec", "tree.unknown-parameter")));
}

}  // namespace
}  // namespace swiftlet::tree::testing

// Groot2 writes every port of a node, port="" where it has no value: that is as if the port were not written.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "behaviors/tree/parameters.hpp"
#include "tests/tree/story.hpp"

namespace swiftlet::tree::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// A leaf with a port of each type.
Registry withPorts() {
  Registry registry = Registry::standard();
  NodeManifest manifest{.id = "Fly",
                        .kind = NodeKind::kAction,
                        .ports = {{.name = "goal", .type = PortType::kPoint, .required = true},
                                  {.name = "height_m", .type = PortType::kDouble, .minimum = 0.3},
                                  {.name = "tries", .type = PortType::kInt, .default_value = "3"},
                                  {.name = "careful", .type = PortType::kBool},
                                  {.name = "patience_s", .type = PortType::kDuration, .default_value = "5"},
                                  {.name = "bounds", .type = PortType::kRectangle},
                                  {.name = "path", .type = PortType::kPoints},
                                  {.name = "mode", .choices = {"fast", "slow"}},
                                  {.name = "file"},
                                  {.name = "flown_m", .type = PortType::kDouble, .direction = Direction::kOutput}},
                        .description = "Flies."};
  registry.add(manifest, registry.find("AlwaysSuccess")->build);
  return registry;
}

std::vector<Problem> problemsIn(const std::string& inside, const std::string& more = {}) {
  const Registry registry = withPorts();
  return parseText(file(inside, more), "f.xml", registry).problems;
}

constexpr const char* kEmptyPorts =
    "height_m=\"\" tries=\"\" careful=\" \" patience_s=\"\" bounds=\"\" path=\"\n\" mode=\"\" file=\"\" flown_m=\"\"";

TEST(EmptyPorts, AreAsNotGiven) {
  EXPECT_THAT(problemsIn("<Fly goal=\"1;2\" " + std::string(kEmptyPorts) + " name=\"\" _skipIf=\"\" _onSuccess=\"\"/>"),
              IsEmpty());
  EXPECT_THAT(problemsIn("<Parallel success_count=\"\" failure_count=\"\"><AlwaysSuccess/></Parallel>"), IsEmpty());
  EXPECT_THAT(problemsIn("<TestNode return_status=\"SUCCESS\" async_delay_msec=\"\" success_script=\"\"/>"), IsEmpty());
  Story delayed("<Sequence><TestNode return_status=\"SUCCESS\" async_delay_msec=\"\"/><A/></Sequence>");
  EXPECT_EQ(delayed.says("A", "SUCCESS").tick(), "SUCCESS: start A");
}

TEST(EmptyPorts, ThatMustBeGivenAreTold) {
  EXPECT_THAT(problemsIn("<Fly goal=\"\"/>"), ElementsAre(At("3:6 Fly", "tree.port-missing", "`goal`")));
  EXPECT_THAT(problemsIn("<Script code=\"\"/>"), ElementsAre(At("3:9 Script", "tree.port-missing", "`code`")));
  EXPECT_THAT(problemsIn("<SetBlackboard value=\"1\" output_key=\"\"/>"),
              ElementsAre(At("3:26 SetBlackboard", "tree.port-missing", "`output_key`")));
}

TEST(EmptyPorts, OfTextThatMustBeGivenAreTheEmptyText) {
  Story story("<Sequence><SetBlackboard value=\"\" output_key=\"s\"/><ScriptCondition code=\"s == ''\"/></Sequence>");
  EXPECT_EQ(story.tick(), "SUCCESS");
  Story chosen("<Switch2 variable=\"x\" case_1=\"\" case_2=\"x\"><A/><B/><C/></Switch2>");
  EXPECT_EQ(chosen.says("B", "SUCCESS").tick(), "SUCCESS: start B");
}

TEST(EmptyPorts, OfASubTreeTakeTheDefaultOfItsModel) {
  const std::string inside = "<BehaviorTree ID=\"S\"><ScriptCondition code=\"n == 5\"/></BehaviorTree>";
  const std::string model =
      "<TreeNodesModel><SubTree ID=\"S\"><input_port name=\"n\" default=\"5\"/></SubTree></TreeNodesModel>";
  EXPECT_EQ(Story("<SubTree ID=\"S\" n=\"\" name=\"\" _autoremap=\"\"/>", inside + model).tick(), "SUCCESS");
  EXPECT_EQ(
      Story("<SubTree ID=\"S\" n=\"\"/>", "<BehaviorTree ID=\"S\"><ScriptCondition code=\"n == ''\"/></BehaviorTree>")
          .tick(),
      "SUCCESS")
      << "without a default it is the empty text";
}

TEST(EmptyPorts, AreParametersWithTheirDefault) {
  const std::string text = file("<Fly goal=\"1;2\" tries=\"\" height_m=\"\"/>");
  std::vector<std::string> values;
  for (const Parameter& parameter : parametersOf(text, "f.xml", withPorts()))
    if (parameter.port->name == "tries" || parameter.port->name == "height_m") values.push_back(parameter.value);
  EXPECT_THAT(values, ElementsAre("", "3"));
  EXPECT_THAT(withParameters(text, "f.xml", withPorts(), {{"Main/Fly.height_m", "1.5"}}).text,
              HasSubstr("<Fly goal=\"1;2\" tries=\"\" height_m=\"1.5\"/>"));
}

}  // namespace
}  // namespace swiftlet::tree::testing

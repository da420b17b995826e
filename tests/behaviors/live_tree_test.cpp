// The tree as the page shows it: ports with what they have now, the last reason and the duration of each node.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "behaviors/live_tree.hpp"
#include "tests/behaviors/flight.hpp"
#include "tests/tree/story.hpp"

namespace swiftlet::behaviors::testing {
namespace {

using ::testing::ElementsAre;

/// A tree of stand-ins with its live view, a tenth of a second a tick.
class Shown {
 public:
  explicit Shown(const std::string& inside) : story_(inside), live_(story_.tree()) {}

  Shown& says(std::string_view actor, std::string_view what) {
    story_.says(actor, what);
    return *this;
  }
  void tick(double seconds) {
    const auto now = common::Time::fromSeconds(seconds);
    live_.setNow(now);
    tree::TickContext context(now.nanoseconds());
    context.observer = &live_;
    story_.tree().tick(context);
  }
  common::TreeNodeView node(const std::string& name) {
    for (const common::TreeNodeView& node : live_.view())
      if (node.name == name) return node;
    ADD_FAILURE() << name;
    return {};
  }

 private:
  tree::testing::Story story_;
  LiveTree live_;
};

TEST(LiveTrees, SayHowLongANodeTook) {
  Shown shown("<Sequence><A/><B/></Sequence>");
  EXPECT_EQ(shown.node("A").began_s, std::nullopt);
  shown.says("A", "RUNNING").tick(1.0);
  EXPECT_EQ(shown.node("A").status, "RUNNING");
  EXPECT_EQ(shown.node("A").began_s, 1.0);
  EXPECT_EQ(shown.node("A").duration_s, std::nullopt);
  shown.says("A", "SUCCESS").says("B", "FAILURE").tick(3.5);
  EXPECT_EQ(shown.node("A").duration_s, 2.5);
  EXPECT_EQ(shown.node("B").began_s, 3.5);
  EXPECT_EQ(shown.node("B").duration_s, 0.0);
  EXPECT_EQ(shown.node("Sequence").duration_s, 2.5);
  // Anew: A begins, and is under way again.
  shown.says("A", "RUNNING").tick(5.0);
  EXPECT_EQ(shown.node("A").began_s, 5.0);
  EXPECT_EQ(shown.node("A").duration_s, std::nullopt);
  EXPECT_EQ(shown.node("B").status, "IDLE");
  EXPECT_EQ(shown.node("B").duration_s, 0.0) << "of the last run";
}

TEST(LiveTrees, KeepTheLastReasonUntilSuccess) {
  Shown shown("<Priority><A/><Timeout msec=\"1000\"><B/></Timeout></Priority>");
  shown.says("A", "nothing").says("B", "RUNNING").tick(0.0);
  EXPECT_EQ(shown.node("Timeout").reason, "B wants") << "why it got the vehicle";
  shown.tick(2.0);
  EXPECT_EQ(shown.node("Timeout").status, "FAILURE");
  EXPECT_EQ(shown.node("Timeout").reason, "timed out after 1 s");
  shown.says("B", "SUCCESS").tick(3.0);
  EXPECT_EQ(shown.node("Timeout").reason, "");
}

TEST(LiveTrees, ShowWhatThePortsHaveNow) {
  Shown shown(
      "<Sequence><Script code=\"n := 4\"/><A/><SetBlackboard value=\"{n}\" output_key=\"copy\"/>"
      "<UnsetBlackboard key=\"n\"/></Sequence>");
  const auto portsOf = [&](const std::string& name) {
    std::vector<std::string> texts;
    for (const common::TreePortView& port : shown.node(name).ports)
      texts.push_back(port.name + "|" + port.entry + "|" + port.value.value_or("not set"));
    return texts;
  };
  EXPECT_THAT(portsOf("Script"), ElementsAre("code||n := 4"));
  EXPECT_THAT(portsOf("SetBlackboard"), ElementsAre("value|n|not set", "output_key|copy|not set"));
  shown.says("A", "RUNNING").tick(0.0);
  EXPECT_THAT(portsOf("SetBlackboard"), ElementsAre("value|n|4", "output_key|copy|not set"));
  shown.says("A", "SUCCESS").tick(0.1);
  EXPECT_THAT(portsOf("SetBlackboard"), ElementsAre("value|n|not set", "output_key|copy|4"));
}

TEST(LiveTrees, OfMissionsNameTypesAndDefaults) {
  Flight flight(
      Mission::fromText("<root BTCPP_format=\"4\"><BehaviorTree ID=\"M\"><Sequence><TakeOff name=\"up\" "
                        "height_m=\"1.2\"/><Land/></Sequence></BehaviorTree></root>",
                        "m.xml"));
  flight.tick();
  const common::TreeNodeView& node = flight.mission.view().at(1);
  EXPECT_EQ(node.name, "up");
  EXPECT_EQ(node.type, "TakeOff");
  EXPECT_EQ(node.status, "RUNNING");
  EXPECT_THAT(node.ports.at(0), (common::TreePortView{"height_m", "", "1.2"}));
}

TEST(LiveTrees, ShowTheTreeOfASubTreeAndScriptedConditions) {
  tree::testing::Story story(R"(<Sequence><SubTree ID="Visit" name="first" _skipIf="1 > 2"/></Sequence>)",
                             R"(<BehaviorTree ID="Visit"><A _onSuccess="n := 1"/></BehaviorTree>)");
  ASSERT_TRUE(story.problems().empty());
  LiveTree live(story.tree());
  const common::TreeView view = live.view();
  EXPECT_EQ(view[1].name, "first");
  EXPECT_EQ(view[1].ports, (std::vector<common::TreePortView>{{"ID", {}, "Visit"}, {"_skipIf", {}, "1 > 2"}}));
  EXPECT_EQ(view[2].ports, (std::vector<common::TreePortView>{{"_onSuccess", {}, "n := 1"}}));
}

}  // namespace
}  // namespace swiftlet::behaviors::testing

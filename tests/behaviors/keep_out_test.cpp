// KeepOut, tick by tick; the test plays the autonomy.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/behaviors/check_text.hpp"
#include "tests/behaviors/flight.hpp"

namespace swiftlet::behaviors::testing {
namespace {

using ::testing::HasSubstr;

TEST(KeepOut, AsksOnceAndWaitsForTheAnswer) {
  Flight flight(R"(<KeepOut polygon="1;0 | 3;0 | 3;2;9"/>)");
  EXPECT_EQ(flight.tick(), "RUNNING") << "no intent: it does not want the vehicle";
  ASSERT_EQ(flight.context.requests.size(), 1u);
  const auto& asked = std::get<common::KeepOutRequest>(flight.context.requests[0].kind);
  EXPECT_EQ(asked.area, (common::Polygon{{{1, 0}, {3, 0}, {3, 2}}}));
  const std::uint64_t id = flight.context.requests[0].id;
  flight.context.requests.clear();
  flight.context.answers = {{id + 1, false, "of another node"}};
  EXPECT_EQ(flight.tick(), "RUNNING");
  EXPECT_TRUE(flight.context.requests.empty());
  flight.context.answers = {{id, true, ""}};
  EXPECT_EQ(flight.tick(), "DONE");
}

TEST(KeepOut, FailsWithTheReasonOfTheRefusal) {
  Flight flight(R"(<KeepOut polygon="1;0 | 3;0 | 3;2"/>)");
  flight.tick();
  flight.context.answers = {{flight.context.requests[0].id, false, "the take-off place would be in it"}};
  EXPECT_EQ(flight.tick(), "FAILED");
  EXPECT_EQ(flight.cause(), "KeepOut: the take-off place would be in it");
}

TEST(KeepOut, TheCheckRefusesWhatIsNoAreaAndOneThatHoldsHome) {
  const auto problem = [](const std::string& polygon) {
    const auto problems =
        checkMissionText(R"(<root BTCPP_format="4"><BehaviorTree ID="M"><Sequence><KeepOut polygon=")" + polygon +
                             R"("/><TakeOff/><Land/></Sequence></BehaviorTree></root>)",
                         "m.xml");
    return problems.empty() ? std::string() : toString(problems.front());
  };
  EXPECT_EQ(problem("1;0 | 3;0 | 3;2"), "") << "also before the take-off";
  EXPECT_THAT(problem("1;0 | 3;0"), HasSubstr("KeepOut.polygon: a polygon has at least 3 corners, not 2"));
  EXPECT_THAT(problem("1;0 | 3;2 | 3;0 | 1;2"), HasSubstr("edges of the polygon cross"));
  EXPECT_THAT(problem("-1;-1 | 3;-1 | 0;3"), HasSubstr("holds the take-off place 0;0"));
}

}  // namespace
}  // namespace swiftlet::behaviors::testing

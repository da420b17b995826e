// KeepOut, tick by tick; the test plays the autonomy.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/behaviors/check_text.hpp"
#include "tests/behaviors/flight.hpp"

namespace swiftlet::behaviors::testing {
namespace {

using ::testing::ElementsAre;

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
  const auto problems = [](const std::string& polygon) {
    return problemsInside("<KeepOut polygon=\"" + polygon + "\"/><TakeOff/><Land/>");
  };
  const auto refused = [](const char* name) { return ElementsAre(At("3:20 KeepOut.polygon", name)); };
  EXPECT_THAT(problems("1;0 | 3;0 | 3;2"), ElementsAre()) << "also before the take-off";
  EXPECT_THAT(problems("1;0 | 3;0"), refused("mission.polygon"));
  EXPECT_THAT(problems("1;0 | 3;2 | 3;0 | 1;2"), refused("mission.polygon"));
  EXPECT_THAT(problems("-1;-1 | 3;-1 | 0;3"), refused("mission.home-kept-out"));
}

}  // namespace
}  // namespace swiftlet::behaviors::testing

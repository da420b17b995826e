// Events that must come in an order, with the vehicle where they must.
#include "evaluation/event_order.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace swiftlet::evaluation {
namespace {

using common::Time;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const EventOrderConfig kUpAndDown{"lift", {{"lift up", {0.0, 0.0, 0.5}, {1.0, 1.0, 1.5}}, {"lift down", {}, {}}}};

std::vector<std::string> missedBy(const std::vector<std::pair<std::string, Eigen::Vector3d>>& events) {
  EventOrderRecorder recorder(kUpAndDown);
  double time_s = 1.0;
  for (const auto& [text, place_m] : events)
    recorder.event({Time::fromSeconds(time_s += 1.0), common::Severity::kInfo, "test", text, ""}, place_m);
  return recorder.finish().missed();
}

TEST(EventOrder, HoldsForTheseEventsInThisOrderAtTheirPlaces) {
  EXPECT_THAT(missedBy({{"lift up", {0.5, 0.5, 1.0}}, {"other", {9, 9, 9}}, {"lift down", {7, 7, 7}}}), IsEmpty());
}

TEST(EventOrder, SaysWhatCameOtherwise) {
  EXPECT_THAT(missedBy({}), ElementsAre("`lift up` did not come", "`lift down` did not come"));
  EXPECT_THAT(missedBy({{"lift down", {0, 0, 0}}, {"lift up", {0.5, 0.5, 1.0}}}),
              ElementsAre(HasSubstr("`lift up` was to come, not `lift down` at 2.0 s"), HasSubstr("`lift down` was")));
  EXPECT_THAT(missedBy({{"lift up", {0.5, 0.5, 1.6}}, {"lift down", {0, 0, 0}}}),
              ElementsAre(HasSubstr("not at its place: `lift up` at 2.0 s, (0.50, 0.50, 1.60) m")));
  EXPECT_THAT(missedBy({{"lift up", {0.5, 0.5, 1.0}}, {"lift down", {0, 0, 0}}, {"lift up", {0.5, 0.5, 1.0}}}),
              ElementsAre(HasSubstr("one event too many: `lift up` at 4.0 s")));
}

TEST(EventOrder, ABoxHasTwoCornersAndAnEventTheText) {
  EXPECT_FALSE((ExpectedEvent{"lift up", {0.0, 0.0, 0.5}, {}}).validate().empty());
  EXPECT_FALSE((ExpectedEvent{"lift up", {0.0}, {1.0}}).validate().empty());
  EXPECT_FALSE((EventOrderConfig{"lift", {{"drop", {}, {}}}}).validate().empty());
  EXPECT_TRUE(kUpAndDown.validate().empty());
}

}  // namespace
}  // namespace swiftlet::evaluation

// The judge of flights: from facts to a verdict, and from records to facts.
#include "evaluation/verdict.hpp"

#include "evaluation/true_world.hpp"
#include "evaluation/verdict_facts.hpp"

#include <filesystem>
#include <sstream>

#include <gmock/gmock.h>

#include "common/read_bytes.hpp"
#include "evaluation/excuses.hpp"
#include "evaluation/flight_score.hpp"
#include "small_world.hpp"

namespace swiftlet::evaluation {
namespace {

using common::MissionState;
using testing::HasSubstr;

TEST(Verdicts, OfADoneMissionIsDoneWhateverIsLeft) {
  VerdictFacts facts;
  facts.mission_done = facts.flew = true;
  facts.charge = 0.05;
  EXPECT_EQ(judge(facts).verdict, Verdict::kDone);
  facts.contact = ContactFacts{.what = "touched `wall`"};
  EXPECT_EQ(judge(facts).verdict, Verdict::kCrashed) << "a contact is one all the same";
}

/// A vehicle that stands away from home with no reason for it.
VerdictFacts landed() {
  VerdictFacts facts;
  facts.flew = true;
  facts.charge = 0.8;
  facts.home_share = 0.1;
  facts.thrust_margin = 1.6;
  facts.least_charge = 0.1;
  return facts;
}

TEST(Verdicts, EveryReasonMustBeConfirmedByTheTruth) {
  EXPECT_EQ(judge(landed()).verdict, Verdict::kNeedless);
  EXPECT_THAT(judge(landed()).reason, HasSubstr("80 % of the battery left"));
  const auto with = [](auto change) {
    VerdictFacts facts = landed();
    change(facts);
    EXPECT_EQ(judge(facts).verdict, Verdict::kLanded);
    return judge(facts).reason;
  };
  EXPECT_THAT(with([](VerdictFacts& f) { f.thrust_margin = 1.14; }), HasSubstr("1.14 times the weight"));
  EXPECT_THAT(with([](VerdictFacts& f) { f.charge = 0.29; }), HasSubstr("29 % of the battery was left, 10 % to fly"));
  EXPECT_THAT(with([](VerdictFacts& f) { f.least_charge = 0.71; }), HasSubstr("71 % to keep"));
  EXPECT_EQ(with([](VerdictFacts& f) { f.order = "land"; }), "land");
  EXPECT_EQ(with([](VerdictFacts& f) { f.faulty_sensor = "imu"; }), "imu failed");
  EXPECT_EQ(with([](VerdictFacts& f) { f.goal_reachable = false; }), "no path leads to the goal");
  EXPECT_THAT(with([](VerdictFacts& f) { f.position_error_m = 0.6; }), HasSubstr("0.60 m off"));
  EXPECT_THAT(with([](VerdictFacts& f) { f.position_seen = false; }), HasSubstr("too little"));
  EXPECT_THAT(with([](VerdictFacts& f) { f.floor_seen = false; }), HasSubstr("floor"));
}

TEST(Verdicts, DependOnWhereAVehicleWithAReasonStands) {
  VerdictFacts facts = landed();
  facts.charge = 0.25;
  facts.at_home = true;
  EXPECT_EQ(judge(facts).verdict, Verdict::kHome);
  facts.inside = false;
  EXPECT_EQ(judge(facts).verdict, Verdict::kOutside);
  facts.in_the_air = true;
  EXPECT_EQ(judge(facts).verdict, Verdict::kUnfinished);
}

TEST(Verdicts, OfALandingNeedMotorsThatAreOff) {
  VerdictFacts facts = landed();
  facts.order = "land";
  EXPECT_EQ(judge(facts).verdict, Verdict::kLanded);
  facts.motors_off = false;
  EXPECT_EQ(judge(facts).verdict, Verdict::kUnfinished);
}

TEST(Verdicts, OfARefusedTakeOffNeedItsFigureToo) {
  VerdictFacts facts = landed();
  facts.flew = false;
  EXPECT_EQ(judge(facts).verdict, Verdict::kNeedless);
  facts.thrust_margin = 1.05;
  EXPECT_EQ(judge(facts).verdict, Verdict::kRefused);
}

TEST(Verdicts, AVehicleThatNeverFlewHasNotLeftTheBuilding) {
  VerdictFacts facts = landed();
  facts.flew = facts.inside = facts.position_seen = false;
  EXPECT_EQ(judge(facts).verdict, Verdict::kRefused);
}

/// The verdict on a contact, in a flight that would otherwise have landed with every reason to.
Judgement judgeContact(const ContactFacts& contact) {
  VerdictFacts facts = landed();
  facts.order = "land";
  facts.faulty_sensor = "imu";
  facts.contact = contact;
  return judge(facts);
}

TEST(VerdictsOnContacts, NoFaultAndNoOrderExcusesOne) {
  EXPECT_EQ(judgeContact({.what = "stood on the floor"}).verdict, Verdict::kCrashed);
  EXPECT_EQ(judgeContact({.what = "stood on the floor"}).reason, "stood on the floor");
}

TEST(VerdictsOnContacts, LostThrustForcesThem) {
  ContactFacts contact{.what = "touched `wall`", .thrust_margin = 0.97, .thrust_margin_before = 1.05};
  EXPECT_EQ(judgeContact(contact).verdict, Verdict::kCrashed) << "it flew on with too little to climb with";
  contact.thrust_margin_before = 1.2;
  EXPECT_EQ(judgeContact(contact).verdict, Verdict::kForced);
  EXPECT_THAT(judgeContact(contact).reason, HasSubstr("fell to 0.97 times the weight, from 1.20"));
}

TEST(VerdictsOnContacts, GlassAndATakeOffWithoutRoomForceThem) {
  EXPECT_EQ(judgeContact({.what = "touched `pane`", .unseen_glass = true}).verdict, Verdict::kForced);
  EXPECT_EQ(judgeContact({.what = "touched `shelf`", .room_to_take_off = false}).verdict, Verdict::kForced);
}

TEST(VerdictsOnContacts, APersonIsToBlameWhoComesTooSuddenlyToEvade) {
  ContactFacts contact{.what = "touched `walker 1`", .by_person = true, .person_in_field_s = 0.3};
  EXPECT_EQ(judgeContact(contact).verdict, Verdict::kCrashed) << "it flew into the person";
  contact.yielding = contact.remains = true;
  EXPECT_EQ(judgeContact(contact).verdict, Verdict::kForced);
  contact.remains = false;
  EXPECT_EQ(judgeContact(contact).verdict, Verdict::kStruck) << "standing, or landing, would have avoided it";
  contact.remains = true;
  contact.person_in_field_s = 0.7;
  EXPECT_EQ(judgeContact(contact).verdict, Verdict::kStruck);
  contact.motors_off = true;
  EXPECT_EQ(judgeContact(contact).verdict, Verdict::kForced);
  contact.motors_off = false;
  contact.person_in_field_s.reset();
  EXPECT_EQ(judgeContact(contact).verdict, Verdict::kStruck) << "it did not look where the person came from";
}

TEST(Verdicts, AreAcceptableWhenNothingBetterCouldBeDone) {
  for (const Verdict good : {Verdict::kDone, Verdict::kHome, Verdict::kLanded, Verdict::kRefused, Verdict::kForced})
    EXPECT_TRUE(acceptable(good)) << toString(good);
  for (const Verdict bad :
       {Verdict::kStruck, Verdict::kNeedless, Verdict::kCrashed, Verdict::kOutside, Verdict::kUnfinished})
    EXPECT_FALSE(acceptable(bad)) << toString(bad);
}

/// With single spaces for every gap, so that line breaks do not matter.
std::string joined(const std::string& text) {
  std::istringstream words(text);
  std::string result;
  for (std::string word; words >> word;) result += word + ' ';
  return result;
}

TEST(Verdicts, HaveTheirExcusesInTheTutorial) {
  const std::filesystem::path page = std::filesystem::path(SWIFTLET_SOURCE_DIR) / "docs/tutorials/trials.md";
  const std::string text = joined(common::readText(page));
  for (const auto& excuse : contactExcuses()) EXPECT_THAT(text, HasSubstr(joined(excuse.why)));
  for (const auto& excuse : endingExcuses()) EXPECT_THAT(text, HasSubstr(joined(excuse.why)));
}

/// A flight of a minute in the small room that took off at (1, 1), used a tenth of its battery and stands at (1, 2).
class VerdictsOfRecords : public testing::Test {
 protected:
  VerdictsOfRecords() {
    record_.T_world_start.position_m = record_.T_world_map.position_m = {1, 1, 0};
    record_.cruise_height_world_m = 1.0;
    record_.mission.state = MissionState::kFailed;
    record_.true_distance_m = 30.0;
    record_.last_truth.T_world_body.position_m = {1, 2, 0.1};
    record_.last_truth.battery_remaining = 0.79;
    EndingRecord& ending = record_.ending;
    ending.flew = true;
    ending.then = record_.last_truth;
    ending.then.airborne = true;
    ending.then.T_world_body.position_m.z() = 1.0;
    ending.then.battery_remaining = 0.8;
    ending.charge_at_take_off = 0.9;
    ending.airborne_until_then_s = 60.0;
    ending.trail_world_m.assign(20, {1, 2, 1});
  }
  Judgement judged(const simulation::WorldModel& model = smallWorld(1.0F)) const {
    const simulation::RayCaster rays(model);
    TrueWorld world;
    world.rays = &rays;
    world.quadrotor.mass_share = mass_share_;
    world.reachable_area_max_m2 = reachable_area_max_m2_;
    return judge(factsOf(record_, world));
  }
  FlightRecord record_;
  double mass_share_ = 1.0;
  double reachable_area_max_m2_ = TrueWorld{}.reachable_area_max_m2;
};

TEST_F(VerdictsOfRecords, WithoutAReasonIsNeedless) { EXPECT_EQ(judged().verdict, Verdict::kNeedless); }

TEST_F(VerdictsOfRecords, ALowBatteryIsAReason) {
  record_.ending.then.battery_remaining = 0.2;
  EXPECT_EQ(judged().verdict, Verdict::kLanded);
  record_.last_truth.T_world_body.position_m.y() = 1.2;
  EXPECT_EQ(judged().verdict, Verdict::kHome);
}

// 0.1 of the battery for a minute of 0.5 m/s: the path round the wall, 4 m, and its stops take about 5 %.
TEST_F(VerdictsOfRecords, TheTruePathHomeCounts) {
  record_.ending.then.T_world_body.position_m = {3.2, 0.6, 1};
  record_.ending.then.battery_remaining = 0.24;
  record_.ending.charge_at_take_off = 0.34;
  EXPECT_EQ(judged().verdict, Verdict::kLanded);
  // The flood from the start is full before it is there, as where a door is open to the outside.
  reachable_area_max_m2_ = 1.0;
  EXPECT_EQ(judged().verdict, Verdict::kLanded);
  record_.ending.then.battery_remaining = 0.29;
  record_.ending.charge_at_take_off = 0.39;
  EXPECT_EQ(judged().verdict, Verdict::kNeedless);
}

TEST_F(VerdictsOfRecords, AWallRoundTheGoalIsAReason) {
  record_.ending.failed_goal_map_m = {2, 0};
  EXPECT_EQ(judged(smallWorld(1.0F)).verdict, Verdict::kNeedless) << "there is a gap";
  EXPECT_EQ(judged(smallWorld(0.0F)).verdict, Verdict::kLanded);
}

TEST_F(VerdictsOfRecords, ADoorThatWasClosedWhenTheGoalFailedIsAReason) {
  record_.ending.failed_goal_map_m = {2, 0};
  simulation::Actor door;  // In the gap of the wall before the goal.
  door.position_world_m = {2, 1.5};
  door.radius_m = 0.0;
  door.half_size_m = {0.05, 1.5};
  record_.ending.doors_at_failed_goal = {door};
  EXPECT_EQ(judged().verdict, Verdict::kLanded) << "though it is open again";
  record_.ending.then.closed_doors = {door};
  record_.ending.doors_at_failed_goal.clear();
  EXPECT_EQ(judged().verdict, Verdict::kNeedless) << "it was open then";
}

TEST_F(VerdictsOfRecords, OutsideIsWhereNothingEncloses) {
  simulation::WorldModel open = smallWorld(1.0F);
  std::erase_if(open.shapes, [](const simulation::Shape& shape) { return shape.model == "north"; });
  EXPECT_EQ(judged(open).verdict, Verdict::kNeedless) << "three walls enclose the room";
  record_.last_truth.T_world_body.position_m = {2, 8, 0.1};
  EXPECT_EQ(judged(open).verdict, Verdict::kOutside);
}

TEST_F(VerdictsOfRecords, WhatTheLaserCannotSeeIsAReason) {
  simulation::WorldModel corridor;
  corridor.shapes = {wall("left", -80, 0, 80, 0), wall("right", -80, 3, 80, 3), smallWorld(1.0F).shapes.back()};
  EXPECT_EQ(judged(corridor).verdict, Verdict::kLanded);
  EXPECT_THAT(judged(corridor).reason, HasSubstr("too little to fix"));
  record_.ending.trail_world_m.resize(2);
  EXPECT_EQ(judged(corridor).verdict, Verdict::kNeedless) << "one second is too short to matter";
}

TEST_F(VerdictsOfRecords, AMissingFloorIsAReason) {
  record_.ending.trail_world_m.assign(4, {1, 6, 1});
  for (Eigen::Vector3d& position : record_.ending.trail_world_m) position.y() = 2.9;
  EXPECT_EQ(judged().verdict, Verdict::kNeedless);
  simulation::WorldModel model = smallWorld(1.0F);
  for (auto& vertex : model.shapes.back().vertices_world_m) vertex.z() = -3.0F;
  EXPECT_THAT(judged(model).reason, HasSubstr("floor"));
}

TEST_F(VerdictsOfRecords, StillInTheAirIsUnfinished) {
  record_.last_truth.airborne = true;
  EXPECT_EQ(judged().verdict, Verdict::kUnfinished);
}

TEST_F(VerdictsOfRecords, MotorsThatAreOnAtTheEndAreUnfinished) {
  record_.ending.order = "land";
  EXPECT_EQ(judged().verdict, Verdict::kLanded);
  record_.motors_off = false;
  EXPECT_EQ(judged().verdict, Verdict::kUnfinished);
}

TEST_F(VerdictsOfRecords, ATakeOffThatPhysicsForbidsIsRefused) {
  record_.ending = {};
  record_.ending.then.battery_remaining = 0.9;
  EXPECT_EQ(judged().verdict, Verdict::kNeedless);
  record_.ending.then.battery_remaining = 0.05;
  EXPECT_EQ(judged().verdict, Verdict::kRefused);
}

/// A contact 0.8 m above (1, 1), where the vehicle had stood.
ContactRecord contactAt(common::FlightState flight) {
  ContactRecord contact;
  contact.what = contact.truth.crash_reason = "touched `shelf`";
  contact.truth.T_world_body.position_m = {1, 1, 0.8};
  contact.flight = flight;
  contact.stood_world_m = {1, 1, 0.15};
  contact.take_off_height_m = 1.2;
  return contact;
}

TEST_F(VerdictsOfRecords, AWallWithinTheHeightOfTheTakeOffForcesTheContact) {
  simulation::WorldModel model = smallWorld(1.0F);
  model.shapes.push_back(wall("shelf", 0.5, 1.2F, 1.5, 1.2F));
  record_.contact = contactAt(common::FlightState::kTakingOff);
  EXPECT_EQ(judged(model).verdict, Verdict::kForced);
  EXPECT_EQ(judged().verdict, Verdict::kCrashed) << "there is room";
  record_.contact->flight = common::FlightState::kFlying;
  EXPECT_EQ(judged(model).verdict, Verdict::kCrashed) << "it had taken off beside it";
}

TEST_F(VerdictsOfRecords, ARunawayClimbIntoTheCeilingIsNotForced) {
  simulation::WorldModel model = smallWorld(1.0F);
  simulation::Shape& ceiling = model.shapes.emplace_back(model.shapes.back());
  for (auto& vertex : ceiling.vertices_world_m) vertex.z() = 2.5F;
  record_.contact = contactAt(common::FlightState::kTakingOff);
  record_.contact->truth.T_world_body.position_m.z() = 2.4;
  record_.ending.faulty_sensor = "imu";
  EXPECT_EQ(judged(model).verdict, Verdict::kCrashed);
}

TEST_F(VerdictsOfRecords, ABatteryThatBreaksDownForcesTheContact) {
  record_.contact = contactAt(common::FlightState::kFlying);
  record_.contact->truth.battery_remaining = 0.0;
  mass_share_ = 1.05;
  record_.contact->charge_before = 0.8;
  EXPECT_EQ(judged().verdict, Verdict::kForced);
  record_.contact->charge_before = 0.01;
  EXPECT_EQ(judged().verdict, Verdict::kCrashed) << "it was empty long before";
  record_.contact->truth.battery_remaining = record_.contact->charge_before = 0.8;
  record_.contact->truth.lost_cells = 1;
  EXPECT_EQ(judged().verdict, Verdict::kForced) << "a cell was lost";
  record_.contact->lost_cells_before = 1;
  EXPECT_EQ(judged().verdict, Verdict::kCrashed) << "it was lost long before";
}

}  // namespace
}  // namespace swiftlet::evaluation

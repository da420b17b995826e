// A mission flown by hand: the test plays the autonomy, tick by tick.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "behaviors/mission.hpp"
#include "tests/support/layers.hpp"

namespace swiftlet::behaviors::testing {

class Flight {
 public:
  /// `inside` is the content of <BehaviorTree ID="M">.
  explicit Flight(const std::string& inside, const std::string& more = {});
  explicit Flight(Mission flown);

  /// 100 ms pass, one tick: "RUNNING 1 take off to 1.00 m" is the state and the intent with its id.
  std::string tick();
  /// The answers of the autonomy to the last intent at the next tick.
  Flight& runs();   ///< Under way, moving.
  Flight& stops();  ///< Under way; the vehicle has stopped.
  Flight& succeeds();
  Flight& fails(const std::string& reason);

  Flight& holds(bool hold, const std::string& reason = {});
  Flight& retreats(bool retreating, const std::string& reason = {});
  Flight& is(common::FlightState state);
  /// The pose in the given map; none if no map was given.
  Flight& localization(std::optional<common::LocalizationState> state);
  Flight& home(double x_m, double y_m);
  /// The vehicle is there, at its present height.
  Flight& at(double x_m, double y_m);
  Flight& change(const std::function<void(test::Layers&)>& change);
  /// A goal, or home, from the operator; the id of the command counts from 1.
  Flight& goal(double x_m, double y_m);
  Flight& homeCommand();
  Flight& command(common::OperatorCommand command);

  /// "text (reason)" of the events since the last call.
  std::vector<std::string> events();
  /// "1 accepted", "2 refused: reason" since the last call.
  std::vector<std::string> results();
  std::string view() const;
  /// Why the mission failed, without the path of the node: "Land: the motors are off".
  std::string cause() const { return last.reason.substr(0, last.reason.find(" [")); }

  Mission mission;
  Context context;
  TickResult last;

 private:
  using Layers = test::Layers;
  std::uint64_t commands_ = 0;
};

}  // namespace swiftlet::behaviors::testing

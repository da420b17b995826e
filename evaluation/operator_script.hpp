// An operator who follows a script: commands by time, or once something has happened. They take the same queue as those
// of the page, and what the vehicle answers is noted.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/command.hpp"
#include "common/config_fwd.hpp"
#include "common/error.hpp"
#include "common/event.hpp"
#include "common/intent.hpp"
#include "common/time.hpp"

namespace swiftlet::common {
struct World;
}

namespace swiftlet::evaluation {

enum class OperatorAction { kGoal, kHold, kResume, kHome, kLand, kKeepOut, kClearKeepOut, kGoOn, kController };
enum class ExpectedAnswer { kAccepted, kRefused, kAny };

/// One command of the script.
struct OperatorStep {
  OperatorAction command = OperatorAction::kHold;
  std::vector<double> goal_map_m;
  std::vector<double> polygon_map_m;
  std::string controller = {};
  double at_s = 0.0;
  std::string after_phase;
  std::string after_event;
  int after_goals = 0;
  double delay_s = 0.0;
  ExpectedAnswer expect = ExpectedAnswer::kAccepted;
  std::string vehicle = {};
  common::SourceLocation place = {};  ///< In its file, for messages.

  void describe(common::config::Fields& fields);
  std::vector<common::Problem> validate() const;
};

/// What became of one step.
struct OperatorAnswer {
  std::string command;  ///< "goal (3.00, -1.50)".
  ExpectedAnswer expected = ExpectedAnswer::kAccepted;
  std::optional<common::Time> given;  ///< nullopt: its condition never came.
  std::optional<bool> accepted;       ///< nullopt: no answer came.
  std::string reason;

  /// In words why it is not what the script expects; empty if it is.
  std::string failure() const;
};

/// The steps are followed one after the other: what a step waits for counts from the step before it. One thread; calls
/// come in the order of time.
class OperatorScript {
 public:
  /// The steps for the vehicle with that name, and those that name none.
  OperatorScript(const std::vector<OperatorStep>& steps, const std::string& vehicle);

  void event(const common::Event& event);
  void world(const common::World& world);
  void intent(const common::Intent& intent, const common::IntentStatus& status);
  /// The commands that are due now.
  std::vector<common::OperatorCommand> due(common::Time now);
  void result(const common::CommandResult& result);

  const std::vector<OperatorAnswer>& answers() const { return answers_; }

 private:
  bool conditionHolds(const OperatorStep& step, common::Time now) const;
  common::OperatorCommand begin(std::size_t step, common::Time now);

  std::vector<OperatorStep> steps_;
  std::vector<OperatorAnswer> answers_;
  std::size_t next_ = 0;
  bool phase_came_ = false;  ///< What the next step waits for has happened.
  bool event_came_ = false;
  std::optional<common::Time> holds_since_;  ///< The condition of the next step.
  int goals_ = 0;
  std::uint64_t counted_intent_ = 0;
};

}  // namespace swiftlet::evaluation

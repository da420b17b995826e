// Whether events of one kind came in the order that a trial asks for, and where the vehicle truly was at each.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "common/config_fwd.hpp"
#include "common/error.hpp"
#include "common/event.hpp"
#include "common/time.hpp"

namespace swiftlet::evaluation {

/// An event that must come, with the vehicle in a box of its frame `map`.
struct ExpectedEvent {
  std::string event = {};
  std::vector<double> low_map_m = {};   ///< x, y, z; empty: anywhere.
  std::vector<double> high_map_m = {};  ///< As many as low_map_m.

  void describe(common::config::Fields& fields);
  std::vector<common::Problem> validate() const;
};

struct EventOrderConfig {
  std::string begins_with = {};
  std::vector<ExpectedEvent> order = {};

  void describe(common::config::Fields& fields);
  std::vector<common::Problem> validate() const;
};

/// An event that came.
struct PlacedEvent {
  common::Time stamp;
  std::string text;
  Eigen::Vector3d place_map_m = Eigen::Vector3d::Zero();  ///< The true position of the body.
};

struct EventOrderScore {
  EventOrderConfig asked;
  std::vector<PlacedEvent> came;  ///< All that begin with the text, in the order of time.

  /// In words what came otherwise: another event or none, one outside of its box, one too many.
  std::vector<std::string> missed() const;
};

/// Collects the events of one order.
class EventOrderRecorder {
 public:
  explicit EventOrderRecorder(EventOrderConfig config) : score_{std::move(config), {}} {}

  void event(const common::Event& event, const Eigen::Vector3d& place_map_m);
  const EventOrderScore& finish() const { return score_; }

 private:
  EventOrderScore score_;
};

}  // namespace swiftlet::evaluation

#include "evaluation/event_order.hpp"

#include <algorithm>
#include <cstddef>

#include <fmt/format.h>

#include "common/config_fields.hpp"
#include "common/validation.hpp"

namespace swiftlet::evaluation {
namespace {

using common::Message;

bool isInside(const Eigen::Vector3d& place_m, const ExpectedEvent& expected) {
  for (std::size_t i = 0; i < expected.low_map_m.size(); ++i) {
    const double at_m = place_m[static_cast<Eigen::Index>(i)];
    if (at_m < expected.low_map_m[i] || at_m > expected.high_map_m[i]) return false;
  }
  return true;
}

std::string words(const PlacedEvent& came) {
  return fmt::format("`{}` at {:.1f} s, ({:.2f}, {:.2f}, {:.2f}) m", came.text, came.stamp.seconds(),
                     came.place_map_m.x(), came.place_map_m.y(), came.place_map_m.z());
}

}  // namespace

void ExpectedEvent::describe(common::config::Fields& fields) {
  fields("event", event, "Text of the event.");
  fields("low_map_m", low_map_m, {-1e4, 1e4},
         "Least x, y, z in the vehicle's frame `map` at which it may come, by the truth; empty: anywhere.");
  fields("high_map_m", high_map_m, {-1e4, 1e4}, "Greatest x, y, z at which it may come.");
}

std::vector<common::Problem> ExpectedEvent::validate() const {
  return common::Validation()
      .given(!event.empty(), "event")
      .require(low_map_m.empty() || low_map_m.size() == 3, "low_map_m",
               Message("event-order.no-point", "is not one point x, y, z"))
      .require(high_map_m.size() == low_map_m.size(), "high_map_m",
               Message("event-order.no-box", "is not one point x, y, z as low_map_m is"))
      .problems();
}

void EventOrderConfig::describe(common::config::Fields& fields) {
  fields("begins_with", begins_with, "Begin of the texts of all events that count.");
  fields.list("order", order, "The events that must come, in this order; no others may.");
}

std::vector<common::Problem> EventOrderConfig::validate() const {
  common::Validation validation;
  validation.given(!begins_with.empty(), "begins_with");
  for (const ExpectedEvent& expected : order)
    validation.require(expected.event.starts_with(begins_with), "order",
                       Message("event-order.never", "`{}` does not begin with `{}`", expected.event, begins_with));
  return validation.problems();
}

std::vector<std::string> EventOrderScore::missed() const {
  std::vector<std::string> failures;
  for (std::size_t i = 0; i < std::max(came.size(), asked.order.size()); ++i) {
    if (i >= asked.order.size())
      failures.push_back("one event too many: " + words(came[i]));
    else if (i >= came.size())
      failures.push_back(fmt::format("`{}` did not come", asked.order[i].event));
    else if (came[i].text != asked.order[i].event)
      failures.push_back(fmt::format("`{}` was to come, not {}", asked.order[i].event, words(came[i])));
    else if (!isInside(came[i].place_map_m, asked.order[i]))
      failures.push_back("not at its place: " + words(came[i]));
  }
  return failures;
}

void EventOrderRecorder::event(const common::Event& event, const Eigen::Vector3d& place_map_m) {
  if (event.text.starts_with(score_.asked.begins_with)) score_.came.push_back({event.stamp, event.text, place_map_m});
}

}  // namespace swiftlet::evaluation

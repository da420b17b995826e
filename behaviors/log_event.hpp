// LogEvent: writes an event into the run's list and onto the page. SUCCESS at once.
#pragma once

#include <string>

#include "behaviors/flight_tick.hpp"
#include "behaviors/tree/leaf.hpp"
#include "behaviors/tree/registry.hpp"

namespace swiftlet::behaviors {

class LogEvent final : public tree::Leaf {
 public:
  explicit LogEvent(const tree::NodeSetup& setup) : Leaf(setup), text_(setup, "text"), severity_(setup, "severity") {}
  static tree::NodeManifest manifest();

 private:
  tree::Status act(tree::TickContext& context) override;
  tree::Input<std::string> text_;
  tree::Input<std::string> severity_;
};

}  // namespace swiftlet::behaviors

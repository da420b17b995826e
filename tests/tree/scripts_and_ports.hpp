// The tree whose ticks are watched for allocations by a test and timed by a benchmark: 21 nodes, two scripts, four
// ports.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "behaviors/tree/leaf.hpp"
#include "behaviors/tree/node.hpp"

namespace swiftlet::tree::testing {

/// Reads two ports from entries and two literals at each tick.
class PortReader final : public Leaf {
 public:
  explicit PortReader(const NodeSetup& setup)
      : Leaf(setup), goal_(setup, "goal"), height_m_(setup, "height_m"), tries_(setup, "tries"), mode_(setup, "mode") {}
  static NodeManifest manifest() {
    return {.id = "PortReader",
            .kind = NodeKind::kAction,
            .ports = {{.name = "goal", .type = PortType::kPoint},
                      {.name = "height_m", .type = PortType::kDouble, .minimum = 0.3, .maximum = 5.0},
                      {.name = "tries", .type = PortType::kInt},
                      {.name = "mode", .type = PortType::kString}},
            .description = "Reads its ports."};
  }

 private:
  Status act(TickContext&) override {
    const bool all = goal_.get() && height_m_.get() && tries_.get() && mode_.get();
    return all ? Status::kSuccess : Status::kFailure;
  }

  Input<Point> goal_;
  Input<double> height_m_;
  Input<std::int64_t> tries_;
  Input<std::string> mode_;
};

/// Counts what it is told.
class ChangeCounter final : public Observer {
 public:
  void onStatus(const Node&, Status, Status) override { ++changes; }
  void onSwitch(const Switch&) override { ++changes; }
  void onFailure(const Node&, std::string_view) override { ++changes; }
  std::int64_t changes = 0;
};

/// The content of a BehaviorTree; every node of it is ticked.
inline constexpr const char* kScriptsAndPorts = R"(<Sequence>
  <Script code="tries := 3; height_m := 1.5"/>
  <Fallback><AlwaysFailure/><Inverter><AlwaysFailure/></Inverter></Fallback>
  <ReactiveSequence><ScriptCondition code="tries &lt; 4 &amp;&amp; height_m > 1"/><AlwaysSuccess/><AlwaysSuccess/></ReactiveSequence>
  <PortReader goal="1;2" height_m="{height_m}" tries="{tries}" mode="fast"/>
  <Parallel><AlwaysSuccess/><AlwaysSuccess/><AlwaysSuccess/></Parallel>
  <Timeout msec="1000"><Sequence><AlwaysSuccess/><AlwaysSuccess/></Sequence></Timeout>
  <ForceSuccess><AlwaysFailure/></ForceSuccess>
</Sequence>)";

}  // namespace swiftlet::tree::testing

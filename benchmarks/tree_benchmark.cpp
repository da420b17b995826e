// links: tree
// What a tick and the reading of a file cost. Peer: BehaviorTree.CPP 4.10 on a machine of this kind: a tick of about 20
// nodes 2.43 us, 10,000 nodes parsed and built in 19.7 ms, a Sequence of 1,000 leaves 143 us.
#include <string>

#include <benchmark/benchmark.h>

#include "behaviors/tree/leaf.hpp"
#include "behaviors/tree/parser.hpp"
#include "tests/tree/scripts_and_ports.hpp"

namespace {

using namespace swiftlet::tree;

class Busy final : public Leaf {
 public:
  using Leaf::Leaf;
  static NodeManifest manifest() {
    return {.id = "Busy", .kind = NodeKind::kAction, .ports = {}, .description = "RUNNING."};
  }

 private:
  Status act(TickContext&) override { return Status::kRunning; }
};

Registry registryWithBusy() {
  Registry registry = Registry::standard();
  registry.add<Busy>();
  registry.add<testing::PortReader>();
  return registry;
}

std::string fileOf(const std::string& inside) {
  return "<root BTCPP_format=\"4\"><BehaviorTree ID=\"Main\">" + inside + "</BehaviorTree></root>";
}

/// 20 nodes, every one of them ticked and none of them running: the dearest kind of tick.
const char* const kTwenty = R"(<Sequence>
  <Fallback><AlwaysFailure/><Inverter><AlwaysFailure/></Inverter></Fallback>
  <ReactiveSequence><AlwaysSuccess/><AlwaysSuccess/><ForceSuccess><AlwaysFailure/></ForceSuccess></ReactiveSequence>
  <Parallel><AlwaysSuccess/><AlwaysSuccess/><AlwaysSuccess/><AlwaysSuccess/></Parallel>
  <Timeout msec="1000"><Sequence><AlwaysSuccess/><AlwaysSuccess/><AlwaysSuccess/></Sequence></Timeout>
</Sequence>)";

void tickFor(benchmark::State& state, const std::string& text, Observer* observer) {
  const Registry registry = registryWithBusy();
  ParseResult parsed = parseText(text, "benchmark.xml", registry);
  if (!parsed.tree) {
    state.SkipWithError(toString(parsed.problems).c_str());
    return;
  }
  TickContext context;
  context.observer = observer;
  for (auto _ : state) {
    context.now_ns += 50'000'000;
    benchmark::DoNotOptimize(parsed.tree->tick(context));
  }
  state.counters["nodes"] = static_cast<double>(parsed.tree->nodes().size());
}

void tickTwentyNodes(benchmark::State& state) { tickFor(state, fileOf(kTwenty), nullptr); }
BENCHMARK(tickTwentyNodes);

void tickTwentyNodesObserved(benchmark::State& state) {
  testing::ChangeCounter counter;
  tickFor(state, fileOf(kTwenty), &counter);
}
BENCHMARK(tickTwentyNodesObserved);

/// What a mission does most of the time: a Priority whose second child flies.
void tickRunningMission(benchmark::State& state) {
  tickFor(state,
          fileOf("<Priority><Inverter><Inverter><Sequence><Busy/></Sequence></Inverter></Inverter><Busy/></Priority>"),
          nullptr);
}
BENCHMARK(tickRunningMission);

void tickThousandLeaves(benchmark::State& state) {
  std::string leaves;
  for (int i = 0; i < 1000; ++i) leaves += "<AlwaysSuccess/>";
  tickFor(state, fileOf("<Sequence>" + leaves + "</Sequence>"), nullptr);
}
BENCHMARK(tickThousandLeaves)->Unit(benchmark::kMicrosecond);

/// 21 nodes with two scripts and four ports: tests/tree/allocations_test.cpp watches the same tree.
void tickScriptsAndPortsObserved(benchmark::State& state) {
  testing::ChangeCounter counter;
  tickFor(state, fileOf(testing::kScriptsAndPorts), &counter);
}
BENCHMARK(tickScriptsAndPortsObserved);

void readFor(benchmark::State& state, const std::string& text) {
  const Registry registry = registryWithBusy();
  for (auto _ : state) {
    ParseResult parsed = parseText(text, "benchmark.xml", registry);
    if (!parsed.tree) state.SkipWithError(toString(parsed.problems).c_str());
    benchmark::DoNotOptimize(parsed.tree);
    state.counters["nodes"] = static_cast<double>(parsed.tree->nodes().size());
  }
}

void readTenThousandScripts(benchmark::State& state) {
  std::string inside = "<Sequence>\n<Script code=\"n := 1; limit := 3\"/>\n";
  for (int i = 0; i < 2500; ++i)
    inside +=
        "  <Fallback _skipIf=\"n > limit\"><Script code=\"n = n + 1\"/><ScriptCondition code=\"n &lt; 3 &amp;&amp; "
        "limit == 3\"/><AlwaysFailure _onFailure=\"n -= 1\"/></Fallback>\n";
  readFor(state, fileOf(inside + "</Sequence>"));
}
BENCHMARK(readTenThousandScripts)->Unit(benchmark::kMillisecond);

/// The same with no text twice.
void readTenThousandDifferentScripts(benchmark::State& state) {
  std::string inside = "<Sequence>\n<Script code=\"n := 1; limit := 3\"/>\n";
  for (int i = 0; i < 2500; ++i) {
    const std::string number = std::to_string(i);
    inside += "  <Fallback _skipIf=\"n > limit + " + number + "\"><Script code=\"n = n + " + number +
              "\"/><ScriptCondition code=\"n &lt; 3 &amp;&amp; limit == " + number +
              "\"/><AlwaysFailure _onFailure=\"n -= " + number + "\"/></Fallback>\n";
  }
  readFor(state, fileOf(inside + "</Sequence>"));
}
BENCHMARK(readTenThousandDifferentScripts)->Unit(benchmark::kMillisecond);

void readTenThousandNodes(benchmark::State& state) {
  std::string inside = "<Sequence>\n";
  for (int i = 0; i < 1666; ++i)
    inside += "  <Fallback name=\"f" + std::to_string(i) +
              "\"><Timeout msec=\"500\"><AlwaysFailure/></Timeout><Repeat num_cycles=\"2\"><AlwaysSuccess/></Repeat>"
              "<AlwaysFailure/></Fallback>\n";
  readFor(state, fileOf(inside + "</Sequence>"));
}
BENCHMARK(readTenThousandNodes)->Unit(benchmark::kMillisecond);

}  // namespace

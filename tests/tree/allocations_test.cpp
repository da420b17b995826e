// A tick allocates nothing: this program counts what operator new is asked for.
#include <atomic>
#include <cstdlib>
#include <new>

#include <gtest/gtest.h>

#include "behaviors/tree/leaf.hpp"
#include "behaviors/tree/parser.hpp"
#include "tests/tree/story.hpp"

namespace {

std::atomic<long> allocations{0};

void* counted(std::size_t size) {
  ++allocations;
  if (void* memory = std::malloc(size == 0 ? 1 : size)) return memory;
  throw std::bad_alloc();
}

}  // namespace

void* operator new(std::size_t size) { return counted(size); }
void* operator new[](std::size_t size) { return counted(size); }
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t) noexcept { std::free(memory); }

namespace swiftlet::tree::testing {
namespace {

/// Reads two entries and two literals at each tick.
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

class StatusCounter final : public Observer {
 public:
  void onStatus(const Node&, Status, Status) override { ++changes; }
  void onSwitch(const Switch&) override { ++changes; }
  void onFailure(const Node&, std::string_view) override { ++changes; }
  long changes = 0;
};

/// As in benchmarks/tree_benchmark.cpp: 21 nodes, two scripts, four ports.
const char* const kScriptsAndPorts = R"(<Sequence>
  <Script code="tries := 3; height_m := 1.5"/>
  <Fallback><AlwaysFailure/><Inverter><AlwaysFailure/></Inverter></Fallback>
  <ReactiveSequence><ScriptCondition code="tries &lt; 4 &amp;&amp; height_m > 1"/><AlwaysSuccess/><AlwaysSuccess/></ReactiveSequence>
  <PortReader goal="1;2" height_m="{height_m}" tries="{tries}" mode="fast"/>
  <Parallel><AlwaysSuccess/><AlwaysSuccess/><AlwaysSuccess/></Parallel>
  <Timeout msec="1000"><Sequence><AlwaysSuccess/><AlwaysSuccess/></Sequence></Timeout>
  <ForceSuccess><AlwaysFailure/></ForceSuccess>
</Sequence>)";

TEST(Allocations, ATickHasNone) {
  Registry registry = Registry::standard();
  registry.add<PortReader>();
  ParseResult parsed = parseText(file(kScriptsAndPorts), "f.xml", registry);
  ASSERT_TRUE(parsed.tree.has_value()) << toString(parsed.problems);
  EXPECT_EQ(parsed.tree->nodes().size(), 21U);
  StatusCounter counter;
  TickContext context;
  context.observer = &counter;
  ASSERT_EQ(parsed.tree->tick(context), Status::kSuccess);
  const long before = allocations;
  for (int i = 0; i < 100; ++i) {
    context.now_ns += 50'000'000;
    parsed.tree->tick(context);
  }
  EXPECT_EQ(allocations - before, 0);
  EXPECT_GT(counter.changes, 1000);
}

TEST(Allocations, AreCounted) {
  const long before = allocations;
  void* const memory = ::operator new(8);  // An expression with `new` may be left out by the compiler.
  EXPECT_EQ(allocations - before, 1);
  ::operator delete(memory);
}

}  // namespace
}  // namespace swiftlet::tree::testing

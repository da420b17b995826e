// A tick allocates nothing: this program counts what operator new is asked for.
#include <gtest/gtest.h>

#include "behaviors/tree/parser.hpp"
#include "tests/support/allocations/counted_allocations.hpp"
#include "tests/tree/scripts_and_ports.hpp"
#include "tests/tree/story.hpp"

namespace swiftlet::tree::testing {
namespace {

using test_support::allocations;

TEST(Allocations, ATickHasNone) {
  Registry registry = Registry::standard();
  registry.add<PortReader>();
  ParseResult parsed = parseText(file(kScriptsAndPorts), "f.xml", registry);
  ASSERT_TRUE(parsed.tree.has_value()) << toString(parsed.problems);
  EXPECT_EQ(parsed.tree->nodes().size(), 21U);
  ChangeCounter counter;
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

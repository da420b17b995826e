// What Sequence and Fallback share: they run the children one after the other; a child that ended is not asked again.
// The asynchronous ones, AsyncSequence and AsyncFallback, end the tick (RUNNING) after a child that started and ended
// in it, unless it is the last one.
#pragma once

#include "behaviors/tree/composite.hpp"

namespace swiftlet::tree {

class Chain : public Composite {
 protected:
  /// After a child ends with `goes_on` or SKIPPED, the next is asked. `goes_on` is also the result of the whole chain.
  Chain(const NodeSetup& setup, Status goes_on, bool asynchronous = false)
      : Composite(setup), goes_on_(goes_on), asynchronous_(asynchronous) {}

 private:
  Status run(TickContext& context) final;
  void clear(TickContext&) final { current_ = skipped_ = 0; }

  Status goes_on_;
  bool asynchronous_;
  std::size_t current_ = 0;
  std::size_t skipped_ = 0;
};

}  // namespace swiftlet::tree

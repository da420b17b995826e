// What ReactiveSequence and ReactiveFallback share: every child from the first, at every tick.
#pragma once

#include "behaviors/tree/composite.hpp"

namespace swiftlet::tree {

class Reactive : public Composite {
 protected:
  /// `goes_on` is the end of a child after which the next is asked (SKIPPED is another), and that of the whole node;
  /// `stops` is the other one, which ends the node.
  Reactive(const NodeSetup& setup, Status goes_on, Status stops) : Composite(setup), goes_on_(goes_on), stops_(stops) {}

 private:
  Status run(TickContext& context) final;
  void clear(TickContext&) final { running_ = kNobody; }

  static constexpr std::size_t kNobody = static_cast<std::size_t>(-1);
  Status goes_on_;
  Status stops_;
  std::size_t running_ = kNobody;  ///< The child that answered RUNNING last.
};

}  // namespace swiftlet::tree

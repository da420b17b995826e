// What ReactiveSequence and ReactiveFallback share: they ask every child from the first, at every tick.
#pragma once

#include "behaviors/tree/composite.hpp"

namespace swiftlet::tree {

class Reactive : public Composite {
 protected:
  /// After a child ends with `goes_on` or SKIPPED, the next is asked; `goes_on` is also the result of the whole node.
  /// `stops` is the other result, which ends the node.
  Reactive(const NodeSetup& setup, Status goes_on, Status stops) : Composite(setup), goes_on_(goes_on), stops_(stops) {}

 private:
  Status run(TickContext& context) final;
  void clear(TickContext&) final { running_ = kNone; }

  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);
  Status goes_on_;
  Status stops_;
  std::size_t running_ = kNone;  ///< The child that answered RUNNING last.
};

}  // namespace swiftlet::tree

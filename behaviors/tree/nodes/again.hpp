// What Repeat and RetryUntilSuccessful share: they run the child repeatedly, until it has ended in one result often
// enough.
#pragma once

#include <string_view>

#include "behaviors/tree/composite.hpp"

namespace swiftlet::tree {

class Again : public Composite {
 protected:
  /// When the child has ended with `counted` as often as the port `times` says (-1: never enough), the node ends with
  /// it. The port is read at each tick; if FAILURE counts, also after each one, as in BehaviorTree.CPP.
  Again(const NodeSetup& setup, std::string_view times, Status counted)
      : Composite(setup), times_(setup, times), counted_(counted) {}

 private:
  Status run(TickContext& context) final;
  void clear(TickContext&) final { done_ = 0; }
  bool onAsked(const TickContext& context) const final;

  Input<std::int64_t> times_;
  Status counted_;
  std::int64_t done_ = 0;
};

}  // namespace swiftlet::tree

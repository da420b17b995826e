// What Repeat and RetryUntilSuccessful share: the child again and again, until it ended one way often enough.
#pragma once

#include <string_view>

#include "behaviors/tree/composite.hpp"

namespace swiftlet::tree {

class Again : public Composite {
 protected:
  /// The child ends with `counted` as often as the port `times` says (-1: for ever); that is how the node ends then.
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

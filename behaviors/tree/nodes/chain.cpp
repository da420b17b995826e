#include "behaviors/tree/nodes/chain.hpp"

namespace swiftlet::tree {

Status Chain::run(TickContext& context) {
  for (; current_ < count(); ++current_) {
    const Status status = child(current_).tick(context);
    if (status == Status::kSkipped)
      ++skipped_;
    else if (status != goes_on_)
      return status;
  }
  return skipped_ == count() ? Status::kSkipped : goes_on_;
}

}  // namespace swiftlet::tree

// The error-state filter, and who listens to what it is told.
#pragma once

#include <string>

#include <tl/expected.hpp>

#include "perception/fusion/error_state_filter.hpp"
#include "perception/fusion/filter_tape.hpp"

namespace swiftlet::autonomy {

/// One thread. Nothing else changes the filter.
class HeardFilter {
 public:
  explicit HeardFilter(const perception::FusionConfig& config) : filter_(config) {}

  /// Hears all that the filter is told from now on; null for none. It must outlive this.
  void setListener(perception::FilterListener* listener) { listener_ = listener; }
  /// Tells the listener and then the filter. Returns what perception::tell returns.
  tl::expected<perception::Insertion, std::string> tell(const perception::FilterInput& input) {
    if (listener_ != nullptr) listener_->heard(input);
    return perception::tell(filter_, input);
  }
  const perception::ErrorStateFilter* operator->() const { return &filter_; }
  const perception::ErrorStateFilter& operator*() const { return filter_; }

 private:
  perception::ErrorStateFilter filter_;
  perception::FilterListener* listener_ = nullptr;
};

}  // namespace swiftlet::autonomy

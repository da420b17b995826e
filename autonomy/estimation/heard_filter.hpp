// The error-state filter, and the listener to its inputs.
#pragma once

#include <string>

#include <tl/expected.hpp>

#include "common/event_log.hpp"
#include "common/time.hpp"
#include "perception/fusion/error_state_filter.hpp"
#include "perception/fusion/filter_tape.hpp"

namespace swiftlet::autonomy {

/// One thread. Only this class changes the filter.
class HeardFilter {
 public:
  explicit HeardFilter(const perception::FusionConfig& config) : filter_(config) {}

  /// Gets all inputs of the filter from now on; null for no listener. It must outlive this.
  void setListener(perception::FilterListener* listener) { listener_ = listener; }
  /// Gives the input to the listener and then to the filter. Returns what perception::tell returns.
  tl::expected<perception::Insertion, std::string> tell(const perception::FilterInput& input) {
    if (listener_ != nullptr) listener_->heard(input);
    return perception::tell(filter_, input);
  }
  /// Says when the filter's health has changed.
  void reportHealth(common::Time now, common::EventLog& log);
  const perception::ErrorStateFilter* operator->() const { return &filter_; }
  const perception::ErrorStateFilter& operator*() const { return filter_; }

 private:
  perception::ErrorStateFilter filter_;
  perception::FilterListener* listener_ = nullptr;
  perception::FusionStatus reported_ = perception::FusionStatus::kNotInitialized;
};

}  // namespace swiftlet::autonomy

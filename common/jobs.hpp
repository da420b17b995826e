// Heavy work beside the loop. A job is a pure function of what it was given; its result is delivered inside the loop.
// One job of a kind is outstanding at a time.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "common/time.hpp"

namespace swiftlet::common {

/// Runs jobs. In lockstep the work starts on a pool thread at submit and is joined at submit time + latency, so that
/// the outcome does not depend on how fast the machine is. Called from the loop's thread only; the pool runs `work`
/// alone.
class JobRunner {
 public:
  /// Run on a pool thread; must touch nothing but its captures. Returns what is to be done in the loop with the result.
  using Deliver = std::function<void(Time delivered)>;
  using Work = std::function<Deliver()>;

  virtual ~JobRunner() = default;

  /// False when a job of that kind is still outstanding.
  [[nodiscard]] virtual bool idle(const std::string& kind) const = 0;
  /// The kind must be idle.
  virtual void submit(const std::string& kind, Time now, Duration latency, Work work) = 0;
  /// Delivers, in order of due time and then of submission, what is due at or before `now`.
  virtual void deliverDue(Time now) = 0;
};

/// The lockstep runner with its own pool. `threads` 0 runs the work at submit, in the caller's thread: same results.
std::unique_ptr<JobRunner> makeLockstepJobs(int threads);

}  // namespace swiftlet::common

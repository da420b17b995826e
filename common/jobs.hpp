// Heavy work outside the loop's thread. A job is a pure function of its arguments; its result is delivered in the loop.
// At most one job of each kind is outstanding.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/job_times.hpp"
#include "common/time.hpp"

namespace swiftlet::common {

/// The delivery of a job's result. A recording needs no more of a job, because a replay computes its pure work again.
struct JobDelivery {
  std::string kind;
  std::uint64_t number = 0;  ///< Number of the job in its runner, from 1, in order of submission.
  Time submitted;
  Time delivered;
};

/// Runs jobs. The runner decides when a result is due (`nextDue`); the loop delivers it (`deliver`) and may record the
/// delivery. All functions are called from the loop's thread; only `work` runs in the pool.
class JobRunner {
 public:
  /// Work runs on a pool thread and may use nothing but its captures. It returns the function that applies the result,
  /// which runs in the loop.
  using Deliver = std::function<void(Time delivered)>;
  using Work = std::function<Deliver()>;

  virtual ~JobRunner() = default;

  /// False when a job of that kind is still outstanding.
  [[nodiscard]] virtual bool idle(const std::string& kind) const = 0;
  /// `kind` must be idle; `latency` is its declared latency.
  virtual void submit(const std::string& kind, Time now, Duration latency, Work work) = 0;

  /// The next delivery that is due at or before `now`, if there is one. It stays the next until it is delivered.
  [[nodiscard]] virtual std::optional<JobDelivery> nextDue(Time now) const = 0;
  /// Whether a job with that kind, number and time of submission is outstanding.
  [[nodiscard]] virtual bool awaits(const JobDelivery& delivery) const = 0;
  /// Waits until the work is done, and applies its result as of `delivery.delivered`. An outstanding job may be
  /// delivered before or after it is due: a replay delivers it at the time in the recording.
  virtual void deliver(const JobDelivery& delivery) = 0;

  /// How long the work took, one entry for each kind in alphabetical order; empty for a runner without a clock.
  [[nodiscard]] virtual std::vector<JobTimes> times() const { return {}; }

  /// Delivers everything that is due at or before `now`.
  void deliverDue(Time now) {
    while (const auto due = nextDue(now)) deliver(*due);
  }
};

/// The lockstep runner with its own pool. The work starts on a pool thread at submit and is joined at submit time +
/// latency, so that the outcome does not depend on the machine's speed. Jobs are due when their latency has passed, in
/// order of due time and then of submission. With `threads` 0 the work runs at submit, in the caller's thread, with the
/// same results. A replay uses this runner too, and takes the deliveries from the recording instead of `nextDue`.
std::unique_ptr<JobRunner> makeLockstepJobs(int threads);

/// The present time of a flight on the wall clock. Called from the loop's thread and from the pool's threads.
using RunningClock = std::function<Time()>;

/// For a vehicle that does not wait. A job is due as soon as its work is done, in the order of completion, and is
/// delivered at the `now` of `nextDue`. The declared latency is only compared with the time the work took (`times`).
/// `threads` must be at least 1.
std::unique_ptr<JobRunner> makeWallClockJobs(int threads, RunningClock clock);

}  // namespace swiftlet::common

// Heavy work beside the loop. A job is a pure function of what it was given; its result is delivered inside the loop.
// One job of a kind is outstanding at a time.
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

/// All that a recording needs to know of a job: the work is pure, so that it can be done again.
struct JobDelivery {
  std::string kind;
  std::uint64_t number = 0;  ///< Counts the jobs of a runner from 1, in order of submission.
  Time submitted;
  Time delivered;
};

/// Runs jobs. The runner decides when a result is due (`nextDue`); the loop delivers it (`deliver`), and may record
/// that it did. Called from the loop's thread only; the pool runs `work` alone.
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

  /// What is to be delivered next, at or before `now`; none: nothing is due. The same until it is delivered.
  [[nodiscard]] virtual std::optional<JobDelivery> nextDue(Time now) const = 0;
  /// Whether that job was submitted, at that time, and is outstanding.
  [[nodiscard]] virtual bool awaits(const JobDelivery& delivery) const = 0;
  /// Waits for the work when it is not done, and hands on its result at `delivery.delivered`. A job that is awaited may
  /// be delivered before or after it is due: a replay delivers when the recording says so.
  virtual void deliver(const JobDelivery& delivery) = 0;

  /// How long the work took, kind by kind in alphabetical order; empty for a runner that has no clock.
  [[nodiscard]] virtual std::vector<JobTimes> times() const { return {}; }

  /// Delivers everything that is due at or before `now`.
  void deliverDue(Time now) {
    while (const auto due = nextDue(now)) deliver(*due);
  }
};

/// The lockstep runner with its own pool: the work starts on a pool thread at submit and is joined at submit time +
/// latency, so that the outcome does not depend on how fast the machine is. Due are, in order of due time and then of
/// submission, the jobs whose latency has passed. `threads` 0 runs the work at submit, in the caller's thread: same
/// results. Also the runner of a replay, which never asks what is due.
std::unique_ptr<JobRunner> makeLockstepJobs(int threads);

/// The time of a flight, which passes by itself. Called from the loop's thread and from the pool's.
using RunningClock = std::function<Time()>;

/// For a vehicle that does not wait: due is what is done, in the order in which it was done, delivered at the time of
/// asking. The declared latency is only compared with the time the work took (`times`). `threads` at least 1.
std::unique_ptr<JobRunner> makeWallClockJobs(int threads, RunningClock clock);

}  // namespace swiftlet::common

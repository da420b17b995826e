#include "common/jobs.hpp"

#include <algorithm>
#include <condition_variable>
#include <deque>
#include <future>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include "common/check.hpp"

namespace swiftlet::common {
namespace {

using Task = std::packaged_task<JobRunner::Deliver()>;

/// Runs tasks in the order of run(). Without threads, a task runs at once in the caller's thread.
class Pool {
 public:
  explicit Pool(int threads) {
    for (int i = 0; i < threads; ++i) threads_.emplace_back([this] { serve(); });
  }

  ~Pool() {
    {
      const std::scoped_lock lock(mutex_);
      stopping_ = true;
    }
    wake_.notify_all();
    for (std::thread& thread : threads_) thread.join();
  }

  void run(Task task) {
    if (threads_.empty()) {
      task();
      return;
    }
    {
      const std::scoped_lock lock(mutex_);
      waiting_.push_back(std::move(task));
    }
    wake_.notify_one();
  }

 private:
  void serve() {
    while (true) {
      Task task;
      {
        std::unique_lock lock(mutex_);
        wake_.wait(lock, [this] { return stopping_ || !waiting_.empty(); });
        if (waiting_.empty()) return;
        task = std::move(waiting_.front());
        waiting_.pop_front();
      }
      task();
    }
  }

  std::mutex mutex_;
  std::condition_variable wake_;
  std::deque<Task> waiting_;
  bool stopping_ = false;
  std::vector<std::thread> threads_;
};

struct Outstanding {
  std::string kind;
  std::uint64_t number = 0;
  Time submitted;
  Time due;
  std::future<JobRunner::Deliver> result;
};

/// The part that both runners share: the outstanding jobs, in order of submission.
class PooledJobs : public JobRunner {
 public:
  explicit PooledJobs(int threads) : pool_(threads) {}

  bool idle(const std::string& kind) const override {
    return std::none_of(outstanding_.begin(), outstanding_.end(),
                        [&](const Outstanding& job) { return job.kind == kind; });
  }

  void submit(const std::string& kind, Time now, Duration latency, Work work) override {
    SWIFTLET_CHECK(idle(kind), kind);
    ++submitted_;
    Task task(std::move(work));
    outstanding_.push_back({kind, submitted_, now, now + latency, task.get_future()});
    pool_.run(std::move(task));
  }

  bool awaits(const JobDelivery& delivery) const override {
    return std::any_of(outstanding_.begin(), outstanding_.end(),
                       [&](const Outstanding& job) { return isOf(job, delivery); });
  }

  void deliver(const JobDelivery& delivery) override {
    const auto job = std::find_if(outstanding_.begin(), outstanding_.end(),
                                  [&](const Outstanding& out) { return isOf(out, delivery); });
    SWIFTLET_CHECK(job != outstanding_.end(), delivery.kind, delivery.number);
    std::future<Deliver> result = std::move(job->result);
    outstanding_.erase(job);
    result.wait();
    joined(delivery.number);
    if (const Deliver deliver = result.get()) deliver(delivery.delivered);
  }

 protected:
  /// Called when the work of the job is done, just before its result is applied.
  virtual void joined(std::uint64_t /*number*/) {}
  const std::vector<Outstanding>& outstanding() const { return outstanding_; }
  std::uint64_t submittedSoFar() const { return submitted_; }

 private:
  static bool isOf(const Outstanding& job, const JobDelivery& delivery) {
    return job.number == delivery.number && job.kind == delivery.kind && job.submitted == delivery.submitted;
  }

  std::vector<Outstanding> outstanding_;
  std::uint64_t submitted_ = 0;
  Pool pool_;  // Last, so that its threads are joined before the other members are destroyed.
};

class LockstepJobs final : public PooledJobs {
 public:
  using PooledJobs::PooledJobs;

  std::optional<JobDelivery> nextDue(Time now) const override {
    const auto next = std::min_element(outstanding().begin(), outstanding().end(),
                                       [](const Outstanding& a, const Outstanding& b) { return a.due < b.due; });
    if (next == outstanding().end() || next->due > now) return std::nullopt;
    return JobDelivery{next->kind, next->number, next->submitted, next->due};
  }
};

/// The jobs that are done; written by the pool, read by the loop.
struct Done {
  std::mutex mutex;
  std::vector<std::uint64_t> numbers;  ///< In the order of completion.
  JobStopwatch stopwatch;
};

/// Its destructor marks a job as done, even if the work threw. deliver() then throws that exception again.
struct DoneAtEnd {
  ~DoneAtEnd() {
    const Duration took = clock() - begin;
    const std::scoped_lock lock(done.mutex);
    done.numbers.push_back(number);
    done.stopwatch.add(kind, declared, took);
  }

  Done& done;
  const RunningClock& clock;
  const std::string& kind;
  std::uint64_t number;
  Duration declared;
  Time begin;
};

class WallClockJobs final : public PooledJobs {
 public:
  WallClockJobs(int threads, RunningClock clock) : PooledJobs(threads), clock_(std::move(clock)) {
    SWIFTLET_CHECK(threads > 0, threads);
  }

  void submit(const std::string& kind, Time now, Duration latency, Work work) override {
    auto timed = [done = done_, clock = clock_, kind, latency, number = submittedSoFar() + 1, begin = clock_(),
                  work = std::move(work)]() -> Deliver {
      const DoneAtEnd at_end{*done, clock, kind, number, latency, begin};
      return work();
    };
    PooledJobs::submit(kind, now, latency, std::move(timed));
  }

  std::optional<JobDelivery> nextDue(Time now) const override {
    const std::scoped_lock lock(done_->mutex);
    if (done_->numbers.empty()) return std::nullopt;
    const auto job = std::find_if(outstanding().begin(), outstanding().end(),
                                  [&](const Outstanding& out) { return out.number == done_->numbers.front(); });
    SWIFTLET_CHECK(job != outstanding().end(), done_->numbers.front());
    return JobDelivery{job->kind, job->number, job->submitted, now};
  }

  std::vector<JobTimes> times() const override {
    const std::scoped_lock lock(done_->mutex);
    return done_->stopwatch.times();
  }

 private:
  void joined(std::uint64_t number) override {
    const std::scoped_lock lock(done_->mutex);
    std::erase(done_->numbers, number);
  }

  RunningClock clock_;
  std::shared_ptr<Done> done_ = std::make_shared<Done>();
};

}  // namespace

std::unique_ptr<JobRunner> makeLockstepJobs(int threads) { return std::make_unique<LockstepJobs>(threads); }

std::unique_ptr<JobRunner> makeWallClockJobs(int threads, RunningClock clock) {
  return std::make_unique<WallClockJobs>(threads, std::move(clock));
}

}  // namespace swiftlet::common

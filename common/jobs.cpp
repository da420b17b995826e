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

class LockstepJobs final : public JobRunner {
 public:
  explicit LockstepJobs(int threads) {
    for (int i = 0; i < threads; ++i) threads_.emplace_back([this] { serve(); });
  }

  ~LockstepJobs() override {
    {
      const std::scoped_lock lock(mutex_);
      stopping_ = true;
    }
    wake_.notify_all();
    for (std::thread& thread : threads_) thread.join();
  }

  bool idle(const std::string& kind) const override {
    return std::none_of(outstanding_.begin(), outstanding_.end(),
                        [&](const Outstanding& job) { return job.kind == kind; });
  }

  void submit(const std::string& kind, Time now, Duration latency, Work work) override {
    SWIFTLET_CHECK(idle(kind), kind);
    std::packaged_task<Deliver()> task(std::move(work));
    outstanding_.push_back({kind, now + latency, task.get_future()});
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

  void deliverDue(Time now) override {
    while (true) {
      const auto next = std::min_element(outstanding_.begin(), outstanding_.end(),
                                         [](const Outstanding& a, const Outstanding& b) { return a.due < b.due; });
      if (next == outstanding_.end() || next->due > now) return;
      const Time due = next->due;
      std::future<Deliver> result = std::move(next->result);
      outstanding_.erase(next);
      if (const Deliver deliver = result.get()) deliver(due);
    }
  }

 private:
  struct Outstanding {
    std::string kind;
    Time due;
    std::future<Deliver> result;
  };

  void serve() {
    while (true) {
      std::packaged_task<Deliver()> task;
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

  std::vector<Outstanding> outstanding_;  // In order of submission.
  std::mutex mutex_;
  std::condition_variable wake_;
  std::deque<std::packaged_task<Deliver()>> waiting_;
  bool stopping_ = false;
  std::vector<std::thread> threads_;
};

}  // namespace

std::unique_ptr<JobRunner> makeLockstepJobs(int threads) { return std::make_unique<LockstepJobs>(threads); }

}  // namespace swiftlet::common

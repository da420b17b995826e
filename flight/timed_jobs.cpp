#include "flight/timed_jobs.hpp"

#include <ctime>

#include <cstddef>
#include <utility>

#include "common/quantile.hpp"

namespace swiftlet::flight {
namespace {

class TimedJobs final : public common::JobRunner {
 public:
  TimedJobs(std::unique_ptr<common::JobRunner> jobs, std::shared_ptr<JobMeter> meter)
      : jobs_(std::move(jobs)), meter_(std::move(meter)) {}

  bool idle(const std::string& kind) const override { return jobs_->idle(kind); }
  void submit(const std::string& kind, common::Time now, common::Duration latency, Work work) override {
    jobs_->submit(kind, now, latency, [kind, meter = meter_, work = std::move(work)]() -> Deliver {
      const double begin_ms = processorMs();
      Deliver deliver = work();
      meter->add(kind, processorMs() - begin_ms);
      return deliver;
    });
  }
  std::optional<common::JobDelivery> nextDue(common::Time now) const override { return jobs_->nextDue(now); }
  bool awaits(const common::JobDelivery& delivery) const override { return jobs_->awaits(delivery); }
  void deliver(const common::JobDelivery& delivery) override { jobs_->deliver(delivery); }
  std::vector<common::JobTimes> times() const override { return jobs_->times(); }

 private:
  std::unique_ptr<common::JobRunner> jobs_;
  std::shared_ptr<JobMeter> meter_;
};

}  // namespace

double processorMs() {
  std::timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

void JobMeter::add(const std::string& kind, double took_ms) {
  const std::scoped_lock lock(mutex_);
  took_ms_[kind].push_back(took_ms);
}

std::optional<JobMeter::Ends> JobMeter::ends(const std::string& kind) const {
  const std::scoped_lock lock(mutex_);
  const auto found = took_ms_.find(kind);
  if (found == took_ms_.end() || found->second.size() < 10) return std::nullopt;
  const std::vector<double>& all = found->second;
  const auto tenth = static_cast<std::ptrdiff_t>(all.size() / 10);
  return Ends{common::quantile(std::vector<double>(all.begin(), all.begin() + tenth), 0.5),
              common::quantile(std::vector<double>(all.end() - tenth, all.end()), 0.5)};
}

std::vector<double> JobMeter::took_ms(const std::string& kind) const {
  const std::scoped_lock lock(mutex_);
  const auto found = took_ms_.find(kind);
  return found == took_ms_.end() ? std::vector<double>() : found->second;
}

std::unique_ptr<common::JobRunner> timed(std::unique_ptr<common::JobRunner> jobs, std::shared_ptr<JobMeter> meter) {
  return std::make_unique<TimedJobs>(std::move(jobs), std::move(meter));
}

}  // namespace swiftlet::flight

#include "flight/picture_sink.hpp"

#include <utility>

#include "common/world.hpp"
#include "flight/motion_reference.hpp"
#include "flight/pictures.hpp"
#include "interfaces/run_folder.hpp"

namespace swiftlet::flight {
namespace {

/// By the wall clock, for people who watch the report of a running flight.
constexpr std::chrono::seconds kPicturePeriod{5};
/// Drawing takes about as long as half a second of a flight at full speed.
constexpr auto kPictureLatency = common::Duration::fromMilliseconds(1000);

}  // namespace

PictureSink::PictureSink(interfaces::RunFolder& folder, const MotionReference* reference, double hull_diameter_m)
    : folder_(folder), reference_(reference), hull_diameter_m_(hull_diameter_m) {}

common::Trajectory PictureSink::truth_map() const {
  return reference_ != nullptr ? reference_->path_map() : common::Trajectory();
}

void PictureSink::ticked(const autonomy::TickOutcome& outcome) {
  now_ = outcome.now;
  jobs_->deliverDue(now_);
}

void PictureSink::world(const std::shared_ptr<const common::World>& world) {
  const Clock::time_point now = Clock::now();
  if (now - drawn_ < kPicturePeriod || !jobs_->idle("pictures")) return;
  drawn_ = now;
  jobs_->submit("pictures", now_, kPictureLatency,
                [this, world, summary = folder_.summary(), truth = truth_map(),
                 hull_m = hull_diameter_m_]() -> common::JobRunner::Deliver {
                  auto pictures = reportPictures(*world, summary, truth, hull_m);
                  return [this, pictures = std::move(pictures)](common::Time) { folder_.show(pictures); };
                });
}

void PictureSink::drawNow(const common::World& world) {
  folder_.show(reportPictures(world, folder_.summary(), truth_map(), hull_diameter_m_));
}

}  // namespace swiftlet::flight

#include "flight/map3d_sink.hpp"

#include <malloc.h>

#include <algorithm>
#include <utility>

#include "common/world.hpp"
#include "common/world/map3d_layer.hpp"
#include "flight/map3d_files.hpp"
#include "interfaces/run_folder.hpp"

namespace swiftlet::flight {
namespace {

/// By the wall clock, from the octrees to the cloud and back: a killed process may lose twice as much of the 3D map.
constexpr std::chrono::seconds kPeriod{8};
/// Of a large map it may lose more, so that writing takes at most a twentieth of a core.
constexpr int kLeastPause = 20;
/// A long flight's map takes a few seconds to fuse and to write.
constexpr auto kLatency = common::Duration::fromMilliseconds(5000);

/// What flight and files needed goes back to the system. glibc would keep it for the next ones: a tenth of all memory.
void returnFreedMemory() {
#ifdef __GLIBC__
  malloc_trim(0);
#endif
}

}  // namespace

void Map3dSink::ticked(const autonomy::TickOutcome& outcome) {
  now_ = outcome.now;
  jobs_->deliverDue(now_);
}

void Map3dSink::world(const std::shared_ptr<const common::World>& world) {
  const Clock::time_point now = Clock::now();
  if (!world->map3d || now < next_ || folder_.failure() || !jobs_->idle("map3d")) return;
  next_ = now + kPeriod;
  // One after the other: of a large building each takes 100 MB and more while it is made.
  const bool cloud = std::exchange(cloud_is_next_, !cloud_is_next_);
  jobs_->submit("map3d", now_, kLatency,
                [this, cloud, path = folder_.path(), layer = world->map3d,
                 world_stamp = world->stamp]() -> common::JobRunner::Deliver {
                  const Clock::time_point begin = Clock::now();
                  const interfaces::Map3dWritten result =
                      cloud ? writeCloudInFlight(path, *layer) : writeOctreesInFlight(path, *layer, world_stamp);
                  returnFreedMemory();
                  return [this, result, took = Clock::now() - begin](common::Time) {
                    folder_.wroteMap3d(result);
                    next_ = std::max(next_, Clock::now() + kLeastPause * took);
                  };
                });
}

void Map3dSink::writeNow(const common::World& world) {
  if (!world.map3d) return;
  jobs_->deliverDue(now_ + kLatency);  // No job may write the same files then.
  returnFreedMemory();
  if (!folder_.failure()) folder_.wroteMap3d(writeOctrees(folder_.path(), *world.map3d, world.stamp));
  returnFreedMemory();
  if (!folder_.failure()) folder_.wroteMap3d(writeCloud(folder_.path(), *world.map3d));
  returnFreedMemory();
}

}  // namespace swiftlet::flight

#include "flight/flight_sinks.hpp"

#include "common/world.hpp"
#include "flight/web_link.hpp"
#include "interfaces/run_folder.hpp"

namespace swiftlet::flight {

using WorldPtr = std::shared_ptr<const common::World>;

void FolderSink::ticked(const autonomy::TickOutcome& outcome) { folder_.state(outcome.state); }
void FolderSink::world(const WorldPtr& world) { folder_.world(*world); }
void FolderSink::file(const autonomy::RunFile& file) {
  if (const auto* map = std::get_if<autonomy::SavedMap>(&file)) folder_.saveMap(map->name, *map->grid);
  if (const auto* photo = std::get_if<autonomy::Photo>(&file))
    folder_.savePhoto(photo->name, *photo->frame, photo->T_map_camera);
}
void FolderSink::event(const common::Event& event) { folder_.event(event); }

void PageSink::input(const autonomy::Input& input) {
  const auto* event = std::get_if<common::SensorEvent>(&input);
  if (event == nullptr) return;
  if (const auto* frame = std::get_if<std::shared_ptr<const common::CameraFrame>>(event)) web_.camera().post(*frame);
}
void PageSink::world(const WorldPtr& world) { web_.world().post(world); }
void PageSink::event(const common::Event& event) { web_.postEvent(event); }
void PageSink::result(const common::CommandResult& result) { web_.postResult(result); }

}  // namespace swiftlet::flight

#include "behaviors/photograph.hpp"

#include "behaviors/leaf_traits.hpp"
#include "behaviors/ports.hpp"

namespace swiftlet::behaviors {

tree::NodeManifest Photograph::manifest() {
  return {.id = "Photograph",
          .kind = tree::NodeKind::kAction,
          .ports = {fileNamePort("photo")},
          .description = "Stops, and takes a picture with the camera, which looks ahead, with its place.",
          .details = "Into the run's folder, as `photo-NN-FILE.jpg`, with the camera's place in a `.json`.",
          .ends = "SUCCESS with the picture; FAILURE when no frame comes for 2 s",
          .traits = LeafTraits{.needs_camera = true, .writes_file = true}};
}

void Photograph::onStart(tree::TickContext& context) {
  FlightLeaf::onStart(context);
  request_id_ = 0;
}

void Photograph::onResume(tree::TickContext& context) {
  FlightLeaf::onResume(context);
  request_id_ = 0;
}

tree::Status Photograph::act(tree::TickContext& context) {
  FlightTick& tick = flightTick(context);
  const auto file = file_.get();
  if (!file) return fail(context, file_.problem());
  if (std::string problem = fileNameProblem(*file); !problem.empty()) return fail(context, problem);
  emitHold(tick);
  if (request_id_ == 0 && holdReleased(tick)) request_id_ = tick.request(common::PhotographRequest{*file});
  const auto answer = tick.takeAnswer(request_id_);
  if (!answer) return tree::Status::kRunning;
  return answer->done ? tree::Status::kSuccess : fail(context, answer->reason);
}

}  // namespace swiftlet::behaviors

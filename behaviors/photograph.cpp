// Photograph: stops, and writes the next picture of the RGB-D camera into the run's folder, with the pose of the
// camera. SUCCESS when it is handed to the writer; FAILURE without a camera, or when no frame comes.
#include "behaviors/leaves.hpp"

#include <cstdint>
#include <string>

#include "behaviors/flight_leaf.hpp"
#include "behaviors/leaf_traits.hpp"
#include "behaviors/ports.hpp"

namespace swiftlet::behaviors {
namespace {

class Photograph final : public FlightLeaf {
 public:
  explicit Photograph(const tree::NodeSetup& setup) : FlightLeaf(setup), file_(setup, "file") {}
  static tree::NodeManifest manifest();

 private:
  void onStart(tree::TickContext& context) override;
  void onResume(tree::TickContext& context) override;
  tree::Status act(tree::TickContext& context) override;

  tree::Input<std::string> file_;
  std::uint64_t request_id_ = 0;  ///< 0 until the vehicle has stopped.
};

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
  if (const auto problem = fileNameProblem(*file)) return fail(context, problem->text());
  emitHold(tick);
  if (request_id_ == 0 && holdReleased(tick)) request_id_ = tick.request(common::PhotographRequest{*file});
  const auto answer = tick.takeAnswer(request_id_);
  if (!answer) return tree::Status::kRunning;
  return answer->done ? tree::Status::kSuccess : fail(context, answer->reason);
}

}  // namespace

void addPhotograph(tree::Registry& registry) { registry.add<Photograph>(); }

}  // namespace swiftlet::behaviors

// Photograph: stops, and writes the next picture of the RGB-D camera into the run's folder, with the pose of the
// camera. SUCCESS when it is handed to the writer; FAILURE without a camera, or when no frame comes.
#pragma once

#include <cstdint>
#include <string>

#include "behaviors/flight_leaf.hpp"
#include "behaviors/tree/registry.hpp"

namespace swiftlet::behaviors {

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

}  // namespace swiftlet::behaviors

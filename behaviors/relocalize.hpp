// Relocalize: forgets the pose in the given map, turns about once where it is and, until the vehicle is localized,
// flies to free places around and back.
//
//   forget --> turn by 120 deg, three times --> fly out, fly back, in four directions --> FAILURE
//                    |                               |
//                    +------> localized: SUCCESS <---+
//
// FAILURE without a given map, in a map that is found to be that of another place, and after the last of these.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "behaviors/flight_leaf.hpp"
#include "behaviors/tree/registry.hpp"

namespace swiftlet::behaviors {

class Relocalize final : public FlightLeaf {
 public:
  explicit Relocalize(const tree::NodeSetup& setup)
      : FlightLeaf(setup), clearance_m_(setup, "clearance_m"), radius_m_(setup, "radius_m") {}
  static tree::NodeManifest manifest();

 private:
  tree::Status act(tree::TickContext& context) override;
  void onStart(tree::TickContext& context) override;
  void planLooks(const FlightTick& tick, double clearance_m, double radius_m);
  void nextLook(const FlightTick& tick);
  /// What is flown now; null after the last look.
  const common::GoToIntent* flown() const;

  struct Look {
    common::GoToIntent out;
    bool returns = false;  ///< It ends with the flight back; a turn where the vehicle is does not.
  };

  tree::Input<double> clearance_m_, radius_m_;
  std::uint64_t request_id_ = 0;  ///< 0 before it has asked.
  bool forgotten_ = false;
  std::vector<Look> looks_;
  std::size_t look_ = 0;     ///< The place that is being flown to.
  bool flies_back_ = false;  ///< It flies back from that place.
  common::GoToIntent back_;  ///< To where the vehicle began.
};

}  // namespace swiftlet::behaviors

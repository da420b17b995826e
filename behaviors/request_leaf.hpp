// A behaviour without an intent: it sends the flight one request and waits for the answer, which is its SUCCESS
// or FAILURE. It is released at once; the request is carried out nevertheless.
#pragma once

#include <cstdint>
#include <string>

#include <tl/expected.hpp>

#include "behaviors/flight_tick.hpp"
#include "behaviors/tree/leaf.hpp"

namespace swiftlet::behaviors {

class RequestLeaf : public tree::Leaf {
 public:
  using Leaf::Leaf;

 protected:
  /// The request, or why it cannot be made.
  using RequestOrProblem = tl::expected<common::MissionRequestKind, std::string>;
  /// Called once, at the first tick.
  virtual RequestOrProblem makeRequest(const FlightTick& tick) = 0;

  void onStart(tree::TickContext&) override { id_ = 0; }

 private:
  tree::Status act(tree::TickContext& context) final;

  std::uint64_t id_ = 0;  ///< 0 before the request.
};

}  // namespace swiftlet::behaviors

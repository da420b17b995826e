#include "autonomy/loop/recording.hpp"

#include <fmt/format.h>

#include "autonomy/autonomy.hpp"
#include "autonomy/loop/input_feed.hpp"

namespace swiftlet::autonomy {

tl::expected<void, std::string> replay(const Recording& recording, Autonomy& autonomy,
                                       const std::vector<FlightSink*>& sinks) {
  InputFeed feed(autonomy, sinks);
  for (const Input& input : recording) {
    if (const auto* delivery = std::get_if<common::JobDelivery>(&input); delivery && !autonomy.jobs().awaits(*delivery))
      return tl::unexpected(fmt::format(
          "at {:.3f} s the recording delivers job {} ({}) of {:.3f} s, which is not outstanding in the replay",
          delivery->delivered.seconds(), delivery->number, delivery->kind, delivery->submitted.seconds()));
    (void)feed.give(input);
  }
  return {};
}

}  // namespace swiftlet::autonomy

// Which stamps of a sensor can be used, the same for all sensors of the 3D map.
#pragma once

#include <optional>

#include "common/stamps.hpp"
#include "common/time.hpp"

namespace swiftlet::autonomy {

/// No clock is so far ahead: such a stamp is an error, after which no other measurement would be newer.
inline constexpr common::Duration kFarAhead = common::Duration::fromMilliseconds(1000);

/// Why a measurement with these stamps cannot be used, for people; null if it can. `last` is when the last usable one
/// was measured.
inline const char* stampFault(const common::Stamps& stamps, const std::optional<common::Time>& last) {
  if (stamps.measured > stamps.arrived + kFarAhead) return "its stamp is of the future";
  if (last && stamps.measured <= *last) return "it was not measured after the last";
  return nullptr;
}

}  // namespace swiftlet::autonomy

#include "common/localization.hpp"

#include "common/check.hpp"

namespace swiftlet::common {

const char* toString(LocalizationState state) {
  switch (state) {
    case LocalizationState::kGlobal:
      return "global";
    case LocalizationState::kAmbiguous:
      return "ambiguous";
    case LocalizationState::kLocalized:
      return "localized";
    case LocalizationState::kLost:
      return "lost";
  }
  SWIFTLET_CHECK(false, static_cast<int>(state));
}

}  // namespace swiftlet::common

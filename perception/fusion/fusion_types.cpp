#include "perception/fusion/fusion_types.hpp"

namespace swiftlet::perception {

const char* toString(FusionStatus status) {
  switch (status) {
    case FusionStatus::kNotInitialized:
      return "not initialized";
    case FusionStatus::kOk:
      return "ok";
    case FusionStatus::kDegraded:
      return "degraded";
    case FusionStatus::kDiverged:
      return "diverged";
  }
  return "";
}

}  // namespace swiftlet::perception

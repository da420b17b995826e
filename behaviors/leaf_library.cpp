#include "behaviors/leaf_library.hpp"

namespace swiftlet::behaviors {
namespace {

#if defined(__clang__)
constexpr const char* kRelease = SWIFTLET_RELEASE " (" __VERSION__ ")";
#else
constexpr const char* kRelease = SWIFTLET_RELEASE " (g++ " __VERSION__ ")";
#endif

}  // namespace

const char* leafRelease() { return kRelease; }

}  // namespace swiftlet::behaviors

// Whether the vehicle could fly through what was recognized.
#pragma once

namespace swiftlet::common {

enum class Passage {
  kNone,  ///< Not an opening, or nothing is known.
  kOpen,
  kClosed,
};
inline const char* toString(Passage passage) {
  return passage == Passage::kOpen ? "open" : passage == Passage::kClosed ? "closed" : "none";
}

}  // namespace swiftlet::common

// The acceleration of free fall.
#pragma once

namespace swiftlet::common {

/// Rounded from the standard 9.80665 (3rd CGPM, 1901): between the equator and the poles it differs by 0.05.
inline constexpr double kGravity_m_s2 = 9.81;

}  // namespace swiftlet::common

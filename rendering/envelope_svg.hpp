// The picture of an envelope: a bar for each quantity, from its value in the base to the one at which flights failed.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace swiftlet::rendering {

/// Positions are multiples of what is drawn at worst: 0 is the base, 1 the edge of the outer range.
struct EnvelopeBar {
  std::string name;
  std::optional<double> inner;  ///< Edge of the inner range; nullopt: there is no inner range.
  bool outer = false;           ///< Whether there is an outer range.
  double acceptable = 0.0;      ///< End of what was acceptable.
  std::optional<double> fails;  ///< First that failed, not before `acceptable`; nullopt: none failed.
  std::string inner_text;       ///< Values of the edges, shown on hovering.
  std::string outer_text;
  std::string acceptable_text;
  std::string text;  ///< Right of the bar: "41 ms: crash".
};

struct EnvelopePicture {
  std::string title;
  std::string inner_name;  ///< "real"
  std::string outer_name;  ///< "harsh"
  std::vector<EnvelopeBar> bars;
};

/// One <svg> element with its own style, light or dark by the reader's setting. The axis ends at kEnvelopeAxisEnd;
/// longer bars are cut there, with an arrow. A bar is red if flights failed within the inner range, orange within the
/// outer one, green beyond; where nothing failed, its end is open.
std::string envelopeSvg(const EnvelopePicture& picture);

inline constexpr double kEnvelopeAxisEnd = 4.0;

}  // namespace swiftlet::rendering

// Small helpers to write SVG text.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

namespace swiftlet::rendering::svg {

/// "x,y x,y ..." with one decimal. A point that is not finite splits it: one string for each piece.
std::vector<std::string> pointLists(const std::vector<Eigen::Vector2d>& pixels);

/// The style that both kinds of picture share: colours of series 1 to 6 and of text, for light and dark.
std::string_view style();

}  // namespace swiftlet::rendering::svg

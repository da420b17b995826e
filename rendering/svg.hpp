// Small helpers to write SVG text.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

namespace swiftlet::rendering::svg {

/// "x,y x,y ..." with one decimal; breaks at a point that is not finite: one string for each piece.
std::vector<std::string> pointLists(const std::vector<Eigen::Vector2d>& pixels);

/// The style both kinds of picture share: colours of series 1 to 6 and of text, for light and dark.
std::string_view style();

}  // namespace swiftlet::rendering::svg

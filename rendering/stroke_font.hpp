// A small font made of strokes, so that pictures need no font file and text is sharp at any size. ASCII only; anything
// else is drawn as a box.
#pragma once

#include <string_view>
#include <vector>

#include <Eigen/Core>

namespace swiftlet::rendering {

/// The strokes of a text whose baseline starts at (0, 0), y up, in units of the height of a capital letter.
std::vector<std::vector<Eigen::Vector2d>> textStrokes(std::string_view text);

/// The width of a text in units of the height of a capital letter.
double textWidth(std::string_view text);

}  // namespace swiftlet::rendering

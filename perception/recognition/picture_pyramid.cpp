#include "perception/recognition/picture_pyramid.hpp"

#include <algorithm>

namespace swiftlet::perception {

std::vector<vision::GrayImage> pyramidOf(const vision::GrayImage& picture, int least_side_px) {
  std::vector<vision::GrayImage> levels{picture};
  while (std::min(levels.back().width_px, levels.back().height_px) / 2 >= least_side_px)
    levels.push_back(vision::halved(levels.back()));
  return levels;
}

}  // namespace swiftlet::perception

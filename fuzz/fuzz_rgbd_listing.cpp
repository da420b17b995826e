// links: interfaces common
// Any bytes as the lists of a folder of RGB-D frames: refused as InputError, or pairs of files in the order of their
// stamps. The bytes are associations.txt, or, where they have a zero byte, rgb.txt before it and depth.txt behind it.
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <string_view>

#include "common/error.hpp"
#include "fuzz/scratch.hpp"
#include "interfaces/rgbd/list_rgbd.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace swiftlet;
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  const std::size_t cut = bytes.find('\0');
  std::filesystem::remove(fuzz::scratch() / "associations.txt");
  if (cut == std::string_view::npos) fuzz::put("associations.txt", bytes);
  fuzz::put("rgb.txt", bytes.substr(0, cut));
  fuzz::put("depth.txt", cut == std::string_view::npos ? std::string_view() : bytes.substr(cut + 1));
  try {
    const interfaces::RgbdListing listing = interfaces::listRgbdFolder(fuzz::scratch());
    if (listing.pairs.empty()) std::abort();
    for (std::size_t i = 0; i < listing.pairs.size(); ++i) {
      if (listing.pairs[i].color.empty() || listing.pairs[i].depth.empty()) std::abort();
      if (i > 0 && listing.pairs[i].stamp < listing.pairs[i - 1].stamp) std::abort();
    }
  } catch (const common::InputError& error) {
    if (error.problems().empty()) std::abort();
  }
  return 0;
}

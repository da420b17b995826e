// links: interfaces common
// Any bytes as a rosbag of an RGB-D camera: refused as InputError, or frames whose images have the size of their
// camera, by rising stamps, as many as are listed at most.
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <string>
#include <string_view>

#include "common/error.hpp"
#include "fuzz/scratch.hpp"
#include "interfaces/rgbd/list_rgbd.hpp"
#include "interfaces/rgbd/rgbd_folder.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace swiftlet;
  const std::string file = fuzz::put("a.bag", {reinterpret_cast<const char*>(data), size});
  try {
    interfaces::RgbdFolder folder(interfaces::listRgbdFolder(file));
    if (folder.listing().pairs.empty()) std::abort();
    std::optional<common::Time> last;
    while (const auto frame = folder.next()) {
      const auto pixels = static_cast<std::size_t>(frame->camera.pixels());
      if (frame->color.rgb.size() != 3 * pixels || frame->depth.depth_m.size() != pixels) std::abort();
      if (last && frame->stamps.measured <= *last) std::abort();
      last = frame->stamps.measured;
    }
    if (folder.passed() != folder.listing().pairs.size()) std::abort();
  } catch (const common::InputError& error) {
    if (error.problems().empty()) std::abort();
  }
  return 0;
}

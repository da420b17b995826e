// links: interfaces common
// Any bytes as an archive of a world: refused as InputError with nothing left behind, or unpacked below its folder.
#include <cstdint>
#include <cstdlib>
#include <string>

#include "common/error.hpp"
#include "fuzz/scratch.hpp"
#include "interfaces/files/archive.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace swiftlet;
  namespace fs = std::filesystem;
  const fs::path cache = fuzz::scratch() / "cache";
  try {
    const fs::path folder =
        interfaces::unpackInto(cache, fuzz::put("world.tar", {reinterpret_cast<const char*>(data), size}));
    if (folder.parent_path() != cache) std::abort();
  } catch (const common::InputError& error) {
    if (error.problems().empty() || (fs::exists(cache) && !fs::is_empty(cache))) std::abort();
  }
  for (const auto& entry : fs::directory_iterator(fuzz::scratch()))
    if (entry.path().filename() != "cache" && entry.path().filename() != "world.tar") std::abort();
  fs::remove_all(cache);
  return 0;
}

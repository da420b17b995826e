// links: tree
// Any bytes as a script: the first says which entries are set before. Nothing may crash, hang or leak; what compiles
// can be run, and leaves each entry either unset or with a value that has a text.
#include <cstdint>
#include <deque>
#include <string>

#include "behaviors/tree/script/script.hpp"

namespace {

using namespace swiftlet::tree;

Value valueFor(std::uint8_t bits, std::size_t entry) {
  switch ((bits + entry) % 5) {
    case 0:
      return std::int64_t{-3};
    case 1:
      return 2.5;
    case 2:
      return std::string("text");
    case 3:
      return true;
    default:
      return Point{1.0, 2.0, std::nullopt};
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::uint8_t bits = data[0];
  const std::string text(reinterpret_cast<const char*>(data + 1), size - 1);
  const Constants constants = {{"RED", 1}, {"GREEN", 2}};
  Scripts scripts(constants);
  const auto [script, problem] = scripts.add(text);
  if ((script != nullptr) != problem.empty()) __builtin_trap();
  if (script == nullptr) return 0;
  std::deque<Slot> slots;
  for (std::size_t i = 0; i < script->entries().size(); ++i) {
    Slot& slot = slots.emplace_back();
    slot.name = script->entries()[i].name;
    if ((bits >> (i % 8) & 1U) != 0) slot.value = valueFor(bits, i);
    script->bind(i, &slot);
  }
  for (int run = 0; run < 4; ++run)
    if (!script->holds() && script->problem().empty()) __builtin_trap();
  for (const Slot& slot : slots)
    if (slot.value) (void)toString(*slot.value);
  return 0;
}

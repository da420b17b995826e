#include "apps/speed.hpp"

#include <charconv>

#include <fmt/format.h>

#include "common/error.hpp"
#include "common/lower_case.hpp"
#include "common/number_hint.hpp"
#include "common/text_parts.hpp"

namespace swiftlet::apps {

double parseSpeed(const std::string& text) {
  if (text == "max") return 0.0;
  double speed = 0.0;
  const auto [end, error] = std::from_chars(common::withoutPlus(text).data(), text.data() + text.size(), speed);
  const std::string_view rest(end, static_cast<std::size_t>(text.data() + text.size() - end));
  if (error != std::errc{} || end != text.data() + text.size() || !(speed >= 0.01 && speed <= 1000.0))
    throw common::InputError(
        {}, "--speed", common::Message("speed.no-number", "`{}` is neither max nor a number from 0.01 to 1000", text),
        rest == "x" || rest == "\xC3\x97"  ? "write the number alone"
        : common::lowerCase(text) == "max" ? "write `max`"
                                           : common::numberHint("", text));
  return speed;
}

}  // namespace swiftlet::apps
